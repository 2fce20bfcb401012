"""What is done to the noise of a flight and to its file: every kind of record that the benchmark flies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Table = dict[str, Array]  # the columns of a file, ``time`` first, SI
SPIN = 0.25  # Hz: of the paper's instrument, on which every kind of record but ``elsewhere`` is flown
MILLI_G = 9.8e-3

QUARTERS = np.array([0.0, np.pi, np.pi / 2, 3 * np.pi / 2])


@dataclass(frozen=True)
class Loudness:
    """Of the noise: shape of its spectrum, and its level (4, N) or (N,) from sample to sample."""

    psd: Callable[[Array], Array] = np.ones_like
    """One-sided, of frequencies > 0 Hz, over that of the white noise."""
    level: Any = 1.0


@dataclass(frozen=True)
class CleanOutput:
    """What a change may need to know of a flight: the clean output (N,) V, the rms of its noise, the rate, Hz."""

    clean: Array
    rms: float
    rate: float


NoiseKind = Callable[[Table, np.random.Generator], Loudness]
Change = Callable[[Table, CleanOutput, np.random.Generator], Table]

# --- noise -----------------------------------------------------------------------------------------------


def red(x: Table, rng: np.random.Generator) -> Loudness:
    """1/f below 0.05 or 0.2 Hz."""
    corner = float(rng.choice([0.05, 0.2]))
    return Loudness(lambda f: 1.0 + corner / f)


def walk(x: Table, rng: np.random.Generator) -> Loudness:
    """f^-2: a random walk that in 15 minutes drifts by one to three standard deviations of the white noise."""
    rate = 1.0 / float(x["time"][1] - x["time"][0])
    # of a walk the variance grows by 2 pi^2 c a second where the density is c f^-2, and the white noise has rate / 2
    c = rng.uniform(1.0, 3.0) ** 2 * (rate / 2) / (2 * np.pi**2 * 900.0)
    return Loudness(lambda f: 1.0 + c / f**2)


def in_proportion(size: Callable[[Table], Array]) -> NoiseKind:
    """To the size of something, with a floor of a fifth."""

    def noise(x: Table, rng: np.random.Generator) -> Loudness:
        s = size(x)
        return Loudness(level=0.2 + s / np.sqrt(np.mean(s**2)))

    return noise


@in_proportion
def along_axes(x: Table) -> Array:
    """Each accelerometer's noise in proportion to the force along its input axis."""
    psi = 2 * np.pi * SPIN * x["time"][None] + QUARTERS[:, None]
    return np.abs(x["a_y"] * np.cos(psi) - x["a_x"] * np.sin(psi))


with_size = in_proportion(lambda x: np.sqrt(x["a_x"] ** 2 + x["a_y"] ** 2 + x["a_z"] ** 2))


def with_temperature(x: Table, rng: np.random.Generator) -> Loudness:
    """Three to six times larger at the warmest than at the coldest."""
    T = x["temperature"]
    return Loudness(level=1.0 + rng.uniform(2.0, 5.0) * (T - T.min()) / np.ptp(T))


def amplifier(x: Table, rng: np.random.Generator) -> Loudness:
    """Of one of the two pairs in proportion to the force along its input axis; of the other one constant."""
    level = along_axes(x, rng).level
    pair = int(rng.integers(2))
    level[2 * pair : 2 * pair + 2] = 1.0
    return Loudness(level=level)


def ramp(x: Table, rng: np.random.Generator) -> Loudness:
    """Grows or falls by a factor of 2 to 6."""
    s = np.linspace(0.0, 1.0, len(x["time"]))
    return Loudness(level=rng.uniform(2.0, 6.0) ** (s if rng.random() < 0.5 else 1.0 - s))


def louder_part(x: Table, rng: np.random.Generator) -> Loudness:
    """1.5 to 10 times larger for a third to two thirds of the record."""
    a = rng.uniform(0.0, 0.5)
    s = np.linspace(0.0, 1.0, len(x["time"]))
    loud = (s > a) & (s < a + rng.uniform(1 / 3, 2 / 3))
    return Loudness(level=np.where(loud, 10 ** rng.uniform(0.2, 1.0), 1.0))


def bursts(x: Table, rng: np.random.Generator) -> Loudness:
    """One to four times 2 to 8 s that are 3 to 20 times as noisy."""
    t = x["time"] - x["time"][0]
    factor = np.ones(len(t))
    for _ in range(int(rng.integers(1, 5))):
        a = rng.uniform(0.0, t[-1] - 8.0)
        factor[(t > a) & (t < a + rng.uniform(2.0, 8.0))] = rng.uniform(3.0, 20.0)
    return Loudness(level=factor)


def cyclic(x: Table, rng: np.random.Generator) -> Loudness:
    """Swells once or twice a turn."""
    phi = 2 * np.pi * SPIN * x["time"] * int(rng.integers(1, 3)) + rng.uniform(0, 6)
    return Loudness(level=1.0 + rng.uniform(0.3, 0.9) * np.cos(phi))


# --- changes of the output -------------------------------------------------------------------------------


def output(change: Callable[[Array, CleanOutput, np.random.Generator], Array]) -> Change:
    """What makes another one of the output."""
    return lambda x, r, rng: x | {"G_out": change(x["G_out"], r, rng)}


@output
def mains(G: Array, r: CleanOutput, rng: np.random.Generator) -> Array:
    """50 Hz, which wanders by some mHz, seen through the sampling, 0.3 to 3 times the noise."""
    f = 50.0 + 0.005 * np.cumsum(rng.standard_normal(len(G))) / np.sqrt(len(G))
    phase = 2 * np.pi * np.cumsum(f) / r.rate + rng.uniform(0, 6)
    return G + np.sqrt(2.0) * rng.uniform(0.3, 3.0) * r.rms * np.cos(phase)


def _tone(x: Table, frequency: float, size: float, rng: np.random.Generator) -> Table:
    e = np.sqrt(2.0) * size * np.cos(2 * np.pi * frequency * x["time"] + rng.uniform(0, 6))
    return x | {"G_out": x["G_out"] + e}


def line(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """A line of 0.3 to 10 times the noise, far from the multiples of the spin rate."""
    f = float(rng.uniform(0.06, 0.45) * r.rate)
    return _tone(x, f, r.rms * 10 ** rng.uniform(-0.5, 1.0), rng)


def near_line(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """A line 0.3 mHz beside one or two turns, 0.05 to 1 times the noise."""
    f = float(rng.choice([SPIN, 2 * SPIN])) + 0.0003
    return _tone(x, f, r.rms * 10 ** rng.uniform(-1.3, 0.0), rng)


@output
def jump(G: Array, r: CleanOutput, rng: np.random.Generator) -> Array:
    """The output's zero jumps by 0.3 to 3 times the noise."""
    size = rng.choice([-1.0, 1.0]) * 10 ** rng.uniform(-0.5, 0.5) * r.rms
    return G + np.where(np.arange(len(G)) > rng.uniform(0.2, 0.8) * len(G), size, 0.0)


@output
def spikes(G: Array, r: CleanOutput, rng: np.random.Generator) -> Array:
    """Ten samples of the output 20 to 1,000 times the noise off."""
    at = rng.choice(len(G), 10, replace=False)
    e = np.zeros(len(G))
    e[at] = r.rms * rng.choice([-1.0, 1.0], 10) * 10 ** rng.uniform(1.3, 3.0, 10)
    return G + e


@output
def gaps(G: Array, r: CleanOutput, rng: np.random.Generator) -> Array:
    """30 % of the output's samples are missing, in gaps of 0.1 to 10 s."""
    lost = np.zeros(len(G), dtype=np.bool_)
    while np.mean(lost) < 0.3:
        a = int(rng.integers(len(lost)))
        lost[a : a + 1 + int(10 ** rng.uniform(-1, 1) * r.rate)] = True
    return np.where(lost, np.nan, G)


def louder_with(size: Callable[[Table], Array]) -> Change:
    """White noise of the output besides, in proportion to something, twice as loud as the noise."""

    def change(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
        s = size(x)
        more = 2.0 * r.rms * s / np.sqrt(np.mean(s**2)) * rng.standard_normal(len(s))
        return x | {"G_out": x["G_out"] + more}

    return change


# --- changes of other columns ----------------------------------------------------------------------------


def rough_gaps(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """The output fails where it is rough."""
    a = np.hypot(*(x[n] - np.mean(x[n]) for n in ("a_x", "a_z")))
    return x | {"G_out": np.where(a < np.quantile(a, rng.uniform(0.7, 0.95)), x["G_out"], np.nan)}


def rows_lost(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """One row in a hundred is not in the file, and one stretch of up to 5 s."""
    n = len(r.clean)
    present = rng.random(n) > 0.01
    a = int(rng.integers(n // 4, n // 2))
    present[a : a + int(rng.uniform(1.0, 5.0) * r.rate)] = False
    present[:2] = True
    return {c: v[present] for c, v in x.items()}


def codes(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """-9999 or 999 in one column where a value is missing, one sample in two hundred."""
    name = str(rng.choice(["G_out", "a_x", "omega_y", "temperature"]))
    gone = rng.random(len(r.clean)) < 0.005
    return x | {name: np.where(gone, float(rng.choice([-9999.0, 999.0])), x[name])}


def stuck(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """The output or a motion sensor repeats its last value for 2 to 8 s, twice."""
    name = str(rng.choice(["G_out", "a_x", "a_z", "omega_y"]))
    v = x[name].copy()
    for share in (0.3, 0.7):
        a = int(share * len(v))
        v[a : a + int(rng.uniform(2.0, 8.0) * r.rate)] = v[a]
    return x | {name: v}


def noisy_sensors(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """White noise of every sensor of motion: 0.1 ug, 2e-4 deg/h, and what a good derivative makes of it."""
    sizes = {"a": 1e-6, "omega": 1e-9, "omegadot": 1e-8}
    names = [(f"{q}_{k}", s) for q, s in sizes.items() for k in "xyz"]
    return x | {n: x[n] + s * rng.standard_normal(len(x[n])) for n, s in names}


def in_steps(x: Array, step: float) -> Array:
    return np.round(x / step) * step


def sensors_in_steps(step: float) -> Change:
    """Motion sensors that resolve so much, m/s^2 (and 1e-5 rad/s)."""
    steps = {f"a_{k}": step for k in "xyz"} | {f"omega_{k}": 1e-5 for k in "xyz"}
    return lambda x, r, rng: x | {n: in_steps(x[n], s) for n, s in steps.items()}


def uneven_stamps(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """Stamps that are off by 1e-5 to 1e-3 of a step, at random."""
    e = 10 ** rng.uniform(-5.0, -3.0) / r.rate * rng.standard_normal(len(r.clean))
    e[0] = 0.0
    return x | {"time": x["time"] + e}


def clock_set(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """The recorder's clock is set forward by 25 ms on the way; sampling goes on."""
    late = np.arange(len(r.clean)) > rng.uniform(0.3, 0.7) * len(r.clean)
    return x | {"time": x["time"] + 0.025 * late}


def digits(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """As a file of 6 to 9 significant digits holds it."""
    n = int(rng.integers(6, 10))
    written = {k: np.array([float(f"{v:.{n}g}") for v in values]) for k, values in x.items() if k != "time"}
    return x | written


def without_omegadot(x: Table, r: CleanOutput, rng: np.random.Generator) -> Table:
    """No angular acceleration, and gaps of up to 20 rows every few seconds."""
    present = np.ones(len(r.clean), dtype=np.bool_)
    start = int(5 * r.rate)
    while start < len(present):
        present[start : start + int(rng.integers(1, 20))] = False
        start += int(rng.uniform(2.0, 20.0) * r.rate)
    return {c: v[present] for c, v in x.items() if not c.startswith("omegadot")}


# --- the kinds -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RecordKind:
    """A kind of record: what its ``noise`` is like, the ``change`` that is made to it, and options of ``plan.world``.

    ``known``: effects are hidden in it, too: their strengths are measured with the noise as it is. ``tame``: the promise on false alarms
    holds for it: its noise is what the model of the noise means to describe, its file whole. ``allowed``: effects that are really there.
    ``nothing`` in it follows the motion: ``adequate`` is wrong. ``by_name``: it is flown only where it is asked for (``--record``), as it
    was not there when the seeds were chosen.
    """

    noise: NoiseKind = lambda x, rng: Loudness()
    change: Change = lambda x, r, rng: x
    known: bool = False
    tame: bool = False
    allowed: frozenset[str] = frozenset()
    nothing: bool = False
    world: Mapping[str, Any] = field(default_factory=dict)
    by_name: bool = False


def _tame(noise: NoiseKind = RecordKind.noise, **world: Any) -> RecordKind:
    return RecordKind(noise, known=True, tame=True, world=world)


def _asked(noise: NoiseKind, change: Change = RecordKind.change) -> RecordKind:
    return RecordKind(noise, change, tame=True, by_name=True)


_STEPS, _SPIN = frozenset({"quantisation"}), frozenset({"spin-rate-offset"})

# Every kind of record, by name
KINDS: Mapping[str, RecordKind] = {
    "white": _tame(),
    "red": _tame(red),
    "walk": _tame(walk),
    # five times the density over 0.1 Hz about twice the spin rate
    "bump": _tame(lambda x, rng: Loudness(lambda f: 1.0 + 4.0 * np.exp(-0.5 * ((f - 2 * SPIN) / 0.05) ** 2))),
    "along-axes": _tame(along_axes),
    "with-size": _tame(with_size),
    "with-ax": RecordKind(in_proportion(lambda x: np.abs(x["a_x"])), tame=True),
    "with-temperature": _tame(with_temperature),
    "ramp": _tame(ramp),
    "louder-part": RecordKind(louder_part, tame=True),
    "bursts": RecordKind(bursts, known=True, tame=True),
    "cyclic": RecordKind(cyclic, tame=True),
    # Student's t with three degrees of freedom
    "heavy-tails": RecordKind(
        change=output(lambda G, r, rng: r.clean + r.rms * rng.standard_t(3, len(G)) / np.sqrt(3.0)),
        known=True,
        tame=True,
    ),
    "unknown-gradient": _tame(red, gradient=False),
    "recorded-motion": _tame(recorded=True),
    "elsewhere": _tame(elsewhere=True),
    "voltages": _tame(output="voltages"),
    "channels": RecordKind(tame=True, world={"output": "channels", "duration": 1200.0, "rate": 8.0}),
    "20s": RecordKind(tame=True, world={"duration": 20.0}),
    "60s": RecordKind(tame=True, world={"duration": 60.0}),
    "4-Hz": _tame(rate=4.0),
    "gaps": RecordKind(change=gaps, known=True, tame=True),
    "rough-gaps": RecordKind(change=rough_gaps, tame=True),
    "rows-lost": RecordKind(change=rows_lost, tame=True),
    "noisy-sensors": RecordKind(change=noisy_sensors),
    "sensors-0.5-mg": RecordKind(change=sensors_in_steps(0.5 * MILLI_G)),
    "sensors-1-mg": RecordKind(change=sensors_in_steps(MILLI_G)),
    "mains": RecordKind(change=mains),
    "line": RecordKind(change=line),
    "near-line": RecordKind(change=near_line),
    "jump": RecordKind(change=jump, allowed=frozenset({"bias-step"})),
    "spikes": RecordKind(change=spikes),
    "coarse": RecordKind(
        change=output(lambda G, r, rng: in_steps(G, rng.uniform(0.3, 3.0) * r.rms)), allowed=_STEPS
    ),
    "codes": RecordKind(change=codes),
    "stuck": RecordKind(change=stuck),
    # to one or ten milliseconds
    "rounded-stamps": RecordKind(
        change=lambda x, r, rng: x | {"time": np.round(x["time"], int(rng.integers(2, 4)))}
    ),
    "uneven-stamps": RecordKind(change=uneven_stamps),
    "clock-set": RecordKind(change=clock_set),
    "from-2-s": RecordKind(world={"start": 2.0}),
    "from-10-s": RecordKind(world={"start": 10.0}),
    "from-1802-s": RecordKind(world={"start": 1802.0}),
    "clock-50-ppm": RecordKind(allowed=_SPIN, world={"spin_off": 50e-6}),
    "spin-off": RecordKind(allowed=_SPIN, world={"spin_off": 1e-8}),
    "no-omegadot": RecordKind(change=without_omegadot),
    "digits": RecordKind(change=digits, allowed=_STEPS),
    "noiseless": RecordKind(change=digits, allowed=_STEPS, world={"density": 0.0}),
    "shuffled": RecordKind(change=output(lambda G, r, rng: rng.permutation(G)), nothing=True),
    "pure-noise": RecordKind(
        change=output(lambda G, r, rng: float(np.std(G)) * rng.standard_normal(len(G))), nothing=True
    ),
    "amplifier": _asked(amplifier),
    "with-rates": _asked(
        in_proportion(lambda x: np.sqrt(x["omega_x"] ** 2 + x["omega_y"] ** 2 + x["omega_z"] ** 2))
    ),
    "size-and-temperature": _asked(
        lambda x, rng: Loudness(level=with_size(x, rng).level * with_temperature(x, rng).level)
    ),
    "red-along-axes": _asked(lambda x, rng: Loudness(red(x, rng).psd, along_axes(x, rng).level)),
    # drifts stay as they are
    "walk-and-warmth": _asked(walk, louder_with(lambda x: x["temperature"] - np.min(x["temperature"]))),
    "walk-and-heave": _asked(walk, louder_with(lambda x: (x["a_z"] - np.mean(x["a_z"])) ** 2)),
    # Student's t at the noise's own level
    "heavy-with-size": _asked(
        with_size,
        output(lambda G, r, rng: r.clean + (G - r.clean) * np.sqrt(1.0 / rng.chisquare(3, len(G)))),
    ),
}

KNOWN = tuple(n for n, k in KINDS.items() if k.known)
FIRST = tuple(n for n, k in KINDS.items() if not k.by_name)


def sampled(noise_rms: Loudness, density: float, rng: np.random.Generator, size: int, rate: float) -> Array:
    """(4, N) m/s^2: noise of four accelerometers, white density (m/s^2)^2/Hz; no power below rate / (2 N)."""
    period = 2 * size
    f = np.fft.rfftfreq(period, 1 / rate)[1:]
    scale = np.sqrt(density * noise_rms.psd(f) * rate * period / 4)
    spectrum = np.zeros((4, size + 1), dtype=np.complex128)
    drawn = rng.standard_normal((2, 4, size))
    spectrum[:, 1:] = scale * (drawn[0] + 1j * drawn[1])
    spectrum[:, -1] = np.sqrt(2) * spectrum[:, -1].real
    return np.asarray(np.fft.irfft(spectrum, period)[:, :size] * noise_rms.level)
