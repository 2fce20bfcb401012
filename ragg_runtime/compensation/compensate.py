"""Flights with all removed that a model explains: the gravity gradient as the instrument saw it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import IntFlag
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread, split_range
from ragg_runtime.compensation.calibrate import (
    CalibrationChange,
    Saved,
    describe_saved,
    fit_r_factors,
    information,
    invert_root,
    list_base_r_factors,
    make_calibration,
    move_parameters,
    retest_change,
    saved_calibration,
    warn_of_change,
)
from ragg_runtime.compensation.drift import find_starts, smooth_drift
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import (
    ROWS,
    Observation,
    combine_output,
    divide_into_segments,
    make_block_edges,
    observe_flights,
    spread,
)
from ragg_runtime.estimation.regressors import Column, put_derivatives
from ragg_runtime.estimation.scores import finite, measure_error
from ragg_runtime.estimation.unknown_gradient import Block, ModelledOutput, measure_spin_frequency
from ragg_runtime.identification.comparison import compute_residual
from ragg_runtime.instrument.instrument import PARAMETERS, Instrument
from ragg_runtime.instrument.layout import column_endings, sees
from ragg_runtime.io import Flight
from ragg_runtime.io.files import write_tables
from ragg_runtime.io.record import GRADIENT, require_distinct
from ragg_runtime.io.tables import DataColumn, DataTable
from ragg_runtime.model.model import Model, find_unit_factor, make_vector, scale_factor
from ragg_runtime.signals.demodulators import COMPONENTS, find_demodulator, solve_tensor
from ragg_runtime.signals.derivative import runs
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.sections import render_notebook
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

# share of the kernel that may fall on missing samples; they are bridged by the gradient found around them
HOLES = 0.05
FELT = 1e-4  # share of the kernel on missing samples from which their bridging is reported
# rate, Hz, at which the uncertainty is followed: what the low-pass lets through does not change faster than 0.25 Hz
FINE = 4.0
MARGIN = 0.1  # by this share of its calibrated range a channel may go beyond it before that is flagged

# frequencies, Hz, over which a density is averaged: below, the survey's own signal is larger; above, low-passes differ
BAND = (0.02, 0.15)
WINDOW = 128.0  # length of the windows of a measured density, s

Kind = Literal["frozen", "self", "crossed", "smoothed"]
# samples of a flight, their parameters (n,) less the calibrated ones, and a root (n, m) of the covariance, in scales
Part = tuple[slice, "Array | float", Array]

KINDS: tuple[Kind, ...] = ("self", "crossed", "smoothed", "frozen")


# --- the gradient by one output of a flight: the series, its uncertainty, and a quality for each sample ---


class Quality(IntFlag):
    """Bits of ``quality``; 0 is good."""

    EDGE = 1
    GAP = 2
    BRIDGED = 4
    MOTION = 8
    AUXILIARY = 16
    CALIBRATION = 32


NO_VALUE = Quality.EDGE | Quality.GAP  # bits of samples without a value

MEANING = {
    Quality.EDGE: "too near an end of the record for the low-pass: no value",
    Quality.GAP: "with more than 5 % of the samples missing under the low-pass: no value",
    Quality.BRIDGED: "with a missing or saturated sample that was bridged",
    Quality.MOTION: "with a motion channel outside its range in the saved calibration",
    Quality.AUXILIARY: "with another channel outside its range in the saved calibration",
    Quality.CALIBRATION: "by a calibration that does not hold for this flight",
}
"""Meaning of each bit."""


@dataclass(frozen=True)
class Compensated:
    """Compensated samples.

    ``gradient`` (N,): inline + i cross, Eo, NaN where there is none. ``parameters`` (2, N): standard deviations by the parameters, Eo;
    ``std`` (2, N): with the noise. ``quality`` (N,): bits of :class:`Quality`.
    """

    gradient: Complex
    parameters: Array
    std: Array
    quality: NDArray[np.int64]


@dataclass(frozen=True)
class OutputChannel(ModelledOutput):
    """One output of a flight, with what compensates it; ``about`` are the calibrated parameters.

    ``columns``: those fitted. ``noise``: of the output. ``recorded``: inline + i cross (N,), Eo, if the flight was demodulated by its
    recorder. ``validity``: channel -> range, SI; empty: not flagged. ``flags``: bits of the quality of all samples.
    """

    columns: tuple[Column, ...]
    noise: NoiseModel
    recorded: Complex | None
    validity: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    flags: int = 0

    @property
    def noise_std(self) -> Array:
        """(2,): standard deviations of inline and cross, Eo, that stationary noise of the output causes."""
        carrier, signs = 2 * measure_spin_frequency(self.observation), self.observation.signs
        power = self.demodulator.pass_power(lambda f: self.noise.psd(f, signs), carrier)
        return np.array([2.0, 1.0]) * float(np.sqrt(power)) / self.find_scale_factor(self.about)

    def estimate_first(self, bare: Array) -> Complex:
        if self.recorded is None:
            return super().estimate_first(bare)
        recorded = np.where(self.observation.record.valid, self.recorded, 0.0)
        return np.asarray(recorded - self.demodulate(bare))

    def compensate(self) -> Compensated:
        """The gradient at all samples."""
        g = self.estimate_gradient()
        variance, bits = self.propagate_parameters(g), self.flag_samples()
        parameters = np.sqrt(variance)
        std = np.sqrt(variance + self.noise_std[:, None] ** 2)
        none = (bits & NO_VALUE) != 0
        g[none] = complex(np.nan, np.nan)
        parameters[:, none] = std[:, none] = np.nan
        return Compensated(g, parameters, std, bits)

    def propagate_parameters(self, g: Complex) -> Array:
        """(2, N) Eo^2: variance of inline and cross by the parameters, beside a gradient (N,), Eo."""
        step = max(1, int(self.demodulator.rate // FINE))
        count = len(g) // step
        deviations = np.empty(
            (self.blocks[0].root.shape[1], 2, count)
        )  # independent steps of one standard deviation
        for means in split_range(count, ROWS // step):
            change = self._change_by_parameters(slice(means.start * step, means.stop * step), g, step)
            for b in self.blocks:
                # a mean that two blocks share is that of the first
                first = max(-(-b.rows.start // step), means.start)
                last = min(-(-b.rows.stop // step), means.stop)
                if first < last:
                    changes = change[..., first - means.start : last - means.start]
                    deviations[..., first:last] = np.tensordot(b.root.T, changes, 1)
            progress.step(float(step * (means.stop - means.start)))
        low_pass = find_demodulator(self.demodulator.name, self.demodulator.rate / step)
        total = sum((low_pass.low_pass(x) ** 2 for x in deviations), np.zeros((2, count)))
        centres = step * np.arange(count) + (step - 1) / 2  # the variance is linear between them
        return np.stack([np.interp(np.arange(len(g)), centres, x) for x in total])

    def _change_by_parameters(self, rows: slice, g: Complex, step: int) -> Array:
        """(n, 2, rows / step) Eo: inline and cross by each parameter's scale, before the low-pass; means of ``step`` samples."""
        r, x, moved = self.make_inputs(rows, g)
        o, count = self.observation, len(r.time) // step
        J = np.zeros((len(self.columns), len(o.series), len(r.time)))
        inputs, p = (r.time, x, r.phi), self.about - moved
        put_derivatives(J, self.model.chain, self.columns, inputs, p, o.recorded, o.output)
        mixer = np.stack([self.mixer[rows].real, self.mixer[rows].imag]).reshape(2, count, step) / step
        return np.asarray(np.einsum("wcf,ncf->nwc", mixer, combine_output(o, J).reshape(len(J), count, step)))

    def flag_samples(self) -> NDArray[np.int64]:
        """(N,): bits of the samples."""
        r, d = self.observation.record, self.demodulator
        bits = np.full(len(r.time), self.flags, dtype=np.int64)
        head, tail = d.settling
        bits[:head] |= Quality.EDGE
        bits[len(bits) - tail :] |= Quality.EDGE
        missing = ~r.valid
        if self.recorded is not None:
            bits[missing] |= Quality.GAP
        elif missing.any():
            weights = replace(d, taps=np.abs(d.taps) / np.sum(np.abs(d.taps)))
            share = weights.low_pass(missing.astype(np.float64))
            bits[share > HOLES] |= Quality.GAP
            bits[(share > FELT) & (share <= HOLES) & (bits & NO_VALUE == 0)] |= Quality.BRIDGED
        for name, (low, high) in self.validity.items():
            x = r.channels.get(name)
            if x is None or name in ("time", "spin_angle", *GRADIENT):
                continue
            moving = name.partition("_")[0] in ("a", "omega", "omegadot")
            beyond = np.maximum(low - x, x - high) > MARGIN * (high - low)
            bits[beyond] |= Quality.MOTION if moving else Quality.AUXILIARY
        return bits


def leave_out_gradients(flight: Flight) -> Flight:
    """A flight without recorded gradients, which must not enter what is compensated."""
    channels = {n: x for n, x in flight.channels.items() if n not in GRADIENT}
    return replace(flight, channels=channels) if len(channels) < len(flight.channels) else flight


@dataclass(frozen=True)
class Compensation:
    """The result of ``compensate``; ``series`` are the columns (name -> (N,)) of every flight."""

    name: str
    result: Mapping[str, Any]
    series: tuple[Mapping[str, NDArray[Any]], ...]

    def __repr__(self) -> str:
        flights = ", ".join(x["flight"] for x in self.result["flights"])
        return f"<compensation of {flights} by {self.name}, {self.result['calibration']}>"

    def _repr_html_(self) -> str | None:
        online = self.result["calibration"] == "online"
        return None if online else render_notebook(describe_other.describe_compensation(self.as_json(), ""))

    def as_json(self) -> dict[str, Any]:
        """As ``ragg compensate --json`` writes it, with what the bits of ``quality`` mean."""
        meaning = {str(int(q)): f"{q.name}: {text}" for q, text in MEANING.items()}
        return {**self.result, "quality": meaning}

    def write(self, path: Path | str) -> None:
        """Write the series of all flights, one after the other; the ending of the path names the format.

        Each begins and ends with a value; values have the digits that their uncertainty warrants, and one more.
        """
        parts = [_trim_ends(s) for s in self.series]
        joined = {n: np.concatenate([s[n] for s in parts]) for n in parts[0]}
        columns = [DataColumn(n, _find_unit(n), _round(n, joined)) for n in joined]
        write_tables(Path(path), [DataTable(tuple(columns))])


def _find_unit(column: str) -> str:
    if column == "time":
        return "s"
    return "1" if column == "flight" or column.startswith(("quality", "closure")) else "Eo"


def _trim_ends(series: Mapping[str, NDArray[Any]]) -> Mapping[str, NDArray[Any]]:
    """The rows from the first to the last in which a channel has a value; all if none has."""
    stds = [x for n, x in series.items() if n.endswith("_std")]
    rows = np.flatnonzero(np.any(np.isfinite(stds), axis=0))
    if not len(rows):
        return series
    return {n: x[rows[0] : rows[-1] + 1] for n, x in series.items()}


def _round(name: str, columns: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    """A column to the second digit of the least of its standard deviations."""
    x = columns[name]
    if name.startswith("closure"):
        return np.round(x, 2)
    std = columns.get(name if name.endswith("_std") else f"{name}_std", np.zeros(0))
    positive = std[np.isfinite(std) & (std > 0.0)]
    if not len(positive):
        return x
    digits = 1 - int(np.floor(np.log10(np.min(positive))))
    return np.round(x, digits + name.endswith("_std"))


# --- parameters ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class PreparedFlights:
    """Flights with the parameters that compensate them.

    ``channels``: of every flight the outputs that see a gradient on a turning disc. ``change``: only if frozen.
    """

    flights: tuple[Flight, ...]
    channels: tuple[tuple[OutputChannel, ...], ...]
    calibration: Calibration
    change: CalibrationChange | None


@one_thread
def prepare(
    model: Model,
    instrument: Instrument,
    flights: Sequence[Flight],
    kind: Kind,
    demodulator: str = "fir",
    saved: Saved | None = None,
) -> PreparedFlights:
    """Calibrate on the flights (``self``, ``crossed``, ``smoothed``), or take what was saved (``frozen``).

    Raises
    ------
    UserError
        If no output of the instrument sees a gradient, a flight is too short for the demodulator, or there is no such kind of
        calibration.
    """
    if kind not in KINDS:
        raise UserError("there is no such calibration", found=repr(kind), expected=", ".join(KINDS))
    flights = tuple(leave_out_gradients(x) for x in flights)
    observations = observe_flights(flights, instrument, whole=True)
    seeing = find_sensitive(instrument, observations)
    change: CalibrationChange | None = None
    if saved is not None:
        c, root = make_calibration(saved, model, instrument, observations), invert_root(saved.information)
        change = retest_change(model, instrument, observations, saved, c)
    else:
        # constant parameters leave the drift, which is no noise: it is followed from where they leave the smallest rms
        f = fit(model, instrument, observations, unweighted=kind == "smoothed", candidates=False)
        c, root = f.calibration, invert_root(information(f))
    parts: list[Iterable[Part]] = [[(slice(0, len(o.record.time)), 0.0, root)] for o in observations]
    if kind == "crossed":
        parts = [follow_others(f, o) for o in observations]
    elif kind == "smoothed":
        d = smooth_drift(f, flights)
        c, parts = d.f.calibration, [d.follow(o.flight) for o in observations]
    broken = 0 if change is None or change.holds else int(Quality.CALIBRATION)
    channels: list[list[OutputChannel]] = [[] for _ in flights]
    for n in seeing:
        o = observations[n]
        x = _make_channel(model, instrument, flights[o.flight], o, c, c.noise[n], parts[n], demodulator)
        channels[o.flight].append(replace(x, validity=saved.validity if saved else {}, flags=broken))
    return PreparedFlights(flights, tuple(map(tuple, channels)), c, change)


def follow_others(f: Fitted, o: Observation) -> Iterator[Part]:
    """The blocks of time of an observation, each with the parameters that all others give."""
    r_factors = [
        ((x.flight, b), T)
        for k, x in enumerate(f.observations)
        for b, T in enumerate(list_base_r_factors(f, k))
    ]
    edges = make_block_edges(len(o.record.time)).tolist()
    for b, (first, last) in enumerate(pairwise(edges)):
        yield slice(first, last), *fit_r_factors(f, [T for place, T in r_factors if place != (o.flight, b)])


def _make_channel(
    model: Model,
    instrument: Instrument,
    flight: Flight,
    o: Observation,
    c: Calibration,
    noise: NoiseModel,
    parts: Iterable[Part],
    demodulator: str,
) -> OutputChannel:
    """An observation ready to be compensated; UserError if the flight is too short for the demodulator."""
    d = find_demodulator(demodulator, o.record.rate)
    needed = sum(d.settling) + 1
    if len(flight.time) < needed:
        raise UserError(
            "the record is too short for the demodulator",
            where=flight.path or flight.name,
            found=f"{flight.duration:.4g} s",
            expected=f"at least {needed / d.rate:.3g} s for {d.name}",
            remedy="give a longer recording, or choose another --demodulator",
        )
    recorded: Complex | None = None
    if o.recorded.demodulated:  # by its recorder: put right for the calibrated scale factor
        gradient: Complex = flight.outputs["inline"] + 1j * flight.outputs["cross"]
        recorded = gradient * (instrument.scale_factor / scale_factor(model, c.p, o.place))
    return OutputChannel(
        model=model,
        observation=o,
        about=c.p,
        blocks=tuple(Block(rows, move_parameters(c, step), root) for rows, step, root in parts),
        demodulator=d,
        columns=c.columns,
        noise=noise,
        recorded=recorded,
    )


def find_sensitive(instrument: Instrument, observations: Sequence[Observation]) -> tuple[int, ...]:
    """Positions of the observations that are sensitive to a gradient, on a turning disc; UserError if there is none."""
    a = instrument.accelerometers
    k1, R = a["k_VI"] * a["K1"], instrument.radii + a["dR"]
    positions = tuple(n for n, o in enumerate(observations) if o.record.turning and sees(o.output, k1, R))
    if observations and not positions:
        raise UserError(
            "there is no gradient to compensate: no output of a spinning disc is sensitive to it",
            where=instrument.path,
            found=", ".join(o.name for o in observations),
            expected="a turning disc with accelerometers whose sum does not cancel the gradient",
            remedy="use calibrate and compare for such an instrument",
        )
    return positions


# --- descriptions ------------------------------------------------------------------------------


def describe_channel(c: OutputChannel, x: Compensated, instrument: Instrument) -> dict[str, Any]:
    """A compensated channel and its quality, for JSON."""
    o, d = c.observation, c.demodulator
    has_value = np.isfinite(x.gradient.real)
    rms = np.sqrt(np.mean(x.parameters[:, has_value] ** 2, axis=1)) if has_value.any() else np.full(2, np.nan)
    sheet = make_vector(c.model, instrument)
    residual = compute_residual(c.model, o, sheet, c.noise)
    nominal = measure_error(residual, o.record, c.find_scale_factor(c.about)).as_json()
    step = max(1, int(d.rate))  # the channels hold nothing above half a hertz
    return {
        "flight": o.flight_name,
        "output": o.output.name,
        "samples": len(has_value),
        "values": int(np.sum(has_value)),
        "good": int(np.sum(x.quality == 0)),
        "quality": {q.name: int(np.count_nonzero(x.quality & q)) for q in Quality},
        "density": {
            "band_Hz": list(BAND),
            "before": {k: v for k, v in nominal.items() if k.endswith("rtHz")},
            "after": measure_density(x.gradient[::step], d.rate / step),
            "noise": name_both(c.noise_std / np.sqrt(d.bandwidth), "Eo_per_rtHz"),
        },
        "std": {"noise": name_both(c.noise_std), "parameters": name_both(rms)},
        "contributions": list_contributions(c, instrument),
    }


def name_both(values: Array, unit: str = "Eo") -> dict[str, float | None]:
    """Numbers (2,) of inline and cross, for JSON."""
    return {f"{name}_{unit}": finite(x) for name, x in zip(("inline", "cross"), values, strict=True)}


def measure_density(g: Complex, rate: float) -> dict[str, float | None]:
    """Mean density over :data:`BAND` of inline + i cross (n,), NaN where there is none; Eo/sqrt(Hz)."""
    from scipy import signal  # slow to import

    n, power, samples = int(WINDOW * rate), np.zeros(2), 0
    for run in runs(np.isfinite(g.real), n):
        x = g[run]
        channels = np.stack([x.real, x.imag])
        f, density = signal.welch(channels, rate, nperseg=n, detrend="linear")  # type: ignore[call-overload]
        power += len(x) * np.mean(density[:, (f >= BAND[0]) & (f <= BAND[1])], axis=1)
        samples += len(x)
    mean = np.sqrt(power / samples) if samples else np.full(2, np.nan)
    return name_both(mean, "Eo_per_rtHz")


def list_groups(model: Model, instrument: Instrument, p: Array) -> Iterator[tuple[str, str | None, Array]]:
    """Groups of parameters with a common contribution: name, effect, and the vector (size,) without them.

    There they are zero, or neutral if of an effect; scale factors are at their mean, which carries the gradient itself.
    """
    places = model.chain.places
    for q in (q for q in PARAMETERS if q.name in places):
        without = p.copy()
        without[places[q.name]] = np.mean(p[places[q.name]]) if q.relative else 0.0
        yield f"imbalance of {q.name}" if q.relative else q.name, None, without
    for e in model.effects:
        without = p.copy()
        for x in (x for x in e.parameters if x.symbol in places and x.fitted):
            factor = find_unit_factor(x.unit, instrument.units)
            without[places[x.symbol]] = (x.neutral or 0.0) * factor
        yield e.id, e.id, without


def list_contributions(c: OutputChannel, instrument: Instrument) -> list[dict[str, Any]]:
    """Contributions removed: rms of inline and cross, Eo, on two segments of the flight, largest first."""
    p, count = c.blocks[0].p, 0
    totals: dict[tuple[str, str | None], Array] = {}
    groups = [x for x in list_groups(c.model, instrument, p) if not np.array_equal(x[-1], p)]
    longest = max(ROWS, 4 * len(c.demodulator.taps))
    for rows in spread(divide_into_segments(len(c.observation.record.time), longest), 2):
        samples = slice(0, rows.stop - rows.start)
        part = replace(c, observation=c.observation.part(rows), blocks=(Block(samples, p),))
        good, total = (part.flag_samples() & NO_VALUE) == 0, part.predict()
        count += int(np.sum(good))
        for name, effect, without in [("everything", None, None), *groups]:
            rest = 0.0 if without is None else replace(part, blocks=(Block(samples, without),)).predict()
            g = part.demodulate(total - rest)[good]
            squares = np.array([np.sum(g.real**2), np.sum(g.imag**2)])
            totals[name, effect] = totals.get((name, effect), 0.0) + squares
    ordered = sorted(totals.items(), key=lambda x: -np.sum(x[1]))
    return [
        {"of": name, "effect": effect, **name_both(np.sqrt(squares / count))}
        for (name, effect), squares in ordered
        if np.any(squares > 0.0)
    ]


# --- the command ---------------------------------------------------------------------------------------


@one_thread
def compensate(m: Loaded, flights: Sequence[Flight], kind: Kind, demodulator: str) -> Compensation:
    """Compensate flights with parameters fitted to these flights, or with the saved ones (``frozen``).

    Raises
    ------
    UserError
        If a flight cannot be compensated, or not in one table with the others.
    """
    model, instrument = m.model, m.instrument
    saved = saved_calibration(m) if kind == "frozen" else None
    if saved is None:
        require_distinct(flights)
    p = prepare(model, instrument, flights, kind, demodulator, saved)
    _require_alike(p)
    series, entries = [], []
    for k, (flight, channels) in enumerate(zip(p.flights, p.channels, strict=True), 1):
        compensated = [c.compensate() for c in channels]
        columns = make_columns(instrument, channels, compensated)
        number = {"flight": np.full(len(flight.time), k, dtype=np.int64)} if len(p.flights) > 1 else {}
        series.append({"time": np.array(flight.time), **columns, **number})
        entries += [describe_channel(c, x, instrument) for c, x in zip(channels, compensated, strict=True)]
    d = p.channels[0][0].demodulator
    result = {
        "calibration": kind,
        "converged": p.calibration.converged if saved is None else saved.converged,
        "effects": [e.id for e in model.effects],
        "demodulator": {
            "name": d.name,
            "what": d.description,
            "latency_s": d.latency,
            "bandwidth_Hz": d.bandwidth,
        },
        "flights": entries,
    }
    if saved is not None and p.change is not None:
        result["frozen"] = describe_saved(saved) | p.change.as_json()
        if not p.change.holds:
            result["notes"] = [warn_of_change(saved.time, p.change)]
    if kind == "smoothed" and not find_starts(p.flights)[1]:
        result["notes"] = [describe_other.UNTIMED]
    return Compensation(m.name, result, tuple(series))


def _require_alike(p: PreparedFlights) -> None:
    """UserError unless all flights have the same outputs."""
    names = [[c.observation.output.name for c in channels] for channels in p.channels]
    for flight, outputs in zip(p.flights, names, strict=True):
        if outputs != names[0]:
            raise UserError(
                "the flights do not have the same outputs",
                where=flight.path or flight.name,
                found=", ".join(outputs) or "none that is sensitive to the gradient",
                expected=", ".join(names[0]),
                remedy="compensate them one by one",
            )


def make_columns(
    instrument: Instrument, channels: Sequence[OutputChannel], series: Sequence[Compensated]
) -> dict[str, NDArray[Any]]:
    """The columns (N,) of a flight: of every output, with an ending where there are several, and the tensor where they determine it."""
    names = instrument.layout.output_names
    endings = dict(zip(names, column_endings(names), strict=True))
    columns: dict[str, NDArray[Any]] = {}
    for c, x in zip(channels, series, strict=True):
        end = endings[c.observation.output.name]
        columns |= {f"inline{end}": x.gradient.real, f"cross{end}": x.gradient.imag}
        columns |= {f"inline{end}_std": x.std[0], f"cross{end}_std": x.std[1], f"quality{end}": x.quality}
    discs = [instrument.layout.discs[c.observation.output.disc] for c in channels]
    noise = np.array([s for c in channels for s in c.noise_std])
    try:
        by_channels = solve_tensor([d.across for d in discs], np.eye(2 * len(channels)), noise)
    except UserError:  # the outputs do not determine it
        return columns
    gradients = np.concatenate([[x.gradient.real, x.gradient.imag] for x in series])
    std = np.sqrt(by_channels.gamma**2 @ np.concatenate([x.std for x in series]) ** 2)
    columns |= {f"Gamma_{k}": v for k, v in zip(COMPONENTS, by_channels.gamma @ gradients, strict=True)}
    columns |= {f"Gamma_{k}_std": v for k, v in zip(COMPONENTS, std, strict=True)}
    checks = by_channels.closure @ gradients
    columns |= {"closure" if len(checks) == 1 else f"closure_{k}": v for k, v in enumerate(checks, 1)}
    return columns
