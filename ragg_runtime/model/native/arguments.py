"""Arguments of an evaluation, checked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeGuard

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.model.chain import Chain

Array = NDArray[np.float64]
Series = Sequence[ArrayLike | None] | NDArray[np.floating]
"""Inputs, one series of N samples each, in the order of the model; ``None``: not recorded, zero (the rate of the disc
angle: 2 pi spin_frequency)."""


def address(x: Array) -> int:
    """Where an array begins."""
    return x.ctypes.data


@dataclass(frozen=True)
class Case:
    """Checked arguments: contiguous series, the inputs as rows of a matrix where they came as one."""

    t: Array
    inputs: Array | tuple[Array, ...]
    p: Array
    angle: Array | None

    @property
    def matrix(self) -> Array:
        """(n_inputs, N)."""
        return self.inputs if isinstance(self.inputs, np.ndarray) else np.stack(self.inputs)

    @property
    def addresses(self) -> list[int]:
        """Where each input series begins."""
        if isinstance(self.inputs, np.ndarray):
            first, step = address(self.inputs), self.inputs.strides[0]
            return [first + step * k for k in range(len(self.inputs))]
        return [address(x) for x in self.inputs]

    def part(self, some: slice) -> Case:
        """Some of the samples."""
        angle = None if self.angle is None else self.angle[some]
        return Case(self.t[some], self.matrix[:, some], self.p, angle)


@dataclass(frozen=True)
class Base:
    """What both backends share: arguments are checked, series cut, parts put together."""

    chain: Chain
    layout: Layout

    @property
    def size(self) -> int:
        """Number of accelerometers."""
        return self.layout.size

    @property
    def several(self) -> bool:
        """Whether the generated code is that of a layout other than the paper's, function by accelerometer."""
        return not self.layout.like_paper

    @property
    def inputs(self) -> tuple[str, ...]:
        return self.chain.INPUTS

    def case(self, t: ArrayLike, inputs: Series, p: ArrayLike, angle: ArrayLike | None) -> Case:
        """Arguments of an evaluation, checked."""
        time = _series(t, "t")
        if len(inputs) != len(self.chain.INPUTS):
            names = " ".join(self.chain.INPUTS)
            raise UserError(
                "wrong number of input series",
                found=len(inputs),
                expected=f"{len(self.chain.INPUTS)}: {names}",
            )
        values = np.ascontiguousarray(p, dtype=np.float64)
        if values.shape != (self.chain.SIZE,):
            raise UserError("wrong number of parameters", found=values.shape, expected=(self.chain.SIZE,))
        phi = None if angle is None else _series(angle, "angle", len(time))
        spin = 2 * np.pi * float(values[self.size if self.several else 1]) if phi is None else None
        rows = inputs if _is_matrix(inputs, len(time)) else self._each(inputs, len(time), spin)
        return Case(time, rows, values, phi)

    def _each(self, inputs: Series, length: int, spin: float | None) -> tuple[Array, ...]:
        zero: Array | None = None
        rows: list[Array] = []
        for name, x in zip(self.chain.INPUTS, inputs, strict=True):
            if x is None and name == "d_spin_angle":
                if spin is None:
                    raise UserError(
                        "the disc angle is given, but not its rate", expected="a series d_spin_angle, rad/s"
                    )
                rows.append(np.full(length, spin))
            elif x is None:
                zero = np.zeros(length) if zero is None else zero
                rows.append(zero)
            else:
                rows.append(_series(x, name, length))
        return tuple(rows)


def _is_matrix(x: Series, length: int) -> TypeGuard[Array]:
    """Whether series are the contiguous rows of a float64 matrix, to be used where they lie."""
    return (
        isinstance(x, np.ndarray)
        and x.dtype == np.float64
        and x.dtype.isnative
        and x.ndim == 2
        and x.shape[1] == length
        and (x.strides[1] == x.itemsize or length <= 1)
        and x.flags.aligned
    )


def _series(x: ArrayLike, name: str, length: int | None = None) -> Array:
    found = np.ascontiguousarray(x, dtype=np.float64)
    if found.ndim != 1 or (length is not None and len(found) != length):
        raise UserError(
            f"{name} is no series of samples",
            found=f"shape {found.shape}",
            expected="one number per sample" if length is None else f"shape ({length},)",
        )
    return found


def into(out: Array | None, length: int) -> Array:
    if out is None:
        return np.empty(length)
    if out.dtype != np.float64 or out.shape != (length,) or not out.flags.carray:
        raise UserError(
            "out cannot be written to",
            found=f"{out.dtype}, shape {out.shape}",
            expected=f"contiguous float64, shape ({length},)",
        )
    return out
