"""The three experiments of the paper's Section III, repeated: our numbers beside the printed ones.

M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity
Gradiometer*: a test mass about a perfect instrument (Section III.A), an imperfect one in regular motion
(III.B, Tables V and VI) and in air turbulence (III.C, Tables VII and VIII). The numerical model of Eq. 49 to
53 stands for the instrument, the derived analytical and simplified models for themselves. Nothing is tuned:
where the paper leaves an input open, the choice is said, and what depends on it is shown.
"""
