"""The steps of the loop, for the command line and Python: load, compare, diagnose, add, remove, simulate."""
