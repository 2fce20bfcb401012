"""Equations for the page: LaTeX to MathML, which browsers draw by themselves."""

from __future__ import annotations

import html
import re
from functools import lru_cache

_ABSENT = re.compile(r"\\(bm|boldsymbol)\b")
_OPERATOR = re.compile(r"\\mathrel\{([+-])\}=")


@lru_cache(maxsize=512)
def mathml(latex: str, *, block: bool = False) -> str:
    """``latex`` as a ``<math>`` element; as plain text where it is none (an expression of the user's own)."""
    from latex2mathml.converter import convert

    plain = f"<code>{html.escape(latex)}</code>"
    if ("\\" not in latex and "*" in latex) or set("<>&") & set(latex):  # the converter passes markup on
        return plain
    try:
        made = convert(
            _OPERATOR.sub(r"\1=", _ABSENT.sub(r"\\mathbf", latex)), display="block" if block else "inline"
        )
    except Exception:  # whatever a stranger's text does to the converter, the text can be shown
        return plain
    return str(made) if "\\" not in made else plain
