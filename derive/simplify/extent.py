"""How far bounds of an envelope may be moved before the rule keeps another set of terms."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from derive.propagation import Collected, collect
from derive.simplify.envelope import Envelope
from derive.simplify.terms import Product, exceeding


def extent(envelope: Envelope, names: Sequence[str], full: Collected | None = None) -> tuple[float, float]:
    """Least and greatest factor on the bounds ``names`` that leave the simplified model as it is.

    Searched from a millionth to a million, to a relative 1e-6; 0 and infinity where that does not suffice.
    Sizes never decrease with a bound, so that what lies between the two factors gives the same model.
    """
    terms = (full or collect()).largest
    at_one = exceeding(envelope, terms)

    def moved(exponent: float, among: set[Product]) -> set[Product]:
        """Of these terms those that are kept there and not here, or the other way round."""
        there = exceeding(envelope.scaled(names, 10.0**exponent), {t: terms[t] for t in among})
        return there ^ (at_one & among)

    upper = 6.0
    if "imbalance" in names:  # an instrument without a scale factor is no instrument
        upper = min(upper, math.log10(0.999 / envelope.imbalance)) if envelope.imbalance else upper
    least, greatest = _edge(moved, -6.0, set(terms)), _edge(moved, upper, set(terms))
    return 0.0 if least is None else 10.0**least, math.inf if greatest is None else 10.0**greatest


def _edge(
    moved: Callable[[float, set[Product]], set[Product]], far: float, terms: set[Product]
) -> float | None:
    """The exponent between 0 and ``far`` up to which no term has ``moved``; ``None`` if all the way."""
    beyond = moved(far, terms)
    if not beyond:
        return None
    inside = 0.0
    while abs(far - inside) > 4e-7:
        middle = (inside + far) / 2
        if found := moved(middle, beyond):  # what has not moved at the far end has not moved before
            far, beyond = middle, found
        else:
            inside = middle
    return inside
