"""Where the accelerometers of an instrument are: constants of each, and which of them make an output.

The chain is derived for one generic accelerometer; accelerometers differ in constants: the cosine and sine of
its angle on the disc, and, where a layout has them, its height, the turn of its triad and the axis of its disc.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property

import sympy as sp

from derive.stages import PAPER as PAPER_ORDER
from derive.stages import Kinematics, Order
from derive.symbols import INSTRUMENT, QUARTER_TURNS, SIGNS, Parameter, symbol

HEIGHT = symbol("height_j")
"""Distance of the accelerometer along the spin axis from the disc's centre, m."""


def _matrix(name: str) -> sp.Matrix:
    return sp.Matrix(3, 3, lambda i, k: symbol(f"{name}_{i}{k}_j"))


TURN = _matrix("turn")
"""Rotation of the nominal triad in (e_r, e_t, e_a)."""

AXES = _matrix("axes")
"""From the frame of the disc at rest (angle 0, z along the spin axis) to the measurement frame."""


@dataclass(frozen=True)
class SymbolicOutput:
    """An output: the sum of voltages of accelerometers (counted from 0) with their signs."""

    name: str
    members: tuple[int, ...]
    signs: tuple[int, ...]


@dataclass(frozen=True)
class SymbolicLayout:
    """The accelerometers of an instrument.

    Attributes
    ----------
    names
        A1 ...
    constants
        Name of a symbol (``cos_j``, ``sin_j``; ``height_j``, ``turn_00_j`` ..., ``axes_00_j`` ... if the layout has
        heights, directions or axes) -> one number for each accelerometer.
    outputs
        G_out ...
    rest
        What the exact cosines and sines of the angles have beyond ``constants``: of places that balance each other
        the sum vanishes as it should, and a specific force of 1 g leaves nothing of their rounding.
    own
        Whether each accelerometer has a radius and a spin frequency of its own, even where all are placed as the paper's: four
        quarter turns on a vertical disc have no other constants than the paper's once the axis is put in, and are another
        instrument.
    """

    names: tuple[str, ...]
    constants: Mapping[str, tuple[float, ...]] = field(hash=False)
    outputs: tuple[SymbolicOutput, ...]
    rest: Mapping[str, tuple[float, ...]] = field(hash=False, default_factory=dict)
    own: bool = False

    @property
    def size(self) -> int:
        return len(self.names)

    @cached_property
    def is_paper(self) -> bool:
        return self == PAPER

    @property
    def common(self) -> Mapping[sp.Symbol, sp.Expr]:
        """Constants that are 0, 1 or -1 in all accelerometers alike: what they multiply vanishes, or stays as it is.

        The angle stays: of a single accelerometer it is a constant like others.
        """
        return {
            symbol(n): sp.Integer(int(v[0]))
            for n, v in self.constants.items()
            if n not in ("cos_j", "sin_j") and v[0] in (0.0, 1.0, -1.0) and len(set(v)) == 1
        }

    def without_common(self) -> SymbolicLayout:
        """The layout with the other constants alone."""
        common = {s.name for s in self.common}
        return replace(self, constants={n: v for n, v in self.constants.items() if n not in common})

    def has(self, constant: sp.Symbol) -> bool:
        return constant.name in self.constants


def rest_of_angles(
    degrees: Sequence[Fraction | None], cosines: Sequence[float], sines: Sequence[float]
) -> Mapping[str, tuple[float, ...]]:
    """``SymbolicLayout.rest`` of angles in degrees, where they are known exactly (``None``: nothing is added)."""
    rests: dict[str, tuple[float, ...]] = {}
    for name, of, floats in (("cos_j", sp.cos, cosines), ("sin_j", sp.sin, sines)):
        exact = [None if d is None else of(sp.Rational(str(d)) * sp.pi / 180) for d in degrees]
        pairs = zip(exact, floats, strict=True)
        rest = [0.0 if e is None else float((e - sp.Rational(x)).evalf(20, maxn=60)) for e, x in pairs]
        if any(rest):
            rests[name] = tuple(rest)
    return rests


_COSINES, _SINES = (1.0, 0.0, -1.0, 0.0), (0.0, 1.0, 0.0, -1.0)

PAPER = SymbolicLayout(
    names=("A1", "A2", "A3", "A4"),
    constants={
        "cos_j": tuple(_COSINES[q] for q in QUARTER_TURNS),
        "sin_j": tuple(_SINES[q] for q in QUARTER_TURNS),
    },
    outputs=(SymbolicOutput("G_out", (0, 1, 2, 3), SIGNS),),
)
"""Four quarter turns, G_out = V_1 + V_2 - V_3 - V_4 (Eq. 15)."""


@dataclass(frozen=True)
class SymbolicForm:
    """The form of a model: its order, whose rotation its accelerometers sense, and where they are."""

    order: Order = PAPER_ORDER
    kinematics: Kinematics = "platform"
    layout: SymbolicLayout = PAPER


PAPERS = SymbolicForm()


def instrument_parameters(layout: SymbolicLayout) -> tuple[Parameter, ...]:
    """Those of the paper's instrument; of another layout each accelerometer has its own radius and spin frequency."""
    if layout.is_paper:
        return INSTRUMENT
    return tuple(replace(q, shared=False, count=layout.size) for q in INSTRUMENT)
