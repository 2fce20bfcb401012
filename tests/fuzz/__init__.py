"""Fuzzing of what reads files and texts of strangers: ``python -m tests.fuzz``."""
