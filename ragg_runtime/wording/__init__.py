"""How numbers, units and evidence are put into words and tables."""
