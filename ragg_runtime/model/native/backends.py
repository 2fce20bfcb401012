"""One interface to a derived model, in machine code or in NumPy."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import stretches
from ragg_runtime.instrument.layout import PAPER, Layout
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.native.arguments import Base, Case, Series, into
from ragg_runtime.model.native.compiler import BuildError, NativeWarning, build
from ragg_runtime.model.native.library import Library

Array = NDArray[np.float64]
Backend = Literal["auto", "c", "numpy"]


BLOCK = 4096
"""Samples that NumPy evaluates at a time, in cache."""


@dataclass(frozen=True)
class Compiled(Base):
    """A model in machine code. Times t in s, (N,); parameters p in SI, in the order of the model's PARAMETERS.

    ``angle`` is the disc angle, rad, (N,), of several discs that of the one whose accelerometers are asked for; by default
    2 pi spin_frequency t, reduced exactly. Series that are contiguous float64 are used where they lie; others are converted.
    ``folded``: the library also holds the folded form, for outputs. ``name`` is the generated module's.
    """

    library: Library
    folded: bool
    backend: str = "c"
    name: str = "chain"

    def output(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        out: Array | None = None,
        which: int = 0,
    ) -> Array:
        """G_out, or another of the layout's outputs, (N,), V; into ``out``, contiguous float64, where that is given."""
        case = self.case(t, inputs, p, angle)
        G = into(out, len(case.t))
        name = "folded" if self.folded else self.name
        self.library.series(name, "output", case, G, (which,) if self.several else ())
        return G

    def voltages(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        members: Sequence[int] | None = None,
    ) -> Array:
        """V_1 ... V_4, or those of some accelerometers (counted from 0), (members, N), V."""
        case = self.case(t, inputs, p, angle)
        if not self.several:
            V = self._rows("voltages", 4, case)
            return V if members is None or tuple(members) == (0, 1, 2, 3) else V[list(members)]
        wanted = range(self.size) if members is None else members
        return np.concatenate([self._rows("voltage", 1, case, (j,)) for j in wanted])

    def derivatives(
        self,
        j: int,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
    ) -> Array:
        """Derivatives of V_j, j counted from 0, (rows, N), in the order of the chain's ROWS."""
        c = self.case(t, inputs, p, angle)
        return self._rows("derivatives", len(self.chain.ROWS), c, (_accelerometer(j, self.size),))

    def _rows(self, function: str, rows: int, case: Case, leading: Sequence[int] = ()) -> Array:
        found = np.empty((rows, len(case.t)))
        self.library.series(self.name, function, case, found, leading)
        return found


@dataclass(frozen=True)
class Interpreted(Base):
    """The same in NumPy, in blocks that stay in cache; ``folded``: its folded form, if it has one."""

    folded: ModuleType | None
    backend: str = "numpy"

    def output(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        out: Array | None = None,
        which: int = 0,
    ) -> Array:
        if self.folded is None:
            o = self.layout.outputs[which]
            v = self.voltages(t, inputs, p, angle, o.members)
            G = into(out, v.shape[1])
            G[:] = o.combined(v)
            return G
        c = self.case(t, inputs, p, angle)
        G = into(out, len(c.t))
        of_several = {"which": which} if self.several else {}
        for some in stretches(len(G), BLOCK):
            b = c.part(some)
            G[some] = self.folded.output(b.t, b.matrix, b.p, b.angle, **of_several)
        return G

    def voltages(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        members: Sequence[int] | None = None,
    ) -> Array:
        c = self.case(t, inputs, p, angle)
        wanted = range(self.size) if members is None else members
        V = np.empty((len(wanted), len(c.t)))
        for k, j in enumerate(wanted):
            self._chain(self.chain.accelerometer, j, c, V[k])
        return V

    def derivatives(
        self,
        j: int,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
    ) -> Array:
        c = self.case(t, inputs, p, angle)
        D = np.empty((len(self.chain.ROWS), len(c.t)))
        self._chain(self.chain.derivatives, _accelerometer(j, self.size), c, D)
        return D

    def _chain(self, function: Callable[..., Array], j: int, c: Case, found: Array) -> None:
        from generated.folded import disc_angle

        q = self.chain.values_of(j, c.p)
        spin = float(q[1])
        for some in stretches(len(c.t), BLOCK):
            b = c.part(some)
            phi = disc_angle(b.t, spin) if b.angle is None else b.angle
            found[..., some] = function(j, b.t, np.cos(phi), np.sin(phi), b.matrix, q)


Evaluator = Compiled | Interpreted


def _accelerometer(j: int, count: int) -> int:
    if j not in range(count):
        expected = "0, 1, 2 or 3" if count == 4 else f"0 ... {count - 1}"
        raise UserError("there is no such accelerometer", found=j, expected=expected)
    return j


_said: list[str] = []


def evaluator(
    chain: Chain,
    sources: Mapping[str, str],
    folded: ModuleType | None,
    backend: Backend = "auto",
    layout: Layout = PAPER,
) -> Evaluator:
    """The evaluator of a model: machine code, or, of ``auto``, NumPy with a note where it cannot be made (``c``: UserError)."""
    if backend not in ("auto", "c", "numpy"):
        raise UserError("unknown backend", found=repr(backend), expected="auto, c or numpy")
    if backend == "numpy":
        return Interpreted(chain, layout, folded)
    try:
        return Compiled(chain, layout, Library(build(sources)), "folded.c" in sources)
    except BuildError as error:
        if backend == "c":
            raise UserError("the model cannot be compiled", found=str(error)) from None
        if not _said:
            _said.append(str(error))
            warnings.warn(
                f"the model is not compiled, the slower NumPy code serves: {error}",
                NativeWarning,
                stacklevel=3,
            )
        return Interpreted(chain, layout, folded)


def for_fits(
    modules: Mapping[str, Chain],
    sources: Mapping[str, str],
    layout: Layout = PAPER,
    *,
    quick: bool = False,
) -> Callable[[str], Evaluator]:
    """Evaluators of generated modules (name -> module) for their derivatives, each made when it is asked for by name.

    In machine code where ``sources`` holds a module's C and it can be compiled (``quick``: with less effort); else in
    NumPy.
    """

    def made(name: str) -> Evaluator:
        own = {n: text for n, text in sources.items() if n.partition(".")[0] == name}
        try:
            if own:
                return Compiled(modules[name], layout, Library(build(own, quick=quick)), False, name=name)
        except BuildError:
            pass
        return Interpreted(modules[name], layout, None)

    return cache(made)
