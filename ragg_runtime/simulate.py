"""Flights of a model directory's instrument from the numerical reference (``ragg simulate``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.instrument.units import units
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.io.mapping import Mapped
from ragg_runtime.model.model import DerivedEffect, load_packaged
from ragg_runtime.model.record import find_start
from ragg_runtime.reference import simulate as reference
from ragg_runtime.reference.chain import Auxiliary
from ragg_runtime.reference.effects import EffectValues, find_channels, resolve
from ragg_runtime.reference.geometry import Rotations
from ragg_runtime.reference.motion import MotionSignals, RecordedSignal, Sinusoids, Turning, recorded_motion
from ragg_runtime.reference.scenario import draw_gradient, draw_motion, perturb
from ragg_runtime.reference.simulate import draw_rare, draw_usual, eotvos_noise
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

# eleven days at 100 Hz: what is simulated is held in memory, some hundreds of bytes a sample
MOST_SAMPLES = 1e8
# mean and rms of a_x, a_y, a_z, mg: upright in light turbulence
IN_FLIGHT = ((15.0, 20.0), (15.0, 20.0), (1000.0, 50.0))
GEOLOGY = 20e-9  # rms of the varying gradient, each component, s^-2


def simulate(m: Loaded, effects: Sequence[str] = (), **options: Any) -> Flight:
    """Simulate a flight at 1 g in turbulence, over a varying gradient, with hidden effects, in model.toml's order and kinematics.

    Parameters
    ----------
    m
        The model.
    effects
        Effects to hide: ``ID:NAME=VALUE[,NAME=VALUE]``, values in the effect's display units, four joined by ``/``.
    options
        ``seed``, ``instrument_seed``: of motion, gradient and noise, and of the true instrument, which flights of one seed share.
        ``duration``, ``rate``, ``noise``: s, Hz, Eo/sqrt(Hz) of the cross channel. ``shape``: spectrum of the motion, ``flat``,
        ``dryden``, ``kolmogorov`` or ``resonant``. ``sheet_error``: how far the true instrument is from its test sheet; 1 is usual.
        ``no_gradient``: whether the gravity gradient is left unrecorded, as on a survey. ``voltages``: whether they are recorded.
        ``motion``: a flight file whose motion and disc angles are flown, at its rate and duration (``mapping`` describes its
        columns). ``spin``: of the discs (:data:`FORM`), if not steady as on the sheet; their encoders are then recorded.

    Returns
    -------
        The flight, in SI.

    Raises
    ------
    UserError
        If an effect is unknown or a value is out of range.
    """
    return simulate_flight(m.instrument, effects, **options)


def simulate_flight(
    instrument: Instrument,
    hidden: Sequence[str],
    *,
    seed: int = 0,
    instrument_seed: int = 0,
    duration: float = 1800.0,
    rate: float = 16.0,
    noise: float = 2.0,
    shape: str | None = None,
    sheet_error: float = 1.0,
    no_gradient: bool = True,
    voltages: bool = False,
    motion: Path | str | None = None,
    mapping: Mapped | None = None,
    spin: Sequence[str] = (),
) -> Flight:
    """As :func:`simulate`, of an instrument."""
    effects: dict[str, dict[str, Array]] = dict(_parse_effect(text, instrument) for text in hidden)
    form = instrument.form
    if not form.second_order_angles:
        effects.setdefault("second-order-misalignment", {"kappa": np.array(0.0)})
    record, start = None, 0.0
    if motion is None:
        flown = _draw_motion(seed, duration, rate, shape)
    else:
        record = read_flight(motion, instrument.g0, need_output=False, mapping=mapping)
        start = find_start(record, instrument)
        flown, duration, rate = _take_motion(record, start)
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            s = reference.simulate(
                perturb(instrument, np.random.default_rng([instrument_seed, 10]), sheet_error),
                flown,
                duration,
                rate,
                start=start,
                gravity=draw_gradient(np.random.default_rng([seed, 13]), GEOLOGY),
                record_gradient=not no_gradient,
                noise=eotvos_noise(noise * 1e-9, instrument.radius, 0.05),
                rotations=_ROTATIONS[form.mounting],
                misalignment="exact" if form.misalignment == "exact" else "first-order",
                kinematics=form.kinematics,
                effects=effects,
                seed=seed,
                auxiliaries=_collect_auxiliaries(seed, effects, instrument.layout.size, record, start),
                turning=parse_turning(spin, instrument.layout, record, start),
            )
        flight = s.flight("simulated", voltages=voltages)
        valid = np.isfinite(list(flight.outputs.values()))
        finite = bool(valid.all() if record is None else valid.any())  # a record that is flown may have gaps
    except OverflowError:
        finite = False
    if not finite:
        raise UserError(
            "the simulated values are not finite",
            remedy="choose a smaller --noise, --sheet-error, --spin or value of an effect",
        )
    return flight


# how the mounting of [model] order turns in the simulator
_ROTATIONS: Mapping[int | str, Rotations] = {1: "first-order", 2: "second-order", "exact": "exact"}


def _collect_auxiliaries(
    seed: int, effects: EffectValues, count: int, record: Flight | None, start: float
) -> dict[str, Auxiliary]:
    """What every carrier records, and what the effects ask for beyond that; as ``record`` has it, from ``start``, s, on."""
    needed = {c for e, values in resolve(effects, count).items() for c in find_channels(e, values)}
    rare = draw_rare(np.random.default_rng([seed, 14]))
    usual = draw_usual(np.random.default_rng([seed, 12]))
    channels: dict[str, Auxiliary] = {**usual, **{name: rare[name] for name in rare if name in needed}}
    if record is not None:
        time = record.time - record.time[0] + start
        channels |= {n: RecordedSignal(time, x) for n, x in record.channels.items() if n in needed}
    return channels


def _take_motion(x: Flight, start: float) -> tuple[MotionSignals, float, float]:
    """The motion of a flight, beginning at ``start``, s; its duration, s, and rate, Hz, which give as many samples."""
    a, omega = (np.stack([x.channels[f"{n}_{k}"] for k in "xyz"]) for n in ("a", "omega"))
    return recorded_motion(x.time - x.time[0] + start, a, omega), len(x) / x.rate, x.rate


def _draw_motion(seed: int, duration: float, rate: float, shape: str | None) -> MotionSignals:
    if duration * rate > MOST_SAMPLES:
        raise UserError(
            "the flight is too long to be simulated",
            found=f"{duration:g} s at {rate:g} Hz",
            expected=f"at most {MOST_SAMPLES:.0e} samples",
            remedy="simulate several shorter flights",
        )
    return draw_motion(np.random.default_rng([seed, 11]), duration, shape=shape, linear=IN_FLIGHT)


def _parse_effect(text: str, instrument: Instrument) -> tuple[str, dict[str, Array]]:
    identifier, _, rest = text.partition(":")
    model = load_packaged()
    effect = model.effect(identifier)
    if effect is None:
        ids = ", ".join(e.id for e in model.candidates)
        raise UserError("unknown effect to hide", found=repr(identifier), expected=f"one of {ids}")
    values: dict[str, Array] = {}
    for part in rest.split(",") if rest else ():
        name, _, numbers = part.partition("=")
        values[name.strip()] = _parse_numbers(effect, name.strip(), numbers, instrument)
    if not values:
        raise UserError(
            "the hidden effect has no value",
            found=repr(text),
            expected=f"{identifier}:{effect.parameters[0].name}=VALUE",
            remedy=f"parameters, units and usual sizes: ragg effects {identifier}",
        )
    return identifier, values


def _parse_numbers(effect: DerivedEffect, name: str, text: str, instrument: Instrument) -> Array:
    count, parameters = instrument.layout.size, {q.name: q for q in effect.parameters}
    if name not in parameters:
        raise UserError(f"{effect.id} has no parameter {name!r}", expected=", ".join(parameters))
    q = parameters[name]
    try:
        raw = np.array([float(x) for x in text.split("/")])
    except ValueError:
        raise UserError("not a number", where=f"--effect {effect.id}", found=repr(text)) from None
    if len(raw) not in ((1,) if q.shared else (1, count)):
        expected = "one value" if q.shared else f"one value or {'four' if count == 4 else count} joined by /"
        raise UserError(f"{effect.id}: {name} takes {expected}", found=repr(text))
    u = units(instrument.g0)
    si = np.asarray(u.to_si(raw, q.unit, u.base_unit(q.unit)))
    return si if len(si) == count and not q.shared else si[0]


# a steady rate (negative: backwards, 0: none) and swings: amplitude, frequency, phase at the beginning
FORM = "[DISC:]HZ[,RAD@HZ[@RAD]]..."


def parse_turning(
    texts: Sequence[str], layout: Layout, motion: Flight | None = None, start: float = 0.0
) -> dict[str, Turning]:
    """Name of a disc -> how it turns; ``texts`` are texts FORM, for the disc named or for all, before the angles of
    ``motion``, which begins at ``start``, s.
    """
    turnings = {}
    if motion is not None:
        time = motion.time - motion.time[0] + start
        angles = {d.name: d.angle_column for d in layout.discs if d.angle_column in motion.channels}
        turnings = {name: Turning.of_record(time, motion.channels[c]) for name, c in angles.items()}
    for text in texts:
        name, colon, profile = text.rpartition(":")
        names = [d.name for d in layout.discs]
        if colon and name not in names:
            raise UserError(
                f"the instrument has no disc {name!r}",
                where="--spin",
                expected=", ".join(names) or "no name: the instrument has one disc",
            )
        turnings |= dict.fromkeys([name] if colon else names, _parse_profile(profile, text))
    return turnings


def _parse_profile(profile: str, text: str) -> Turning:
    steady, *swings = profile.split(",")
    try:
        parts = [tuple(float(x) for x in s.split("@")) for s in swings]
        numbers = [float(steady), *(x for s in parts for x in s)]
        if any(len(s) not in (2, 3) or s[1] <= 0 for s in parts) or not np.all(np.isfinite(numbers)):
            raise ValueError
    except ValueError:
        raise UserError(
            "the spin of a disc is invalid",
            where="--spin",
            found=repr(text),
            expected=FORM,
            remedy="0.25,0.4@0.05 swings by 0.4 rad every 20 s about 0.25 Hz; 0: it does not spin",
        ) from None
    columns = np.transpose([(*s, 0.0)[:3] for s in parts])
    return Turning(numbers[0], Sinusoids(0.0, *columns) if parts else None)
