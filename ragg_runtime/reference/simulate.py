"""A flight of the numerical model: motion, gravity, noise and hidden effects in, record out; plausible auxiliary channels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.fft import irfft, next_fast_len, rfftfreq

from ragg_runtime.base.errors import UserError, check_keys
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import PAPER, Output
from ragg_runtime.io import Flight
from ragg_runtime.reference.chain import Auxiliary, Chain
from ragg_runtime.reference.effects import EffectValues, Injected, find_channels, resolve
from ragg_runtime.reference.effects.geometry import Kinematics, random_angle, spin_share
from ragg_runtime.reference.effects.memory import MEMORIES, find_resonance_loss, list_memories
from ragg_runtime.reference.effects.sensing import record_motion, record_output
from ragg_runtime.reference.effects.transducer import REFERENCE_PRESSURE, REFERENCE_TEMPERATURE
from ragg_runtime.reference.geometry import Rotations
from ragg_runtime.reference.gravity import COMPONENTS, Gravity
from ragg_runtime.reference.motion import MotionSignals, Sinusoids, Turning

Array = NDArray[np.float64]


_EARTH_FIELD = (1.5e-5, 1.0e-5, -4.5e-5)  # magnetic flux density in the measurement frame, T


def draw_usual(rng: np.random.Generator) -> Mapping[str, Auxiliary]:
    """Temperature, roll, pitch, pressure and magnetic field of a survey line.

    It warms by 2 K with a time constant of 20 minutes, and swings slowly by 0.1 K.
    """
    swings = Sinusoids(0.0, 0.1 * np.array([0.7, 0.3]), 1 / rng.uniform(200, 900, 2), rng.uniform(0, 6.28, 2))

    def warming(time: Array) -> Array:
        return REFERENCE_TEMPERATURE + 2.0 * -np.expm1(-time / 1200.0) + swings(time)

    return {
        "temperature": warming,
        "roll": _attitude(rng),
        "pitch": _attitude(rng),
        "pressure": _slow(rng, REFERENCE_PRESSURE - 3000.0, 300.0),
        **{f"B_{k}": _slow(rng, mean, 2e-6) for k, mean in zip("xyz", _EARTH_FIELD, strict=True)},
    }


def draw_rare(rng: np.random.Generator) -> Mapping[str, Auxiliary]:
    """What only some carriers record: heading, fuel on board, levels of vibration above the recorder's bandwidth, loops' currents."""
    burning = rng.uniform(0.02, 0.06)  # kg/s
    return {
        "yaw": _slow(rng, float(rng.uniform(-3.0, 3.0)), 0.5),
        "fuel_mass": lambda time: np.asarray(500.0 - burning * time),
        "vibration_rms": _slow(rng, 0.5, 0.1),
        "angular_vibration_rms": _slow(rng, 1e-4, 2e-5),
        "balance_current": lambda time: np.asarray(-1e-3 * np.expm1(-time / 400.0)),  # a loop that settles
        "second_order_current": lambda time: np.asarray(-1e-3 * np.expm1(-time / 250.0)),
    }


def _slow(rng: np.random.Generator, mean: float, amplitude: float) -> Sinusoids:
    """A mean and three slow sinusoids, SI."""
    return Sinusoids(mean, amplitude * np.ones(3), 1 / rng.uniform(100, 900, 3), rng.uniform(0, 6.28, 3))


def _attitude(rng: np.random.Generator) -> Sinusoids:
    """Twelve sinusoids of 0.02 rad rms, slow ones larger."""
    frequency = np.sort(np.exp(rng.uniform(np.log(1 / 900), np.log(0.2), 12)))
    amplitude = frequency**-0.5
    amplitude *= 0.02 / np.sqrt(np.sum(amplitude**2) / 2)
    return Sinusoids(0.0, amplitude, frequency, rng.uniform(0, 2 * np.pi, 12))


_CHUNK = 65536

# Independent streams, so that switching one source of randomness on or off leaves the others as they were.
_NOISE_STREAM, _ANGLE_STREAM, _AUXILIARY_STREAM = 1, 2, 3


@dataclass(frozen=True)
class Simulation:
    """The record, and the truth that a real instrument does not give.

    ``time`` (N,) s; ``channels``: name -> (N,) SI; ``voltages`` (n, N) V and ``outputs``: name -> (N,) V, as recorded,
    and free of accelerometer noise. ``instrument``, ``effects``: the true parameters and all that was injected, SI.
    """

    time: Array
    channels: Mapping[str, Array]
    voltages: Array
    outputs: Mapping[str, Array]
    voltages_noise_free: Array
    outputs_noise_free: Mapping[str, Array]
    instrument: Instrument
    effects: Injected

    @property
    def G_out(self) -> Array:
        """The first output, (N,) V, as recorded."""
        return next(iter(self.outputs.values()))

    @property
    def G_out_noise_free(self) -> Array:
        """The same without accelerometer noise."""
        return next(iter(self.outputs_noise_free.values()))

    def flight(self, name: str = "simulated", *, voltages: bool = False) -> Flight:
        """The record as a flight: its outputs, and the voltages if asked for."""
        outputs = dict(self.outputs)
        if voltages:
            layout = self.instrument.layout
            outputs |= {layout.voltage_columns(j)[0]: v for j, v in enumerate(self.voltages)}
        return Flight(time=self.time, channels=dict(self.channels), outputs=outputs, name=name)


def combine(voltages: Array, output: Output = PAPER.outputs[0]) -> Array:
    """Output before demodulation, V_1 + V_2 - V_3 - V_4 (Eq. 15): the members' voltages with their signs, in turn."""
    total: Array = np.zeros(voltages.shape[1])
    for j, sign in zip(output.members, output.signs, strict=True):
        total = total + voltages[j] if sign > 0 else total - voltages[j]
    return total


def instants(duration: float, rate: float, start: float = 0.0) -> Array:
    """Uniform sampling times start + n/rate, n = 0 ... duration * rate - 1, s."""
    if not (
        np.isfinite(duration) and np.isfinite(rate) and duration > 0 and rate > 0 and duration * rate >= 1
    ):
        raise UserError(
            "a simulated flight needs a positive duration and sampling rate",
            found=f"{duration:g} s at {rate:g} Hz",
        )
    return start + np.arange(round(duration * rate)) / rate


def simulate(
    instrument: Instrument,
    motion: MotionSignals,
    duration: float,
    rate: float,
    *,
    start: float = 0.0,
    gravity: Gravity | None = None,
    record_gradient: bool = True,
    noise: Noise | None = None,
    rotations: Rotations = "first-order",
    misalignment: Literal["first-order", "exact"] | None = None,
    kinematics: Kinematics = "platform",
    effects: EffectValues | None = None,
    seed: int = 0,
    auxiliaries: Mapping[str, Auxiliary] | None = None,
    turning: Mapping[str, Turning] | None = None,
) -> Simulation:
    """Simulate a flight with the numerical model (Eq. 49-53); UserError on unknown effects or missing auxiliary
    channels.

    ``instrument``, ``motion``: true, SI. ``duration``, ``start`` s, ``rate`` Hz. ``gravity``: ``None`` is none.
    ``noise``: of each accelerometer, independent. ``rotations``, ``misalignment``: ``first-order`` (Eq. 2),
    ``second-order`` (squares of mounting angles) or ``exact``. ``kinematics``: ``platform`` (Eq. 49) or ``full``
    (accelerometers sense that they turn with the disc). ``effects``: ``{id: {parameter: value or one each, SI}}``.
    ``auxiliaries``: channel -> function of time (N,) s; ``None``: plausible ones. ``turning``: disc -> how it turns,
    recorded by an encoder; others turn steadily.
    """
    time, injected = instants(duration, rate, start), resolve(effects, instrument.layout.size)
    turning, discs = turning or {}, instrument.layout.discs
    check_keys(turning, [d.name for d in discs], "turning")
    world = (
        draw_usual(np.random.default_rng([seed, _AUXILIARY_STREAM])) if auxiliaries is None else auxiliaries
    )
    _require_channels(injected, world)
    chain = Chain(
        instrument=instrument,
        motion=motion,
        gravity=gravity,
        rotations=rotations,
        effects=injected,
        auxiliaries=world,
        turning=tuple(turning.get(d.name, Turning(d.spin_frequency)) for d in discs),
        spin=spin_share(kinematics, injected),
        misalignment=misalignment or ("exact" if rotations == "exact" else "first-order"),
    )
    true = _add_memories(chain, time)
    clean, added = _clean(true, time, rate, seed), _draw_noise(noise, true, time, rate, seed)

    def record_outputs(v: Array) -> dict[str, Array]:
        return {o.name: record_output(combine(v, o), injected) for o in instrument.layout.outputs}

    return Simulation(
        time=time,
        channels=_channels(chain, time, record_gradient, turning),
        voltages=clean + added,
        outputs=record_outputs(clean + added),
        voltages_noise_free=clean,
        outputs_noise_free=record_outputs(clean),
        instrument=instrument,
        effects=injected,
    )


def _add_memories(chain: Chain, time: Array) -> Chain:
    """The chain with the series that its memories need, which are computed by the chain without these effects."""
    memories = {e: v for e, v in chain.effects.items() if e in MEMORIES}
    plain = replace(chain, effects={e: v for e, v in chain.effects.items() if e not in MEMORIES})
    if not memories or len(time) < 2:
        return plain

    def currents(t: Array) -> Array:
        return plain.voltages(t, np.zeros(t.size)) / plain.scale(t)

    series = list_memories(memories, plain.forces, currents, chain.auxiliaries, time)
    return replace(chain, auxiliaries={**chain.auxiliaries, **series})


def _clean(chain: Chain, time: Array, rate: float, seed: int) -> Array:
    """(accelerometers, N) V without noise."""
    error = random_angle(np.random.default_rng([seed, _ANGLE_STREAM]), time.size, rate, chain.effects)
    clean = np.empty((chain.instrument.layout.size, time.size))
    for begin in range(0, time.size, _CHUNK):
        part = slice(begin, begin + _CHUNK)
        clean[:, part] = chain.voltages(time[part], error[part])
    if resonance := chain.effects.get("accelerometer-resonance"):
        clean -= find_resonance_loss(resonance, lambda t: chain.voltages(t, np.zeros(t.size)), time)
    return clean


def _draw_noise(noise: Noise | None, chain: Chain, time: Array, rate: float, seed: int) -> Array:
    """(accelerometers, N), V: the noise of each, of a stream of its own."""
    if noise is None:
        return np.zeros((chain.size, len(time)))
    streams = (np.random.default_rng([seed, _NOISE_STREAM, j]) for j in range(chain.size))
    return chain.scale(time) * np.stack([noise.sample(stream, len(time), rate) for stream in streams])


def _channels(
    chain: Chain, time: Array, record_gradient: bool, turning: Mapping[str, Turning]
) -> dict[str, Array]:
    warm = "imu-thermal" in chain.effects
    warmth = chain.auxiliaries["temperature"](time) if warm else REFERENCE_TEMPERATURE
    recorded = record_motion(chain.motion, time, chain.effects, warmth)
    channels = {
        f"{quantity}_{axis}": getattr(recorded, quantity)[k]
        for quantity in ("a", "omega", "omegadot")
        for k, axis in enumerate("xyz")
    }
    if record_gradient:
        gradient = np.zeros((6, time.size)) if chain.gravity is None else chain.gravity.gradient(time)
        channels |= {f"Gamma_{c}": gradient[k] for k, c in enumerate(COMPONENTS)}
    channels |= {name: channel(time) for name, channel in chain.auxiliaries.items()}
    discs = (d for d in chain.instrument.layout.discs if d.name in turning)
    return channels | {d.angle_column: turning[d.name].encoder(time) for d in discs}


def _require_channels(effects: Injected, auxiliaries: Mapping[str, Auxiliary]) -> None:
    for effect, parameters in effects.items():
        for name in find_channels(effect, parameters):
            if name not in auxiliaries:
                raise UserError(
                    f"the effect {effect!r} needs the auxiliary channel {name!r}",
                    found=", ".join(auxiliaries) or "none",
                    remedy="give it as a function of time in auxiliaries",
                )


@dataclass(frozen=True)
class Noise:
    """Red and white noise of one accelerometer: Phi(f) = alpha f^-b + omega_T (Eq. 53).

    ``alpha``: one-sided density of the red part at 1 Hz, ``omega_T`` of the white one, (m/s^2)^2/Hz; 0 <= b < 4.
    """

    alpha: float = 0.0
    b: float = 0.0
    omega_T: float = 0.0

    def psd(self, frequency: ArrayLike) -> Array:
        """One-sided density at frequencies > 0 Hz, (m/s^2)^2/Hz."""
        f = np.asarray(frequency, dtype=np.float64)
        return np.asarray(self.alpha * f**-self.b + self.omega_T, dtype=np.float64)

    def sample(self, rng: np.random.Generator, size: int, rate: float) -> Array:
        """Draw a record, (size,) m/s^2, at ``rate`` Hz.

        The red part is half of a periodic record twice as long; it holds no power below rate/(2 size).
        """
        record: Array = np.sqrt(self.omega_T * rate / 2) * rng.standard_normal(size)
        if self.alpha == 0 or size == 0:
            return record
        period = next_fast_len(2 * size, real=True)
        f = rfftfreq(period, 1 / rate)
        density = np.zeros(f.size)
        density[1:] = self.alpha * f[1:] ** -self.b
        # A one-sided density S is E|X_k|^2 = S rate period / 2 for the unnormalised transform.
        scale = np.sqrt(density * rate * period / 4)
        spectrum = scale * (rng.standard_normal(f.size) + 1j * rng.standard_normal(f.size))
        if period % 2 == 0:
            # Nyquist has no imaginary part; its real part carries all of the power.
            spectrum[-1] = np.sqrt(2) * spectrum[-1].real
        record += irfft(spectrum, period)[:size]
        return record


def eotvos_noise(density: float, radius: float, red_corner: float = 0.0) -> Noise:
    """White accelerometer noise that gives the demodulated cross channel a ``density`` in s^-2/sqrt(Hz), ``radius`` in
    m, and below ``red_corner``, Hz, stronger 1/f noise.

    n = sqrt(2) R density, m/s^2/sqrt(Hz). The inline channel, a difference, has twice the cross channel's.
    """
    white = 2 * (radius * density) ** 2
    return Noise(alpha=red_corner * white, b=1.0, omega_T=white)
