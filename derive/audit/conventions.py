"""What the paper leaves open, decided by which reading makes its printed equations come out.

Each open convention has a few options. For a choice of them, the linear part of V_j is derived anew, and
the printed atoms of Eq. 18 and 19 that it reproduces are counted, as are the derived terms that are not
printed. The choice that the derivation makes (:data:`CHOSEN`) must win.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from itertools import product

from sympy.polys.domains import QQ_I
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive.audit.compare import (
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
from derive.harmonics import Series, constant, rotating, series, split
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


_RING = PolyRing([symbol(n) for n in COEFFICIENT_PARAMETERS + MOTION_NUMBERS], QQ_I, lex)
_G = generators(_RING)
Matrix = tuple[tuple[PolyElement, ...], ...]


def _product(A: Matrix, B: Matrix) -> Matrix:
    columns = tuple(zip(*B, strict=True))
    return tuple(
        tuple(sum((x * y for x, y in zip(row, c, strict=True)), _RING.zero) for c in columns) for row in A
    )


def _turn(axis: int, angle: PolyElement, order: int) -> Matrix:
    """Rotation about axis 0, 1 or 2, its sine and cosine to a power of the angle (1 or 2)."""
    cosine = _RING.one - angle**2 / 2 if order == 2 else _RING.one
    i, k = (axis + 1) % 3, (axis + 2) % 3
    rows = [[_RING.one if r == c else _RING.zero for c in range(3)] for r in range(3)]
    rows[i][i] = rows[k][k] = cosine
    rows[i][k], rows[k][i] = -angle, angle
    return tuple(tuple(r) for r in rows)


@cache
def _turning() -> tuple[tuple[Series, ...], tuple[tuple[Series, ...], ...]]:
    """Force and gradient at the disc centre, as the turning disc (radial, tangential, axial) sees them."""
    c, s = rotating(_RING)
    zero, one, minus = (constant(_RING, _RING(n)) for n in (0, 1, -1))
    spin = ((c, minus * s, zero), (s, c, zero), (zero, zero, one))
    entries = gradient_in_motion_numbers()
    M = [[series((), entries[f"M_{i}{k}"], _RING, {}) for k in "xyz"] for i in "xyz"]
    a = [constant(_RING, _G[f"a_{k}"]) for k in "xyz"]

    def add(terms: list[Series]) -> Series:
        total = zero
        for t in terms:
            total = total + t
        return total

    seen_a = tuple(add([spin[n][i] * a[n] for n in range(3)]) for i in range(3))
    half = [[add([M[n][m] * spin[m][k] for m in range(3)]) for k in range(3)] for n in range(3)]
    seen_M = tuple(
        tuple(add([spin[n][i] * half[n][k] for n in range(3)]) for k in range(3)) for i in range(3)
    )
    return seen_a, seen_M


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
    place, (tx, ty, tz) = _geometry(v)
    y, z = _G["vartheta_y"], _G["vartheta_z"]
    if v.matrix == "composed":
        x = _G["vartheta_x"]
        y, z = y - x * z, z + x * y
    input_axis = [p + z * q - y * r for p, q, r in zip(tx, ty, tz, strict=True)]
    a, M = _turning()
    total = constant(_RING, _RING.zero)
    for i in range(3):
        total = total + constant(_RING, _cut(v, input_axis[i])) * a[i]
        for k in range(3):
            total = total + constant(_RING, _cut(v, input_axis[i] * place[k]) * _G["R"]) * M[i][k]
    total = constant(_RING, _G["k1"]) * total
    n = len(COEFFICIENT_PARAMETERS)
    outer = range(n, n + len(MOTION_NUMBERS))
    generic: dict[tuple[int, str], dict[tuple[int, ...], PolyElement]] = {}
    for h in range(5):
        for phase in "cs" if h else "c":
            part = total.cosine(h) if phase == "c" else total.sine(h)
            generic[h, phase] = split(part, outer, COEFFICIENTS, range(n))
    for key, motion, p in _second_order(v.axial):
        generic[key][motion] = generic[key].get(motion, COEFFICIENTS.zero) + p
    return from_generic(generic)


_ANGLES = [n for n, name in enumerate(COEFFICIENT_PARAMETERS) if name.startswith(("beta", "vartheta"))]


def _cut(v: Convention, p: PolyElement) -> PolyElement:
    """What the order of counting keeps."""
    if v.rotation == "first order in all":
        return p.ring.from_dict({m: c for m, c in p.terms() if sum(m[n] for n in _ANGLES) <= 1})
    return p


@cache
def _printed(theta: str, laplace: str) -> tuple[Reading, ...]:
    reader, expand = model_reader(theta == "k1 vartheta"), expand_motion(laplace == "used")
    return tuple(read(e, reader, expand) for e in ANALYTICAL)


def score(v: Convention) -> Score:
    """How much of Eq. 18 and 19 comes out under these conventions."""
    derived = derive_with(v)
    reproduced = printed = unprinted = 0
    for r in _printed(v.theta, v.laplace):
        p = derived_amplitude(derived, amplitude(r.equation.left))
        outcome = compare(r, select(p, printed_order) if v.powers == "beta_z once" else p)
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
