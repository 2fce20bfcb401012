"""A derived model over series: as machine code, compiled on first use and called through ctypes, or in NumPy."""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import stretches
from ragg_runtime.instrument.layout import PAPER, Layout
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.compiler import BuildError, build, load

Array = NDArray[np.float64]
Series = Sequence[ArrayLike | None] | NDArray[np.floating]
"""Inputs, one series of N samples each, in the order of the model; ``None``: not recorded, zero (the rate of the disc
angle: 2 pi spin_frequency)."""
Backend = Literal["auto", "c", "numpy"]

BLOCK = 4096
"""Samples that NumPy evaluates at a time, in cache."""

TOGETHER, LONGEST = 16, 128
"""Parameter vectors that the generated C takes at a time for :func:`changes`, and samples of a mean at most."""


class NativeWarning(UserWarning):
    """There is no machine code; the NumPy model serves."""


@dataclass(frozen=True)
class Case:
    """Checked arguments of an evaluation: ``t`` (N,), ``inputs`` n of (N,), ``p`` (size,), ``angle`` (N,); all contiguous."""

    t: Array
    inputs: Sequence[Array]
    p: Array
    angle: Array | None

    def part(self, some: slice) -> Case:
        """Some of the samples."""
        angle = None if self.angle is None else self.angle[some]
        return Case(self.t[some], [x[some] for x in self.inputs], self.p, angle)

    def pointers(self, *between: object) -> list[object]:
        """As the generated C takes them: n, t, in, p, angle; ``between`` stands before p."""
        rows = (ctypes.c_void_p * len(self.inputs))(*(x.ctypes.data for x in self.inputs))
        return [_size(len(self.t)), _at(self.t), rows, *between, _at(self.p), _at(self.angle)]


@dataclass(frozen=True)
class Evaluator:
    """A derived model, in machine code (``library``) or in NumPy.

    Times t in s, (N,); parameters p in SI, in the order of the model's PARAMETERS. ``angle`` is the disc angle, rad, (N,), of
    several discs that of the one whose accelerometers are asked for; by default 2 pi spin_frequency t, reduced exactly. Series
    that are contiguous float64 are used where they lie; others are converted. ``folded``: whether the folded form serves for
    outputs, in NumPy by ``module``. ``name`` is the generated module's.
    """

    chain: Chain
    layout: Layout
    library: ctypes.CDLL | None = None
    folded: bool = False
    module: ModuleType | None = None
    name: str = "chain"

    @property
    def backend(self) -> str:
        return "numpy" if self.library is None else "c"

    @property
    def inputs(self) -> tuple[str, ...]:
        return self.chain.INPUTS

    def output(
        self,
        t: ArrayLike,
        inputs: Series,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        which: int = 0,
    ) -> Array:
        """G_out, or another of the layout's outputs, (N,), V."""
        c = self._case(t, inputs, p, angle)
        G = np.empty(len(c.t))
        own = () if self.layout.like_paper else (which,)
        if self.library is not None:
            self._call("folded" if self.folded else self.name, "output", own, c, G)
        elif self.module is not None:
            for some in stretches(len(G), BLOCK):
                b = c.part(some)
                G[some] = self.module.output(b.t, np.stack(b.inputs), b.p, b.angle, *own)
        else:
            o = self.layout.outputs[which]
            G[:] = o.combined(self._voltages(c, o.members))
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
        return self._voltages(self._case(t, inputs, p, angle), members)

    def _voltages(self, c: Case, members: Sequence[int] | None) -> Array:
        wanted = range(self.layout.size) if members is None else members
        V = np.empty((len(wanted), len(c.t)))
        if self.library is None:
            for v, j in zip(V, wanted, strict=True):
                self._by_numpy(self.chain.accelerometer, j, c, v)
        elif not self.layout.like_paper:
            for v, j in zip(V, wanted, strict=True):
                self._call(self.name, "voltage", (j,), c, v)
        elif tuple(wanted) == (0, 1, 2, 3):
            self._call(self.name, "voltages", (), c, V)
        else:
            return np.asarray(self._voltages(c, None)[list(wanted)])
        return V

    def derivatives(
        self, j: int, t: ArrayLike, inputs: Series, p: ArrayLike, angle: ArrayLike | None = None
    ) -> Array:
        """Derivatives of V_j, j counted from 0, (rows, N), in the order of the chain's ROWS."""
        if j not in range(self.layout.size):
            raise UserError(
                "there is no such accelerometer", found=j, expected=f"0 ... {self.layout.size - 1}"
            )
        c = self._case(t, inputs, p, angle)
        D = np.empty((len(self.chain.ROWS), len(c.t)))
        if self.library is None:
            self._by_numpy(self.chain.derivatives, j, c, D)
        else:
            self._call(self.name, "derivatives", (j,), c, D)
        return D

    def _call(self, model: str, function: str, leading: Sequence[int], c: Case, found: Array) -> None:
        call = getattr(self.library, f"ragg_{model}_{function}")
        call(*map(_size, leading), *c.pointers(), _at(found))

    def _by_numpy(self, function: Callable[..., Array], j: int, c: Case, found: Array) -> None:
        from generated.folded import disc_angle

        q = self.chain.values_of(j, c.p)
        for some in stretches(len(c.t), BLOCK):
            b = c.part(some)
            phi = disc_angle(b.t, float(q[1])) if b.angle is None else b.angle
            found[..., some] = function(j, b.t, np.cos(phi), np.sin(phi), np.stack(b.inputs), q)

    def _case(self, t: ArrayLike, inputs: Series, p: ArrayLike, angle: ArrayLike | None) -> Case:
        names, time = self.chain.INPUTS, _series(t, "t")
        if len(inputs) != len(names):
            expected = f"{len(names)}: {' '.join(names)}"
            raise UserError("wrong number of input series", found=len(inputs), expected=expected)
        values = np.ascontiguousarray(p, dtype=np.float64)
        if values.shape != (self.chain.SIZE,):
            raise UserError("wrong number of parameters", found=values.shape, expected=(self.chain.SIZE,))
        zero = np.zeros(len(time)) if any(x is None for x in inputs) else time
        rows = []
        for name, x in zip(names, inputs, strict=True):
            if x is not None:
                rows.append(_series(x, name, len(time)))
            elif name != "d_spin_angle":
                rows.append(zero)
            elif angle is None:
                spin = values[1 if self.layout.like_paper else self.layout.size]
                rows.append(np.full(len(time), 2 * np.pi * spin))
            else:
                expected = "a series d_spin_angle, rad/s"
                raise UserError("the disc angle is given, but not its rate", expected=expected)
        return Case(time, rows, values, None if angle is None else _series(angle, "angle", len(time)))


def _series(x: ArrayLike, name: str, length: int | None = None) -> Array:
    found = np.ascontiguousarray(x, dtype=np.float64)
    if found.ndim != 1 or (length is not None and len(found) != length):
        expected = "one number per sample" if length is None else f"shape ({length},)"
        raise UserError(f"{name} is no series of samples", found=f"shape {found.shape}", expected=expected)
    return found


_size = ctypes.c_size_t


def _at(x: Array | None) -> Any:
    return ctypes.c_void_p(None if x is None else x.ctypes.data)


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
    if backend != "numpy":
        try:
            return Evaluator(chain, layout, load(build(sources)), "folded.c" in sources)
        except BuildError as error:
            if backend == "c":
                raise UserError("the model cannot be compiled", found=str(error)) from None
            _warn_once(str(error))
    return Evaluator(chain, layout, module=folded)


@cache
def _warn_once(why: str) -> None:
    warnings.warn(
        f"the model is not compiled, the slower NumPy code serves: {why}", NativeWarning, stacklevel=4
    )


def for_fits(
    modules: Mapping[str, Chain], sources: Mapping[str, str], layout: Layout = PAPER, *, quick: bool = False
) -> Callable[[str], Evaluator]:
    """Evaluators of generated modules (name -> module) for their derivatives, each made when it is asked for by name.

    In machine code where ``sources`` holds a module's C and it can be compiled (``quick``: with less effort); else in NumPy.
    """

    def made(name: str) -> Evaluator:
        own = {n: text for n, text in sources.items() if n.partition(".")[0] == name}
        try:
            library = load(build(own, quick=quick)) if own else None
        except BuildError:
            library = None
        return Evaluator(modules[name], layout, library, name=name)

    return cache(made)


def changes(
    e: Evaluator,
    t: Array,
    x: Series,
    p: Array,
    steps: Array,
    angle: Array,
    few: int,
    weights: Array,
    which: int = 0,
) -> Array:
    """Means over ``few`` samples of what small changes of the parameters make of an output, weighted.

    Parameters
    ----------
    t, x, angle
        (N,) s, inputs as of :meth:`Evaluator.output`, (N,) rad.
    p, steps
        (size,) and (k, size), SI.
    weights
        (2, N).

    Returns
    -------
    Array
        (k, 2, N // few), V: means of G_out(p + step) - G_out(p) times the weights.
    """
    count = len(t) // few
    found = np.empty((len(steps), 2, count))
    if e.library is not None and e.folded and e.layout.like_paper and few <= LONGEST:
        weights, c = np.ascontiguousarray(weights), e._case(t, x, p, angle)
        for first in range(0, len(steps), TOGETHER):
            some = slice(first, first + TOGETHER)
            vectors = np.concatenate([p[None], p + steps[some]])
            arguments = Case(c.t, c.inputs, vectors, c.angle).pointers(_size(len(vectors) - 1))
            e.library.ragg_folded_changes(*arguments, _size(few), _at(weights), _at(found[some]))
        return found
    reference = e.output(t, x, p, angle, which=which)
    grouped = weights[:, : count * few].reshape(2, count, few) / few
    for row, step in zip(found, steps, strict=True):
        change = (e.output(t, x, p + step, angle, which=which) - reference)[: count * few]
        row[:] = np.einsum("nf,wnf->wn", change.reshape(count, few), grouped)
    return found
