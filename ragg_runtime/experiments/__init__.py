"""The three experiments of the paper's Section III, repeated: our numbers and the printed ones.

M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity Gradiometer*. Where
the paper leaves an input open, the choice is said.
"""
