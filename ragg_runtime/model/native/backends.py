"""One interface to a derived model, in machine code or in NumPy."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.layout import PAPER, Layout
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.native.arguments import Base, Case, Series, cut, in_parts, into
from ragg_runtime.model.native.compiler import BuildError, NativeWarning, build
from ragg_runtime.model.native.library import Library

Array = NDArray[np.float64]
Backend = Literal["auto", "c", "numpy"]


class Evaluator(Protocol):
    """A model to be evaluated. Times t in s, (N,); parameters p in SI, in the order of the model's PARAMETERS.

    Of a layout with several discs an angle is that of the disc whose accelerometers are asked for.
    ``angle`` is the disc angle, rad, (N,); by default 2 pi spin_frequency t, reduced exactly. Series that are
    contiguous float64 are used where they lie; others are converted. The figures do not depend on the number
    of threads.
    """

    @property
    def backend(self) -> str:
        """``c`` or ``numpy``."""

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of the series, in order."""

    def output(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
        out: Array | None = None,
        which: int = 0,
    ) -> Array:
        """G_out, or another of the layout's outputs, (N,), V; into ``out``, contiguous float64, where that is given."""

    def voltages(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
        members: Sequence[int] | None = None,
    ) -> Array:
        """V_1 ... V_4, or those of some accelerometers (counted from 0), (members, N), V."""

    def derivatives(
        self,
        j: int,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
    ) -> Array:
        """Derivatives of V_j, j counted from 0, (rows, N), in the order of the chain's ROWS."""


@dataclass(frozen=True)
class Compiled(Base):
    """A model in machine code; ``folded``: the library also holds the folded form, for outputs.

    ``name`` is the generated module's.
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
        threads: int | None = None,
        out: Array | None = None,
        which: int = 0,
    ) -> Array:
        case = self.case(t, inputs, p, angle)
        G = into(out, len(case.t))
        name = "folded" if self.folded else self.name
        leading = (which,) if self.several else ()

        def work(c: Case, first: int, last: int) -> None:
            self.library.series(name, "output", c, G[first:last], leading)

        in_parts(case, threads, work)
        return G

    def voltages(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
        members: Sequence[int] | None = None,
    ) -> Array:
        case = self.case(t, inputs, p, angle)
        if not self.several:
            V = self._rows("voltages", 4, case, threads)
            return V if members is None or tuple(members) == (0, 1, 2, 3) else V[list(members)]
        wanted = range(self.size) if members is None else members
        return np.concatenate([self._rows("voltage", 1, case, threads, (j,)) for j in wanted])

    def derivatives(
        self,
        j: int,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
    ) -> Array:
        c = self.case(t, inputs, p, angle)
        return self._rows("derivatives", len(self.chain.ROWS), c, threads, (_accelerometer(j, self.size),))

    def _rows(
        self, function: str, rows: int, case: Case, threads: int | None, leading: Sequence[int] = ()
    ) -> Array:
        found = np.empty((rows, len(case.t)))

        def work(c: Case, first: int, last: int) -> None:
            whole = last - first == found.shape[1]
            part = found if whole else np.empty((rows, last - first))
            self.library.series(self.name, function, c, part, leading)
            if not whole:
                found[:, first:last] = part

        in_parts(case, threads, work)
        return found


@dataclass(frozen=True)
class Interpreted(Base):
    """A model in NumPy, in blocks that stay in cache; ``folded``: its folded form, if it has one."""

    folded: ModuleType | None
    backend: str = "numpy"

    def output(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
        out: Array | None = None,
        which: int = 0,
    ) -> Array:
        if self.folded is None:
            o = self.layout.outputs[which]
            v = self.voltages(t, inputs, p, angle, threads, o.members)
            G = into(out, v.shape[1])
            G[:] = o.combined(v)
            return G
        c = self.case(t, inputs, p, angle)
        G = into(out, len(c.t))
        of_several = {"which": which} if self.several else {}
        for first, last in cut(len(G), len(G)):
            b = c.part(first, last)
            G[first:last] = self.folded.output(b.t, b.matrix, b.p, b.angle, **of_several)
        return G

    def voltages(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        threads: int | None = None,
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
        threads: int | None = None,
    ) -> Array:
        c = self.case(t, inputs, p, angle)
        D = np.empty((len(self.chain.ROWS), len(c.t)))
        self._chain(self.chain.derivatives, _accelerometer(j, self.size), c, D)
        return D

    def _chain(self, function: Callable[..., Array], j: int, c: Case, found: Array) -> None:
        from generated.folded import disc_angle

        q = self.chain.values_of(j, c.p)
        spin = float(q[1])
        for first, last in cut(len(c.t), len(c.t)):
            b = c.part(first, last)
            phi = disc_angle(b.t, spin) if b.angle is None else b.angle
            found[..., first:last] = function(j, b.t, np.cos(phi), np.sin(phi), b.matrix, q)


def _accelerometer(j: int, count: int) -> int:
    if j not in range(count):
        expected = "0, 1, 2 or 3" if count == 4 else f"0 ... {count - 1}"
        raise UserError("there is no such accelerometer", found=j, expected=expected)
    return j


def _loaded(sources: Mapping[str, str], *, quick: bool = False) -> Library:
    """The library of these sources; made anew where another process has cleared it away before it was opened."""
    built = build(sources, quick=quick)
    try:
        return Library(built.library)
    except BuildError:
        if built.library.exists():
            raise
        return Library(build(sources, quick=quick).library)


_said: list[str] = []


def evaluator(
    chain: Chain,
    sources: Mapping[str, str],
    folded: ModuleType | None,
    backend: Backend = "auto",
    layout: Layout = PAPER,
) -> Evaluator:
    """The evaluator of a model: of its chain in NumPy, its C (file name -> text), its folded form if it has one.

    ``auto``: machine code, or NumPy with a note (once a process) where it cannot be made; ``c``: machine code, or
    UserError.
    """
    if backend not in ("auto", "c", "numpy"):
        raise UserError("unknown backend", found=repr(backend), expected="auto, c or numpy")
    if backend == "numpy":
        return Interpreted(chain, layout, folded)
    try:
        return Compiled(chain, layout, _loaded(sources), "folded.c" in sources)
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
) -> Mapping[str, Evaluator]:
    """Evaluators of generated modules (name -> module) for their derivatives, each made when it is asked for.

    In machine code where ``sources`` holds a module's C and it can be compiled (``quick``: in a third of the time, to code
    that is as fast where memory is what it waits for); else in NumPy, without a note: a fit is a little slower then, and
    the same but for rounding.
    """
    return _ForFits(modules, sources, layout, quick)


class _ForFits(Mapping[str, Evaluator]):
    def __init__(
        self, modules: Mapping[str, Chain], sources: Mapping[str, str], layout: Layout, quick: bool
    ) -> None:
        self._modules, self._sources, self._layout, self._quick = modules, sources, layout, quick
        self._made: dict[str, Evaluator] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(self._modules)

    def __len__(self) -> int:
        return len(self._modules)

    def __getitem__(self, name: str) -> Evaluator:
        if name not in self._made:
            self._made[name] = self._evaluator(name)
        return self._made[name]

    def _evaluator(self, name: str) -> Evaluator:
        module = self._modules[name]
        own = {n: text for n, text in self._sources.items() if n.partition(".")[0] == name}
        if own:
            try:
                library = _loaded(own, quick=self._quick)
                return Compiled(module, self._layout, library, False, name=name)
            except BuildError:
                pass
        return Interpreted(module, self._layout, None)
