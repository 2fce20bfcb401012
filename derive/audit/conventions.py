"""What the paper leaves open, decided by which reading makes its printed equations come out.

Each open convention has a few options. For a choice of them, the linear part of V_j is derived anew, and
the printed atoms of Eq. 18 and 19 that it reproduces are counted, as are the derived terms that are not
printed. The choice that the derivation makes (:data:`CHOSEN`) must win.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import product

import sympy as sp
from sympy.polys.domains import QQ_I
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive.audit.compare import (
    Rational,
    Reading,
    amplitude,
    compare,
    derived_amplitude,
    expand_motion,
    printed_order,
    read,
    select,
)
from derive.audit.printed import ANALYTICAL
from derive.audit.reading import generators, model_reader
from derive.harmonics import rotating, series
from derive.propagation import (
    COEFFICIENT_PARAMETERS,
    COEFFICIENTS,
    MOTION_NUMBERS,
    Collected,
    collect,
    from_generic,
    gradient_in_motion_numbers,
)
from derive.symbols import symbol


@dataclass(frozen=True)
class Convention:
    """One choice among the open conventions of Eq. 18 and 19."""

    tilt: str = "dips"
    axial: str = "down"
    composition: str = "beta_z outermost"
    rotation: str = "first order, multiplied out"
    powers: str = "beta_z once"
    matrix: str = "Eq. 2"
    theta: str = "k1 vartheta"
    laplace: str = "used"


CHOSEN = Convention()

OPTIONS: dict[str, tuple[str, ...]] = {
    "tilt": ("dips", "rises", "none"),
    "axial": ("down", "up"),
    "composition": ("beta_z outermost", "beta_x outermost"),
    "rotation": ("first order, multiplied out", "second order, multiplied out", "first order in all"),
    "powers": ("beta_z once", "all"),
    "matrix": ("Eq. 2", "composed"),
    "theta": ("k1 vartheta", "vartheta"),
    "laplace": ("used", "not used"),
}
"""The options of each convention, the chosen one first."""


@dataclass(frozen=True)
class Score:
    """Printed atoms reproduced, of how many, and derived terms that the print lacks."""

    reproduced: int
    printed: int
    unprinted: int


_G = generators(COEFFICIENTS)
Matrix = tuple[tuple[PolyElement, ...], ...]


def _product(A: Matrix, B: Matrix) -> Matrix:
    columns = tuple(zip(*B, strict=True))
    zero = COEFFICIENTS.zero
    return tuple(tuple(sum((x * y for x, y in zip(row, c, strict=True)), zero) for c in columns) for row in A)


def _turn(axis: int, angle: PolyElement, order: int) -> Matrix:
    """Rotation about axis 0, 1 or 2, its sine and cosine to a power of the angle (1 or 2)."""
    one, zero = COEFFICIENTS.one, COEFFICIENTS.zero
    cosine = one - angle**2 / 2 if order == 2 else one
    i, k = (axis + 1) % 3, (axis + 2) % 3
    rows = [[one if r == c else zero for c in range(3)] for r in range(3)]
    rows[i][i] = rows[k][k] = cosine
    rows[i][k], rows[k][i] = -angle, angle
    return tuple(tuple(r) for r in rows)


@cache
def _turning() -> Mapping[tuple[int, str], Mapping[tuple[int, ...], Sequence[tuple[int, Rational]]]]:
    """Force (3) and gradient (9, by rows) at the disc centre, as the turning disc (radial, tangential, axial) sees them.

    (harmonic, "c" or "s") -> {powers of the motion numbers: (which of the twelve, its coefficient) ...}.
    """
    ring = PolyRing([symbol(n) for n in MOTION_NUMBERS], QQ_I, lex)
    c, s = symbol("c"), symbol("s")
    known = dict(zip((c, s), rotating(ring), strict=True))
    spin = sp.Matrix([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    a = spin * sp.Matrix([symbol(f"a_{k}") for k in "xyz"])
    entries = gradient_in_motion_numbers()
    M = spin * sp.Matrix(3, 3, lambda i, k: entries[f"M_{'xyz'[i]}{'xyz'[k]}"]) * spin.T
    found: dict[tuple[int, str], dict[tuple[int, ...], list[tuple[int, Rational]]]] = {}
    for n, e in enumerate((*a, *M)):
        seen = series((), e, ring, known)
        for h in range(5):
            for phase, part in (("c", seen.cosine(h)), ("s", seen.sine(h)))[: 2 if h else 1]:
                of_phase = found.setdefault((h, phase), {})
                for motion, value in part.terms():
                    of_phase.setdefault(motion, []).append((n, value.x))
    return found


def _geometry(v: Convention) -> tuple[tuple[PolyElement, ...], Matrix]:
    """Position over R, and rows tau_x, tau_y, tau_z, in the disc frame."""
    order = 2 if v.rotation.startswith("second") else 1
    b, e = _G["beta_x"], {"dips": 1, "rises": -1, "none": 0}[v.tilt]
    about, lift, dip = _turn(2, _G["beta_z"], order), _turn(1, -b, order), _turn(1, e * b, order)
    if v.composition == "beta_z outermost":
        place, triad = _product(about, lift), _product(about, dip)
    else:
        place, triad = _product(lift, about), _product(dip, about)
    sign = {"down": -1, "up": 1}[v.axial]
    columns = tuple(zip(*triad, strict=True))
    tau = (columns[1], columns[0], tuple(sign * x for x in columns[2]))
    return tuple(row[0] for row in place), tau


@cache
def _second_order(axial: str) -> tuple[tuple[tuple[int, str], tuple[int, ...], PolyElement], ...]:
    """Null bias and second-order terms: no angles in them, so only the sense of tau_z matters."""
    odd = [COEFFICIENT_PARAMETERS.index(n) for n in ("K4", "K8")]
    kept = [n for n, name in enumerate(COEFFICIENT_PARAMETERS) if name[0] == "K"]
    rows = []
    for key, terms in collect().generic.items():
        for motion, p in terms.items():
            mine = {m: v for m, v in p.terms() if any(m[n] for n in kept)}
            if axial == "up":
                mine = {m: -v if any(m[n] for n in odd) else v for m, v in mine.items()}
            if mine:
                rows.append((key, motion, COEFFICIENTS.from_dict(mine)))
    return tuple(rows)


def derive_with(v: Convention) -> Collected:
    """Eq. 17-19 under these conventions."""
    # how the print is read or counted is no matter of deriving
    return _derived(replace(v, powers=CHOSEN.powers, theta=CHOSEN.theta, laplace=CHOSEN.laplace))


@cache
def _derived(v: Convention) -> Collected:
    place, (tx, ty, tz) = _geometry(v)
    y, z = _G["vartheta_y"], _G["vartheta_z"]
    if v.matrix == "composed":
        x = _G["vartheta_x"]
        y, z = y - x * z, z + x * y
    input_axis = [p + z * q - y * r for p, q, r in zip(tx, ty, tz, strict=True)]
    k1, R = _G["k1"], _G["R"]
    sensed = [k1 * _cut(v, i) for i in input_axis]
    sensed += [k1 * R * _cut(v, i * r) for i in input_axis for r in place]
    generic = {
        key: {m: sum((sensed[n] * c for n, c in parts), COEFFICIENTS.zero) for m, parts in terms.items()}
        for key, terms in _turning().items()
    }
    for key, motion, p in _second_order(v.axial):
        generic[key][motion] = generic[key].get(motion, COEFFICIENTS.zero) + p
    return from_generic({key: {m: p for m, p in terms.items() if p} for key, terms in generic.items()})


_ANGLES = [n for n, name in enumerate(COEFFICIENT_PARAMETERS) if name.startswith(("beta", "vartheta"))]


def _cut(v: Convention, p: PolyElement) -> PolyElement:
    """What the order of counting keeps."""
    if v.rotation == "first order in all":
        return p.ring.from_dict({m: c for m, c in p.terms() if sum(m[n] for n in _ANGLES) <= 1})
    return p


@cache
def read_print(theta: str, laplace: str) -> tuple[Reading, ...]:
    """Eq. 18 and 19 as they are read under these conventions."""
    reader, expand = model_reader(theta == "k1 vartheta"), expand_motion(laplace == "used")
    return tuple(read(e, reader, expand) for e in ANALYTICAL)


@cache
def amplitudes_with(v: Convention) -> Mapping[str, PolyElement]:
    """The amplitudes under these conventions, as far as the print goes, in :data:`MODEL_RING`."""
    derived = derive_with(v)
    found = {n: derived_amplitude(derived, n) for n in derived.amplitudes}
    return found if v.powers == "all" else {n: select(p, printed_order) for n, p in found.items()}


@cache
def score(v: Convention) -> Score:
    """How much of Eq. 18 and 19 comes out under these conventions."""
    derived = amplitudes_with(replace(v, theta=CHOSEN.theta, laplace=CHOSEN.laplace))
    reproduced = printed = unprinted = 0
    for r in read_print(v.theta, v.laplace):
        outcome = compare(r, derived[amplitude(r.equation.left)])
        reproduced += outcome.confirmed
        printed += len(r.atoms)
        unprinted += len(outcome.missing)
    return Score(reproduced, printed, unprinted)


def departures() -> tuple[tuple[Convention, Score], ...]:
    """The chosen conventions, then each of them changed alone.

    Rotations to second order are taken with all powers of beta_z: their point is what the first order lacks.
    """
    rows = [CHOSEN, *(replace(CHOSEN, **{n: o}) for n, (_, *others) in OPTIONS.items() for o in others)]
    rows = [replace(v, powers="all") if v.rotation.startswith("second") else v for v in rows]
    return tuple((v, score(v)) for v in rows)


def geometries() -> tuple[tuple[Convention, Score], ...]:
    """Every combination of the conventions of geometry, best first."""
    names = ("tilt", "axial", "composition", "rotation")
    rows = [
        replace(CHOSEN, **dict(zip(names, choice, strict=True)))
        for choice in product(*(OPTIONS[n] for n in names))
    ]
    return tuple(
        sorted(((v, score(v)) for v in rows), key=lambda row: (-row[1].reproduced, row[1].unprinted))
    )
