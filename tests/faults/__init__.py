"""Commands that are killed, run out of disc, or may not write: ``python -m tests.faults``."""
