"""Eq. 5b and 16 of the derivation, in the rings of the audit."""

from __future__ import annotations

import sympy as sp
from sympy import QQ
from sympy.polys.rings import PolyElement

from derive import stages
from derive.audit.compare import Rational
from derive.audit.reading import ANGLE_RING, RATE_RING, generators, ring_of
from derive.propagation import motion_numbers
from derive.stages import PAPER
from derive.symbols import SECOND_ORDER, symbol

_FORCES = ("f_x", "f_y", "f_z")
_FULL = ring_of((*_FORCES, "vartheta_x", "vartheta_y", "vartheta_z", *SECOND_ORDER))
_POWERS = {
    r"\vartheta_{jz}^*": (0, 1, 0),
    r"\vartheta_{jy}^*": (0, 0, 1),
    "K_{j2}^*": (2, 0, 0),
    "K_{j4}^*": (1, 0, 1),
    "K_{j5}^*": (0, 2, 0),
    "K_{j6}^*": (1, 1, 0),
    "K_{j7}^*": (0, 0, 2),
    "K_{j8}^*": (0, 1, 1),
}
"""Powers of f_x, f_y, f_z that the left sides of Eq. 5b multiply in Eq. 5a."""
_NEGATIVE = r"\vartheta_{jy}^*"
"""The one that Eq. 5a subtracts."""


def derived_transducer() -> dict[str, PolyElement]:
    """Eq. 5b by its left sides, from the stages of the derivation: the coefficients of Eq. 5a, without K_0."""
    x, y, z = (
        stages.turn(sp.eye(3)[:, n], -symbol(f"vartheta_{k}"), PAPER.rotation) for n, k in enumerate("xyz")
    )
    turned = z * y * x * sp.Matrix([symbol(n) for n in _FORCES])
    f = stages.SensedForce(*(_FULL.from_expr(sp.expand(e)) for e in turned))
    output = stages.transducer(f, f, generators(_FULL) | {"K0": _FULL.zero})
    rows: dict[tuple[int, ...], dict[tuple[int, ...], Rational]] = {}
    for m, c in output.terms():
        rows.setdefault(m[:3], {})[m[3:]] = c
    by_left = {left: ANGLE_RING.from_dict(rows[powers]) for left, powers in _POWERS.items()}
    return by_left | {_NEGATIVE: -by_left[_NEGATIVE]}


def derived_motion() -> dict[str, PolyElement]:
    """T_1 ... S_5 of the derivation, in :data:`RATE_RING`."""
    return {name: RATE_RING.from_expr(e) for name, e in motion_numbers().items()}


def expand_rate(powers: tuple[int, ...]) -> PolyElement:
    """omega_im^2 by its components."""
    at = RATE_RING.symbols.index(symbol("omega_im"))
    kept = tuple(0 if n == at else p for n, p in enumerate(powers))
    plain = RATE_RING.from_dict({kept: QQ(1)})
    square = sum((generators(RATE_RING)[f"omega_{k}"] ** 2 for k in "xyz"), RATE_RING.zero)
    return plain * square if powers[at] else plain
