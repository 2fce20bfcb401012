"""The printed equations of the paper, as data for the audit alone: nothing else may import this.

Verbatim LaTeX, misprints included (theta against vartheta, T_ij against Gamma_ij, subscripts without
their j, upper against lower case). Only spacing, line breaks, alignment and braces without meaning are
taken out, and every equation is cut into its top-level terms, each with its sign. An equation is known
by the number in its label in the paper's source: 5b, 16, 18, 19, 43, 45 (A^s and A^c of the spin rate),
47 (A_0 of the simplified model).
"""

from __future__ import annotations

from derive.audit.printed.analytical import ANALYTICAL
from derive.audit.printed.equation import Equation
from derive.audit.printed.motion import MOTION
from derive.audit.printed.simplified import SIMPLIFIED
from derive.audit.printed.transducer import TRANSDUCER

__all__ = ["ANALYTICAL", "MOTION", "PRINTED", "SIMPLIFIED", "TRANSDUCER", "Equation"]

PRINTED: tuple[Equation, ...] = TRANSDUCER + MOTION + ANALYTICAL + SIMPLIFIED
