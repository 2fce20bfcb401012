"""The derived chain put into numbers, for tests: SymPy's own NumPy printer, not the project's emitters."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.printing.numpy import NumPyPrinter

from derive.chain import accelerometer
from derive.effect import Effect
from derive.layout import SymbolicForm
from derive.stages import Kinematics, Order
from derive.symbols import QUARTER_TURNS
from derive.tape import Program, settled
from ragg_runtime.instrument.units import units

Array = NDArray[np.float64]

LIKE_REFERENCE = Order(1, 1, second_order_angles=True)
"""First-order rotations, kept in the second-order terms too: the counting of the reference simulator."""

G0 = 9.8

UNORDERED = {
    "order": "none",
    "fully_qualified_modules": False,
    "inline": True,
    "allow_unknown_functions": True,
}
"""As ``lambdify`` prints, but sums as they stand: to put their terms in order takes half of the time."""


@dataclass(frozen=True)
class Evaluated:
    """A program as a function: values by symbol name -> outputs by name, each an array."""

    program: Program

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        return tuple(s.name for s in self.program.inputs)

    @cached_property
    def function(self) -> Callable[..., Sequence[Array]]:
        """Compiled with SymPy's NumPy printer, once it is called."""
        outputs = [e for _, e in self.program.outputs]
        return sp.lambdify(  # type: ignore[no-any-return]
            self.program.inputs,
            outputs,
            "numpy",
            printer=NumPyPrinter(UNORDERED),
            cse=lambda _: (list(self.program.assignments), outputs),
        )

    def __call__(self, values: Mapping[str, Array | float]) -> dict[str, Array]:
        found = self.function(*(values[n] for n in self.inputs))
        return {n: np.asarray(v, dtype=float) for (n, _), v in zip(self.program.outputs, found, strict=True)}


def neutral_values(effects: Sequence[Effect]) -> dict[sp.Symbol, sp.Expr]:
    """Neutral values of what is fitted; an instant of a step stays open."""
    return {
        e.symbol(q): sp.nsimplify(q.neutral) for e in effects for q in e.parameters if q.fitted or q.shape
    }


@cache
def voltage(effects: tuple[Effect, ...], order: Order, kinematics: Kinematics = "platform") -> Evaluated:
    """V of the generic accelerometer with ``effects``, their parameters open."""
    a = accelerometer(effects, SymbolicForm(order, kinematics))
    return Evaluated(settled(a.tape.assignments, {}).program([("V", a.voltage)]))


@cache
def signatures(effects: tuple[Effect, ...], order: Order) -> Evaluated:
    """dV/d(parameter) of all ``effects`` at their neutral values, by symbol name, and V itself.

    Derived as candidates, as signatures are in use; ``test_tape.py`` holds that to the derivatives of the whole model.
    """
    a = accelerometer(effects, SymbolicForm(order), effects)
    at, by = a.tape.derivatives(a.voltage, settled(a.tape.assignments, neutral_values(effects)))
    rows = [(e.symbol(q).name, by(e.symbol(q))) for e in effects for q in e.parameters if q.fitted]
    return Evaluated(at.program([("V", a.voltage), *rows]))


def si(unit: str) -> float:
    """Factor from a display unit to SI."""
    known = units(G0)
    return float(known.to_si(1.0, unit, known.base_unit(unit)))


def place(j: int) -> dict[str, float]:
    """Constant cosine and sine of the nominal place of accelerometer j = 0 ... 3."""
    quarter = QUARTER_TURNS[j]
    return {"cos_j": (1.0, 0.0, -1.0, 0.0)[quarter], "sin_j": (0.0, 1.0, 0.0, -1.0)[quarter]}
