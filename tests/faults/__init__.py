"""Commands that are killed at a random moment: ``python -m tests.faults``."""
