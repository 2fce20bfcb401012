"""Reports: one self-contained HTML document each; the same input gives the same bytes. ``in_words`` needs nothing that draws."""
