"""Flights with all removed that a model explains: the gravity gradient as the instrument saw it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.compensation import frozen
from ragg_runtime.compensation.calibrated import information, inverse
from ragg_runtime.compensation.drift import smooth_drift
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.compensation.series import (
    MEANING,
    Quality,
    Series,
    Setting,
    Stretch,
    basis,
    contributions,
    crossed,
    series,
    whole,
)
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import ROWS, Observation, Segment, observations_of, spread
from ragg_runtime.estimation.scores import Tally, finite
from ragg_runtime.estimation.spectrum import periodogram
from ragg_runtime.estimation.unknown_gradient import spin_frequency
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import sees
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io import Flight
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import MANY, Model
from ragg_runtime.signals.demodulators import Demodulator, demodulator
from ragg_runtime.signals.derivative import runs

Array = NDArray[np.float64]

BAND = (0.02, 0.15)
"""Frequencies, Hz, over which a density is averaged: below, the survey's own signal is larger; above, low-passes differ."""

WINDOW = 128.0
"""Length of the windows of a measured density, s."""

GRID = 4001
"""Frequencies at which the noise is integrated."""


def of_noise(o: Observation, noise: NoiseModel, d: Demodulator, k_ggi: float) -> tuple[float, float]:
    """Standard deviations of inline and cross, Eo, that stationary noise of G_out causes; ``k_ggi`` in V/Eo."""
    f = np.linspace(-0.5, 0.5, GRID)
    carrier = 2 * spin_frequency(o)
    passed = np.abs(d.response(f)) ** 2 * noise.psd(np.abs(carrier + f), o.signs)
    cross = float(np.sqrt(np.sum(passed) * (f[1] - f[0]))) / k_ggi
    return 2 * cross, cross


class Density:
    """Mean density of a series over :data:`BAND`, from segment after segment."""

    def __init__(self, rate: float) -> None:
        self.rate = rate
        self.total, self.windows = np.zeros(2), 0.0

    def add(self, g: NDArray[np.complex128]) -> None:
        """Count in inline + i cross; NaN: none."""
        n = int(WINDOW * self.rate)
        for run in runs(np.isfinite(g.real)):
            x = g[run]
            if len(x) < n:
                continue
            count = len(x) // n
            parts = np.stack([x.real, x.imag])[:, : count * n].reshape(2 * count, n)
            slope = np.linspace(-1.0, 1.0, n)
            even = parts - np.outer((parts @ slope) / (slope @ slope), slope)  # what is left of a drift
            f, density = periodogram(even, self.rate)
            p = np.mean(density.reshape(2, count, -1), axis=1)
            inside = (f >= BAND[0]) & (f <= BAND[1])
            self.total += count * np.mean(p[:, inside], axis=1)
            self.windows += count

    def as_json(self) -> dict[str, float | None]:
        if not self.windows:
            return {"inline_Eo_per_rtHz": None, "cross_Eo_per_rtHz": None}
        inline, cross = np.sqrt(self.total / self.windows)
        return {"inline_Eo_per_rtHz": float(inline), "cross_Eo_per_rtHz": float(cross)}


Kind = Literal["frozen", "self", "crossed", "smoothed"]
KINDS: tuple[Kind, ...] = ("self", "crossed", "smoothed", "frozen")

NEGLECTED = 0.01
"""Share of the noise's variance that directions of the parameters may add which are left out of the uncertainty."""

SEARCHED = 4
"""Stretches of a flight, of some minutes, on which the directions that matter are sought."""


def without_gradients(flight: Flight) -> Flight:
    """A flight without recorded gradients: nothing of them shall get into what is compensated."""
    channels = {n: x for n, x in flight.channels.items() if n not in GRADIENT}
    return replace(flight, channels=channels) if len(channels) < len(flight.channels) else flight


@dataclass(frozen=True)
class Prepared:
    """Flights with the parameters that compensate them. ``seeing``: observations that see a gradient on a turning disc;
    ``validity`` and ``change`` only if frozen.
    """

    kind: Kind
    model: Model
    instrument: Instrument
    flights: tuple[Flight, ...]
    observations: tuple[Observation, ...]
    seeing: tuple[int, ...]
    calibration: Calibration
    stretches: tuple[tuple[Stretch, ...], ...]
    converged: bool
    validity: dict[str, tuple[float, float]]
    change: frozen.Change | None

    def of_flight(self, k: int) -> list[int]:
        """The observations of a flight that are compensated."""
        return [n for n in self.seeing if self.observations[n].flight == k]


@one_thread
def prepared(
    model: Model, instrument: Instrument, flights: Sequence[Flight], kind: Kind, saved: Saved | None = None
) -> Prepared:
    """Calibrate on the flights (``self``, ``crossed``, ``smoothed``), or take what was saved (``frozen``)."""
    if kind not in KINDS:
        raise UserError("there is no such calibration", found=repr(kind), expected=", ".join(KINDS))
    flights = tuple(without_gradients(x) for x in flights)
    observations = tuple(observations_of(flights, instrument))
    sighted = seeing(instrument, observations)
    validity: dict[str, tuple[float, float]] = {}
    change: frozen.Change | None = None
    if kind == "frozen":
        if saved is None:
            raise UserError("a frozen compensation needs a saved calibration")
        c = frozen.calibration(saved, model, instrument, observations)
        root = frozen.root(saved, model, instrument)
        stretches = [whole(c, root, len(o.record.time)) for o in observations]
        settled, validity = saved.converged, dict(saved.validity)
        change = frozen.looked(model, instrument, observations, saved, c)
    else:
        f = fit(model, instrument, observations)
        c, settled = f.calibration, f.calibration.converged
        root = inverse(information(f))
        if kind == "crossed":
            stretches = crossed(f)
        elif kind == "smoothed":
            stretches = smooth_drift(f, flights).stretches()
        else:
            stretches = [whole(c, root, len(o.record.time)) for o in observations]
    return Prepared(
        kind=kind,
        model=model,
        instrument=instrument,
        flights=flights,
        observations=observations,
        seeing=sighted,
        calibration=c,
        stretches=tuple(stretches),
        converged=settled,
        validity=validity,
        change=change,
    )


def seeing(instrument: Instrument, observations: Sequence[Observation]) -> tuple[int, ...]:
    """Those that see a gradient on a turning disc; UserError if there is none."""
    a = instrument.accelerometers
    k1, R = a["k_VI"] * a["K1"], instrument.radii + a["dR"]
    found = tuple(n for n, o in enumerate(observations) if o.record.turning and sees(o.output, k1, R))
    if observations and not found:
        raise UserError(
            "there is no gradient to compensate: no output sees one on a disc that turns",
            where=instrument.path,
            found=", ".join(
                f"{o.output.name}: disc {'turns' if o.record.turning else 'stands still'}"
                for o in observations
            ),
            expected="a turning disc with accelerometers whose sum does not cancel the gradient",
            remedy="calibrate and compare say how good the model is of such an instrument",
        )
    return found


class Compensated:
    """One output of a flight being compensated: its series come from :meth:`segments`, once."""

    def __init__(self, p: Prepared, k: int, name: str) -> None:
        o = p.observations[k]
        self.flight = p.flights[o.flight]
        rate = o.record.rate
        self.demodulator = demodulator(name, rate)
        _long_enough(self.flight, self.demodulator)
        k_ggi = scale_factor(p.model, p.calibration.p, o.place)
        noise = of_noise(o, p.calibration.noise[k], self.demodulator, k_ggi)
        self.model, self.instrument = p.model, p.instrument
        many = len(self.flight.time) >= MANY
        s = Setting(
            model=p.model,
            evaluator=p.model.compiled("auto" if many else "numpy"),
            demodulator=self.demodulator,
            observation=o,
            recorded=_recorded(self.flight, o, p.instrument.scale_factor * EOTVOS / k_ggi),
            stretches=p.stretches[k],
            noise=noise,
            validity=p.validity,
            sheet=vector(p.model, p.instrument),
        )
        sought = self._parts(most=max(4096, 2 * len(self.demodulator.taps)))
        U, rest = basis(s, [x.rows for x in spread(sought, SEARCHED)], NEGLECTED)
        self.setting = replace(s, stretches=tuple(x.along(U) for x in s.stretches), rest=rest)
        self.k_ggi, self.after = k_ggi, Density(rate / s.every)
        self.before = Tally(1, 1, rate, turning=o.record.turning)
        self.count = 0
        self.holds = p.change is None or p.change.holds
        self.bits = dict.fromkeys(Quality, 0)
        self.squares, self.good = np.zeros(2), 0

    def _rows(self) -> int:
        return max(ROWS, 4 * len(self.demodulator.taps))

    def _parts(self, most: int) -> list[Segment]:
        n = len(self.flight.time)
        count = max(1, -(-n // most))
        edges = np.linspace(0, n, count + 1).astype(int)
        return [Segment(slice(int(a), int(b)), ()) for a, b in pairwise(edges)]

    def segments(self) -> Iterator[Series]:
        """The compensated series, segment after segment, in order of time."""
        holes = not bool(np.all(self.setting.observation.record.valid))
        parts = [x.rows for x in self._parts(self._rows())]
        for rows in parts:
            x = series(self.setting, rows, holes=holes)
            if not self.holds:
                x = replace(x, quality=x.quality | int(Quality.CALIBRATION))
            self._count(x)
            progress.step(float(len(x.quality)))
            yield x

    def _count(self, x: Series) -> None:
        self.before.join(Tally.of(x.nominal, self.demodulator.rate))
        self.after.add(x.gradient[:: self.setting.every])
        self.count += len(x.quality)
        if x.quality.any():
            for q in Quality:
                self.bits[q] += int(np.count_nonzero(x.quality & q))
        good = x.good
        self.good += int(np.count_nonzero(good))
        self.squares += np.sum(np.square(x.parameters if good.all() else x.parameters[:, good]), axis=1)

    def as_json(self) -> dict[str, Any]:
        """What was done and how good it is; after all segments."""
        noise = dict(zip(("inline_Eo", "cross_Eo"), map(finite, self.setting.noise), strict=True))
        rms = np.sqrt(self.squares / self.good) if self.good else np.full(2, np.nan)
        expected = [finite(x / np.sqrt(self.demodulator.bandwidth)) for x in self.setting.noise]
        return {
            "flight": self.flight.name,
            "output": self.setting.observation.output.name,
            "samples": self.count,
            "good": self.good,
            "quality": {q.name: n for q, n in self.bits.items()},
            "density": {
                "band_Hz": list(BAND),
                "before": {
                    k: x for k, x in self.before.error(0, self.k_ggi).as_json().items() if k.endswith("rtHz")
                },
                "after": self.after.as_json(),
                "noise": dict(zip(("inline_Eo_per_rtHz", "cross_Eo_per_rtHz"), expected, strict=True)),
            },
            "std": {
                "noise": noise,
                "parameters": dict(zip(("inline_Eo", "cross_Eo"), map(finite, rms), strict=True)),
                "directions": len(self.setting.stretches[0].directions),
            },
            "contributions": contributions(
                self.setting,
                [x.rows for x in spread(self._parts(self._rows()), 2)],
                self.model,
                self.instrument,
            ),
        }


def _long_enough(flight: Flight, d: Demodulator) -> None:
    least = sum(d.settling) + 1
    if len(flight.time) < least:
        raise UserError(
            "the record is too short for the demodulator",
            where=flight.path or flight.name,
            found=f"{flight.duration:.4g} s",
            expected=f"at least {least / d.rate:.3g} s for {d.name}",
            remedy="give a longer recording, or choose another --demodulator",
        )


def _recorded(flight: Flight, o: Observation, factor: float) -> NDArray[np.complex128] | None:
    """inline + i cross, Eo, of a flight that its recorder demodulated: put right for the calibrated scale factor."""
    if not o.recorded.demodulated:
        return None
    g = flight.outputs["inline"] + 1j * flight.outputs["cross"]
    return np.asarray(g * (factor / EOTVOS))


def meaning() -> dict[str, str]:
    """Bit of ``quality`` -> what it says."""
    return {str(int(q)): f"{q.name}: {text}" for q, text in MEANING.items()}
