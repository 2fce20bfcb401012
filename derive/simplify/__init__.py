"""From the analytical to the simplified model: what an envelope of motion and instruments lets one neglect.

Section II.B of the paper, computed. :func:`simplified` gives Eq. 42-47 for the paper's envelope, and the
model that follows from the same rule for any other; :func:`certified_bound` gives what the dropped part can
amount to, with proof; :func:`critical_conditions` gives Tables I to III.
"""

from derive.simplify.envelope import DYNAMIC_EXPERIMENT, PAPER_ENVELOPE, Envelope
from derive.simplify.page import AngularMotion, Condition, critical_conditions
from derive.simplify.terms import Certificate, Size, certified_bound, dropped, simplified, sizes

__all__ = [
    "DYNAMIC_EXPERIMENT",
    "PAPER_ENVELOPE",
    "AngularMotion",
    "Certificate",
    "Condition",
    "Envelope",
    "Size",
    "certified_bound",
    "critical_conditions",
    "dropped",
    "simplified",
    "sizes",
]
