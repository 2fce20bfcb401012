"""Evidence for effects of the catalogue: likelihood ratios, selection, steps, random effects."""
