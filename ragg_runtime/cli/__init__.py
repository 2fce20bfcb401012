"""The command line, ``ragg``: commands, terminal texts, the demonstration."""
