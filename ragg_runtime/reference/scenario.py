"""Random flights of random instruments, in turbulence of several spectra: what demonstration and benchmark fly."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfftfreq

from ragg_runtime.base.errors import check_choice
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import paper
from ragg_runtime.reference.chain import Auxiliary
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.gravity import Gradient, Gravity
from ragg_runtime.reference.motion import MotionSignals, RecordedSignal, Signal, Sinusoids
from ragg_runtime.reference.simulate import Noise, Simulation, draw_usual, eotvos_noise, simulate

Array = NDArray[np.float64]

_ARCSEC = np.pi / 180 / 3600
_G0 = 9.8
_MICRO_G = 1e-6 * _G0
_PER_MICRO = 1e-6 / _G0

_SHEET: Mapping[str, tuple[float, Sequence[float], float]] = {
    "dR": (1e-6, (0, 30, 35, 25), 2e-6),
    "beta_x": (_ARCSEC, (21, 14, 17, 19), 2 * _ARCSEC),
    "beta_z": (_ARCSEC, (18, 8, 10, 20), 2 * _ARCSEC),
    "vartheta_x": (_ARCSEC, (0, 0, 0, 0), 2 * _ARCSEC),
    "vartheta_y": (_ARCSEC, (21, 10, 7, 19), 2 * _ARCSEC),
    "vartheta_z": (_ARCSEC, (30, 19, 20, 9), 2 * _ARCSEC),
    "K0": (_MICRO_G, (10, 2, 5, 8), _MICRO_G),
    "K1": (1e-3 / _G0, (10, 11, 11.5, 12), 1e-5 * 1e-2 / _G0),
    "K2": (_PER_MICRO, (5, 1, 8, 7), _PER_MICRO),
    "K4": (_PER_MICRO, (6, 12, 5, 16), _PER_MICRO),
    "K5": (_PER_MICRO, (4, 11, 9, 13), _PER_MICRO),
    "K6": (_PER_MICRO, (3, 12, 8, 10), _PER_MICRO),
    "K7": (_PER_MICRO, (5, 15, 7, 17), _PER_MICRO),
    "K8": (_PER_MICRO, (0, 7, 11, 20), _PER_MICRO),
    "k_VI": (1.0, (1e9, 1e9, 1e9, 1e9), 0.0),
}
"""Table V: unit of a row, its values, and the standard deviation, SI, of a true parameter about its test sheet. The paper gives no
vartheta_x; it leaves the linear terms alone."""


def _build(accelerometers: Mapping[str, Array]) -> Instrument:
    return Instrument.build(paper(0.1, 0.25), _G0, accelerometers)


def table_v() -> Instrument:
    """The paper's instrument (Table V): R = 0.1 m, 0.25 Hz, scale factors 10, 11, 11.5 and 12 mA/g."""
    return _build({name: unit * np.array(values, float) for name, (unit, values, _) in _SHEET.items()})


def trimmed() -> Instrument:
    """Table V with scale factors matched to 2e-4, as a feedback loop would leave them in flight."""
    return table_v().replace(K1=1e-3 / _G0 * np.array([10, 10.001, 10.0015, 10.002]))


def perfect() -> Instrument:
    """No errors at all: equal scale factors of 10 mA/g, everything else zero."""
    return _build({"K1": np.full(4, 1e-2 / _G0), "k_VI": np.full(4, 1e9)})


def perturb(instrument: Instrument, rng: np.random.Generator, amount: float = 1.0) -> Instrument:
    """True parameters drawn about a test sheet, ``amount`` times as uncertain as such sheets are."""
    drawn = {
        name: values + amount * _SHEET[name][2] * rng.standard_normal(instrument.layout.size)
        for name, values in instrument.accelerometers.items()
    }
    return instrument.replace(**drawn)


_MILLI_G = 9.8e-3
_DEG_PER_HOUR = np.pi / 180 / 3600
_EO = 1e-9

# mean and rms of a_x, a_y, a_z on a stabilised platform, mg
LINEAR = ((15.0, 10.0), (15.0, 10.0), (100.0, 30.0))
ANGULAR = (100.0, 150.0)  # mean and rms of each angular rate, deg/h
BACKGROUND = (300.0, 120.0, 50.0, 200.0, -80.0, -500.0)  # constant gradient xx, xy, xz, yy, yz, zz, Eo

# One stream for each thing that is drawn, so that a change in one leaves the others.
_INSTRUMENT, _MOTION, _AUXILIARY, _GEOLOGY = range(10, 14)


def _resonant(f: Array) -> Array:
    """A broad floor with the phugoid-like and short-period peaks of a light aircraft."""
    peaks = sum(a / (1 + ((f - f0) / width) ** 2) for a, f0, width in ((3.0, 0.12, 0.03), (2.0, 0.7, 0.12)))
    return 0.2 + np.asarray(peaks)


SHAPES: Mapping[str, Callable[[Array], Array]] = {
    "flat": np.ones_like,
    "dryden": lambda f: 1 / (1 + (f / 0.25) ** 2),
    "kolmogorov": lambda f: (0.03**2 + f**2) ** (-5 / 6),
    "resonant": _resonant,
}
"""Power spectral density over frequency (Hz) below the cutoff, up to a factor."""

CUTOFF = 1.2  # half-power frequency of the platform's low-pass (48 dB an octave), Hz

_NODES_PER_CYCLE = 13
_PAD = 10.0
_BURST_FREQUENCY = 0.015


def _draw(rng: np.random.Generator, size: int, rate: float, density: Callable[[Array], Array]) -> Array:
    """A stationary Gaussian record of some power spectral density, unit variance on average."""
    # Longer than needed, so that the end does not run into the beginning.
    period = next_fast_len(size + int(60 * rate), real=True)
    f = rfftfreq(period, 1 / rate)
    amplitude = np.sqrt(density(f))
    noise = rng.standard_normal(f.size) + 1j * rng.standard_normal(f.size)
    record: Array = irfft(amplitude * noise, period)[:size]
    record *= period / np.sqrt(4 * np.sum(amplitude**2))
    return record


def turbulence(
    rng: np.random.Generator,
    duration: float,
    rms: float,
    *,
    mean: float = 0.0,
    shape: str = "dryden",
    bursts: float = 0.0,
) -> RecordedSignal:
    """One component of a random motion, smooth in time.

    ``duration``: of the flight, s; the signal goes on for ten seconds at both ends. ``rms``, ``mean``: SI, met exactly.
    ``shape``: one of ``SHAPES``. ``bursts``: standard deviation of the logarithm of a slowly varying intensity; 0 is
    stationary.
    """
    check_choice(shape, tuple(SHAPES), "shape", "unknown shape of turbulence")
    rate = _NODES_PER_CYCLE * CUTOFF
    nodes = -_PAD + np.arange(int((duration + 2 * _PAD) * rate) + 2) / rate
    record = _draw(rng, nodes.size, rate, lambda f: SHAPES[shape](f) / (1 + (f / CUTOFF) ** 16))
    if bursts > 0:
        slow = _draw(rng, nodes.size, rate, lambda f: 1 / (1 + (f / _BURST_FREQUENCY) ** 16))
        record = record * np.exp(bursts * slow)
    flight = (nodes >= 0.0) & (nodes <= duration)
    record = (record - record[flight].mean()) / record[flight].std()
    return RecordedSignal(nodes, mean + rms * record)


@dataclass(frozen=True)
class Scenario:
    """A test ``sheet`` (what the model believes), a true ``instrument`` that flies, and a flight: arguments of :func:`simulate`."""

    sheet: Instrument
    instrument: Instrument
    motion: MotionSignals
    gravity: Gravity
    noise: Noise | None
    auxiliaries: Mapping[str, Auxiliary]
    duration: float
    rate: float
    seed: int

    def simulate(
        self, effects: EffectValues | None = None, *, record_gradient: bool = True, start: float = 0.0
    ) -> Simulation:
        """Fly it, from ``start`` s on, with hidden effects ``{id: {parameter: value or four values, SI}}``."""
        flight = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "sheet"}
        return simulate(**flight, start=start, record_gradient=record_gradient, effects=effects)


def draw_motion(
    rng: np.random.Generator,
    duration: float,
    *,
    shape: str | None = None,
    bursts: float | None = None,
    turbulence_scale: float = 1.0,
    linear: Sequence[tuple[float, float]] = LINEAR,
) -> MotionSignals:
    """Turbulent motion of a stabilised platform for ``duration`` seconds: ``linear`` accelerations, 150 about 100 deg/h.

    ``shape``, ``bursts`` as in ``turbulence``; ``None`` draws one for each component. ``turbulence_scale``: factor on
    the rms values. ``linear``: mean and rms of a_x, a_y, a_z, mg (default: those of the paper).
    """
    intensity = rng.uniform(0, 0.6) if bursts is None else bursts

    def component(mean: float, rms: float, unit: float) -> Signal:
        return turbulence(
            rng,
            duration,
            turbulence_scale * rms * unit,
            mean=mean * unit,
            shape=str(rng.choice(list(SHAPES))) if shape is None else shape,
            bursts=intensity,
        )

    a_x, a_y, a_z = (component(mean, rms, _MILLI_G) for mean, rms in linear)
    omega_x, omega_y, omega_z = (component(*ANGULAR, _DEG_PER_HOUR) for _ in range(3))
    return MotionSignals((a_x, a_y, a_z), (omega_x, omega_y, omega_z))


def draw_gradient(rng: np.random.Generator, rms: float = 0.0) -> Gradient:
    """The constant background, and geology passing by with periods of one to ten minutes.

    ``rms``: of each of the five independent components' variation, s^-2, as six sinusoids.
    """
    drawn = [
        Sinusoids(
            mean * _EO,
            np.full(6, rms * np.sqrt(2 / 6)),
            1 / rng.uniform(60, 600, 6),
            rng.uniform(0, 2 * np.pi, 6),
        )
        for mean in BACKGROUND[:5]
    ]

    def tensor(time: Array) -> Array:
        xx, xy, xz, yy, yz = (signal(time) for signal in drawn)
        return np.stack([xx, xy, xz, yy, yz, -(xx + yy)])

    return Gradient(tensor)


def scenario(
    seed: int,
    *,
    trim: Literal["matched", "table-v"] = "matched",
    duration: float = 1800.0,
    rate: float = 16.0,
    perturbation: float = 1.0,
    noise_density: float = 2e-9,
    red_corner: float = 0.0,
    gradient_rms: float = 0.0,
) -> Scenario:
    """Draw an instrument and a flight; equal arguments give equal flights.

    ``trim``: scale factors ``matched`` (10, 10.001, 10.0015, 10.002 mA/g) or ``table-v`` (10, 11, 11.5, 12 mA/g).
    ``duration`` s, ``rate`` Hz. ``perturbation``: of the true parameters, in a test sheet's usual errors. ``noise_density``: white,
    of the demodulated cross channel, s^-2/sqrt(Hz). ``red_corner``: Hz, below which 1/f noise exceeds the white. ``gradient_rms``: s^-2.
    """
    sheet = trimmed() if trim == "matched" else table_v()
    return Scenario(
        sheet=sheet,
        instrument=perturb(sheet, np.random.default_rng([seed, _INSTRUMENT]), perturbation),
        motion=draw_motion(np.random.default_rng([seed, _MOTION]), duration),
        gravity=draw_gradient(np.random.default_rng([seed, _GEOLOGY]), gradient_rms),
        noise=eotvos_noise(noise_density, sheet.radius, red_corner),
        auxiliaries=draw_usual(np.random.default_rng([seed, _AUXILIARY])),
        duration=duration,
        rate=rate,
        seed=seed,
    )
