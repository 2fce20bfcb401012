"""A calibrated model taken elsewhere: as a C program, as NumPy, as JSON."""
