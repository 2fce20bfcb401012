"""Reports: one self-contained HTML document each, without links or files beside it; results in words.

``compare_html``, ``diagnose_html`` and ``add_html`` turn results into pages; the same input gives the same
bytes. Numbers come from the results, words from ``wording``, series for figures from ``series``.

Imports ``base``, ``diagnosis``, ``fit``, ``survey`` and ``wording``.
"""

from __future__ import annotations

from ragg_runtime.report.add_page import add_html
from ragg_runtime.report.compare_page import compare_html
from ragg_runtime.report.diagnose_page import diagnose_html

__all__ = ["add_html", "compare_html", "diagnose_html"]
