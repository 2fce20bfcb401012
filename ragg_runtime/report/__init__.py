"""Reports: one self-contained HTML document each, without links or files beside it; results in words.

``compare_page``, ``diagnose_page`` and ``add_page`` turn results into pages; the same input gives the same bytes.
Numbers come from the results, words from ``wording``, series for figures from ``series``. Words alone (``in_words``)
need nothing that draws: it takes a second to import.
"""
