"""Eq. 5b and 16 of the derivation, and the readings of them that the paper leaves open."""

from __future__ import annotations

from itertools import permutations

import sympy as sp
from sympy import QQ
from sympy.polys.rings import PolyElement

from derive import stages
from derive.audit.compare import Rational, Reading, compare, read
from derive.audit.conventions import Score
from derive.audit.printed import MOTION, TRANSDUCER
from derive.audit.reading import ANGLE_RING, RATE_RING, generators, motion_reader, ring_of, transducer_reader
from derive.propagation import motion_numbers
from derive.stages import PAPER
from derive.symbols import SECOND_ORDER, symbol

# --- Eq. 5b ---

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


def expanded_transducer(order: str, sense: int = 1, form: str = "multiplied out") -> dict[str, PolyElement]:
    """Eq. 5b by its left sides: the frame turned about the axes in ``order`` (first one first).

    ``form``: first-order rotations "multiplied out", or their sum only ("Eq. 2").
    """
    g = generators(_FULL)
    start = [g[n] for n in _FORCES]
    force = list(start)
    for axis in ("xyz".index(k) for k in order):
        i, k = (axis + 1) % 3, (axis + 2) % 3
        angle = sense * g[f"vartheta_{'xyz'[axis]}"]
        source = list(force if form == "multiplied out" else start)
        force[i], force[k] = force[i] + angle * source[k], force[k] - angle * source[i]
    return _by_left(stages.SensedForce(*force))


def derived_transducer() -> dict[str, PolyElement]:
    """Eq. 5b by its left sides, from the stages of the derivation."""
    x, y, z = (
        stages.turn(sp.eye(3)[:, n], -symbol(f"vartheta_{k}"), PAPER.rotation) for n, k in enumerate("xyz")
    )
    rows = z * y * x * sp.Matrix([symbol(n) for n in _FORCES])
    return _by_left(stages.SensedForce(*(_FULL.from_expr(sp.expand(e)) for e in rows)))


def _by_left(f: stages.SensedForce) -> dict[str, PolyElement]:
    """The coefficients of Eq. 5a, without K_0."""
    output = stages.transducer(f, f, generators(_FULL) | {"K0": _FULL.zero})
    rows: dict[tuple[int, ...], dict[tuple[int, ...], Rational]] = {}
    for m, c in output.terms():
        rows.setdefault(m[:3], {})[m[3:]] = c
    by_left = {left: ANGLE_RING.from_dict(rows[powers]) for left, powers in _POWERS.items()}
    return by_left | {_NEGATIVE: -by_left[_NEGATIVE]}


def transducer_scores() -> tuple[tuple[str, Score], ...]:
    """Eq. 5b under every order of the three rotations, the opposite sense, and without their products."""
    rows = [(", then ".join(p), expanded_transducer("".join(p))) for p in permutations("xyz")]
    rows.append(("x, then y, then z, opposite sense", expanded_transducer("xyz", sense=-1)))
    rows.append(("Eq. 2 (first order, no products)", expanded_transducer("xyz", form="Eq. 2")))
    readings = [read(e, transducer_reader()) for e in TRANSDUCER]
    return tuple((name, _count([(r, d[r.equation.left]) for r in readings])) for name, d in rows)


def _count(pairs: list[tuple[Reading, PolyElement]]) -> Score:
    outcomes = [compare(r, d) for r, d in pairs]
    return Score(
        sum(o.confirmed for o in outcomes),
        sum(len(r.atoms) for r, _ in pairs),
        sum(len(o.missing) for o in outcomes),
    )


# --- Eq. 16 ---


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


def motion_scores() -> tuple[tuple[str, Score], ...]:
    """Eq. 16 with T_ij read as Gamma_ij, and as -Gamma_ij."""
    derived = derived_motion()
    scores = []
    for name, sign in (("Gamma_ij", 1), ("-Gamma_ij", -1)):
        readings = [read(e, motion_reader(sign), expand_rate) for e in MOTION]
        scores.append((name, _count([(r, derived[r.equation.left]) for r in readings])))
    return tuple(scores)
