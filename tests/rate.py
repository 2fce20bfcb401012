"""The sampling rate that most simulated flights of the tests have."""

RATE = 8.0
"""Hz: the platform passes nothing of note above 2 Hz (reference/turbulence.py), so that sixteen samples a second tell no more."""
