"""How far bounds of an envelope may be moved before the rule keeps another set of terms."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from derive.propagation import Collected
from derive.simplify.envelope import Envelope
from derive.simplify.terms import exceeding


def extent(envelope: Envelope, names: Sequence[str], full: Collected | None = None) -> tuple[float, float]:
    """Least and greatest factor on the bounds ``names`` that leave the simplified model as it is.

    Searched from a millionth to a million, to a relative 1e-6; 0 and infinity where that does not suffice.
    Sizes never decrease with a bound, so that what lies between the two factors gives the same model.
    """
    at_one = exceeding(envelope, full)

    def same(exponent: float) -> bool:
        return exceeding(envelope.scaled(names, 10.0**exponent), full) == at_one

    upper = 6.0
    if "imbalance" in names:  # an instrument without a scale factor is no instrument
        upper = min(upper, math.log10(0.999 / envelope.imbalance)) if envelope.imbalance else upper
    least, greatest = _edge(same, -6.0), _edge(same, upper)
    return 0.0 if least is None else 10.0**least, math.inf if greatest is None else 10.0**greatest


def _edge(same: Callable[[float], bool], far: float) -> float | None:
    """The exponent between 0 and ``far`` up to which ``same`` holds; ``None`` if all the way."""
    if same(far):
        return None
    inside = 0.0
    while abs(far - inside) > 4e-7:
        middle = (inside + far) / 2
        inside, far = (middle, far) if same(middle) else (inside, middle)
    return inside
