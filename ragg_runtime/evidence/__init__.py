"""Statistical evidence for effects of the catalogue: likelihood ratios, selection, steps, random effects.

May import ``lack_of_fit``, ``fit`` and what is below.
"""
