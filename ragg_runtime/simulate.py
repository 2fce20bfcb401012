"""Flights of a model directory's instrument from the numerical reference (``ragg simulate``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.units import units
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.io.mapping import Mapped
from ragg_runtime.model.model import DerivedEffect, load_packaged
from ragg_runtime.model.record import find_start
from ragg_runtime.reference import simulate as reference
from ragg_runtime.reference.chain import Auxiliary
from ragg_runtime.reference.effects import EffectValues, find_channels, resolve
from ragg_runtime.reference.geometry import Rotations
from ragg_runtime.reference.motion import MotionSignals, RecordedSignal, Turning, recorded_motion
from ragg_runtime.reference.scenario import draw_gradient, draw_motion, perturb
from ragg_runtime.reference.simulate import draw_rare, draw_usual, eotvos_noise
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

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
        columns). ``spin``: name of a disc -> how it turns, if not steadily as on the sheet; its encoder is then recorded.

    Returns
    -------
        The flight, in SI.

    Raises
    ------
    UserError
        If an effect is unknown.
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
    spin: Mapping[str, Turning] = MappingProxyType({}),
) -> Flight:
    """As :func:`simulate`, of an instrument."""
    effects: dict[str, dict[str, Array]] = dict(_parse_effect(text, instrument) for text in hidden)
    form = instrument.form
    if not form.second_order_angles:
        effects.setdefault("second-order-misalignment", {"kappa": np.array(0.0)})
    record, start = None, 0.0
    if motion is None:
        flown = draw_motion(np.random.default_rng([seed, 11]), duration, shape=shape, linear=IN_FLIGHT)
    else:
        record = read_flight(motion, instrument.g0, need_output=False, mapping=mapping)
        start = find_start(record, instrument)
        flown, duration, rate = _take_motion(record, start)
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
        turning={**_take_turning(instrument, record, start), **spin},
    )
    return s.flight("simulated", voltages=voltages)


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


def _take_turning(instrument: Instrument, x: Flight | None, start: float) -> dict[str, Turning]:
    """The discs whose angles a flight recorded, which begins at ``start``, s."""
    if x is None:
        return {}
    time, columns = x.time - x.time[0] + start, {d.name: d.angle_column for d in instrument.layout.discs}
    return {n: Turning.of_record(time, x.channels[c]) for n, c in columns.items() if c in x.channels}


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
