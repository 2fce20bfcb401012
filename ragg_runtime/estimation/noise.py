"""The noise of a flight: what neither the model nor any candidate effect explains of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import noise_level
from ragg_runtime.estimation.noise_level import Level
from ragg_runtime.estimation.residual import Disturbance
from ragg_runtime.estimation.spectrum import Spectrum
from ragg_runtime.io.record import (
    ANGULAR_ACCELERATION,
    ANGULAR_RATE,
    GRADIENT,
    SPECIFIC_FORCE,
    is_disc_angle,
)
from ragg_runtime.model.record import Record
from ragg_runtime.signals.fir import Floats, fill_gaps, filter_columns

Array = NDArray[np.float64]

MOTION = frozenset((*SPECIFIC_FORCE, *ANGULAR_RATE, *ANGULAR_ACCELERATION, *GRADIENT))
"""Channels whose own values are no quantity for a level, but their sizes."""


@dataclass(frozen=True)
class SpectralLine:
    """A sinusoid in one of the whitened series: Hz, and its amplitude, V; 0 where that is counted with another one next to it."""

    output: int
    frequency: float
    amplitude: float


@dataclass(frozen=True)
class NoiseModel:
    """The noise of an observation of m series (:mod:`noise_estimate`); :meth:`whiten` makes it white, of unit variance.

    It is noise of a spectrum for every whitened series, whose level may follow what is known from sample to sample, and lines. What
    follows it is all of the noise (uniformly modulated noise: M. Priestley, J. R. Stat. Soc. B 27, 1965), or what is new in each sample.
    The filters are causal and finite: linear, hence exact on columns however much larger than the noise they are, and a long record can
    be streamed through them. Samples that are not valid are interpolated, in data and columns alike, as the noise makes most likely
    (:func:`fir.fill_gaps`), and the filters start from rest: what the model explains it explains before and after; only the noise next to
    the start is not perfectly white.

    Attributes
    ----------
    spectra, filters
        Of every whitened series; taps of the filters, 1/V.
    level
        The noise level from sample to sample.
    level_first
        Whether the level multiplies the coloured noise and is divided out before the filters; or the white noise that a filter has
        coloured, and is divided out after them.
    lines
        Those that are neither of the motion nor next to a multiple of the spin rate; they are projected out of data and columns.
    combinations
        (m, m), orthonormal rows: the whitened series are these combinations of the observed ones; ``None``: they are these themselves.
    disturbed
        Which lines and jumps are no part of it, and how its level changes, in words.
    freedom
        Degrees of freedom from which it is known.
    """

    spectra: tuple[Spectrum, ...]
    filters: tuple[Array, ...]
    level: Level = field(default_factory=Level)
    level_first: bool = False
    lines: tuple[SpectralLine, ...] = ()
    combinations: Array | None = field(default=None, compare=False)
    disturbed: str | None = None
    freedom: float = np.inf

    @staticmethod
    def white(rate: float, outputs: int) -> NoiseModel:
        """White noise of 1 V in every series."""
        flat = Spectrum(rate, np.array([0.0, 1.0]), np.zeros(2), np.zeros(2))
        return NoiseModel(spectra=(flat,) * outputs, filters=(np.ones(1),) * outputs)

    @property
    def outputs(self) -> int:
        """Number of whitened series."""
        return len(self.filters)

    @property
    def memory(self) -> int:
        """Samples before one that its whitened value depends on."""
        return max(len(t) for t in self.filters) - 1

    @property
    def uneven(self) -> bool:
        """Whether its level changes."""
        return bool(self.level.parts)

    @property
    def power(self) -> float:
        """V^2, mean over the whitened series, without lines."""
        return float(np.mean([s.rms**2 for s in self.spectra]))

    @property
    def line_power(self) -> float:
        """V^2, of the lines, mean over the series."""
        return sum(x.amplitude**2 / 2 for x in self.lines) / self.outputs

    def line_power_of(self, signs: Array) -> float:
        """V^2, of the lines, of the output in which the series count so (m,)."""
        weights = self.weights(signs)
        return float(sum(weights[x.output] ** 2 * x.amplitude**2 / 2 for x in self.lines))

    def psd(self, f: Array, signs: Array) -> Array:
        """One-sided density at frequencies f, V^2/Hz, of the output in which the series count so (m,)."""
        weights = self.weights(signs) ** 2
        return np.asarray(sum(w * s.psd(f) for w, s in zip(weights, self.spectra, strict=True)))

    def variance(self, signs: Array) -> float:
        """V^2, of that output."""
        weights = self.weights(signs) ** 2
        return float(sum(w * s.rms**2 for w, s in zip(weights, self.spectra, strict=True)))

    def swell(self, r: Record) -> float:
        """Power of all noise of a record over that of the segments that it was estimated from."""
        return float(np.mean(np.square(np.broadcast_to(self.level.of(r.quantity), r.valid.shape)[r.valid])))

    def weights(self, w: Array) -> Array:
        """(outputs,): how what counts so in the series (m,) counts in the whitened ones."""
        return w if self.combinations is None else self.combinations @ w

    def taps(self, most: int) -> list[Array]:
        """The beginnings of the filters, for terms that are searched through shorter ones."""
        return [t[:most] for t in self.filters]

    def whiten(
        self,
        columns: Array,
        valid: NDArray[np.bool_] | None = None,
        level: Array | float = 1.0,
        *,
        lead: int = 0,
    ) -> Array:
        """Columns (n, m, N) V, zero where a sample is not valid, through :meth:`interpolate` and :meth:`filter`."""
        return self.filter(self.interpolate(columns, valid, level), valid, level, lead=lead)

    def divide(self, x: Floats, level: Array | float, *, filtered: bool) -> Floats:
        """Series (..., N), before or after they are ``filtered``, over the level, if it is divided out there."""
        if not self.uneven or filtered is self.level_first:
            return x
        return np.asarray(x / np.asarray(level, dtype=x.dtype))

    def interpolate(
        self, columns: Array, valid: NDArray[np.bool_] | None = None, level: Array | float = 1.0
    ) -> Array:
        """(n, outputs, N): what the filters take of columns (n, m, N), gaps filled as the noise makes most likely."""
        x = columns
        if self.combinations is not None:
            x = np.matmul(self.combinations, columns)
        x = self.divide(x, level, filtered=False)
        if valid is None or valid.all():
            return x
        return np.stack([fill_gaps(x[:, k], valid, taps) for k, taps in enumerate(self.filters)], axis=1)

    def filter(
        self,
        series: Array,
        valid: NDArray[np.bool_] | None = None,
        level: Array | float = 1.0,
        *,
        tail: Array | None = None,
        lead: int = 0,
    ) -> Array:
        """Series through the filters, over the level.

        Parameters
        ----------
        series
            (n, outputs, N): of :meth:`interpolate`.
        valid
            (N,): which samples are wanted; ``None``: all.
        level
            (N,) or one number: :attr:`level` at these samples.
        tail
            (n, outputs, T): the samples before them; ``None``: the filters start from rest.
        lead
            First samples that are not wanted.

        Returns
        -------
        (n, rows): one output after the other.
        """
        after = level if np.ndim(level) == 0 else np.asarray(level)[lead:]

        def through(k: int) -> Array:
            y = filter_columns(series[:, k], self.filters[k], None if tail is None else tail[:, k], lead)
            y = self.divide(y, after, filtered=True)
            return y if valid is None or valid.all() else y[:, valid[lead:]]

        if self.outputs == 1:
            return through(0)
        return np.concatenate([through(k) for k in range(self.outputs)], axis=1)

    def line_columns(self, time: Array, series: int) -> Array:
        """(k, m, n): what the lines span at some times, s, each in its own of the m ``series``."""
        shown = np.eye(series) if self.combinations is None else self.combinations
        found = [
            Disturbance("line", x.frequency).columns(time)[:, None] * shown[x.output][:, None]
            for x in self.lines
        ]
        return np.concatenate(found) if found else np.empty((0, series, len(time)))

    def variance_shapes(self, r: Record) -> Array:
        """(k, rows): what the variance of whitened samples may follow (:func:`noise_level.make_shapes`), one output after the other."""
        found = noise_level.make_shapes(r.quantity, level_quantities(r), self.level)[:, r.valid]
        return np.tile(found, self.outputs)


def level_quantities(r: Record) -> list[str]:
    """Names of what a level of noise may follow in a record."""
    names = ["time", *(f"abs({c})" for c in SPECIFIC_FORCE if c in r.wide)]
    names += [f"abs({c[0][:-2]})" for c in (ANGULAR_RATE, ANGULAR_ACCELERATION) if set(c) <= set(r.wide)]
    if set(SPECIFIC_FORCE) <= set(r.wide):
        names += ["abs(a)", "input-rms", *(("input",) if r.turning else ())]
        names += [f"input({k})" for k in r.different_axes] if len(r.different_axes) > 1 else []
    names += sorted(n for n in r.wide if n not in MOTION and not is_disc_angle(n))
    names += ["phi"] if r.turning else []
    return names
