"""The command line, ``ragg``: commands, terminal texts, the demonstration. May import every room."""
