"""What an instrument remembers of a record, by parameters of the model; and motion shifted in time.

Kinds of memory, with b = 1/(2 pi f_0)^2, d = 1/(2 pi f_0 Q), and the force that turns with the disc:
``mount`` adds (H - 1) x to the motion x, H = (1 + d s)/(1 + d s + b s^2); ``accelerometer``: the force behind
s/(1 + d s + b s^2) and s^2/(1 + d s + b s^2); ``heat``: products of its components behind 1/(1 + tau s), and exp(-t/tau);
``creep``, ``flow``: the same of the force itself, in a bias and in a mount; ``slip``, ``play``: friction, -1 to 1, of the
force in a bias and in a mount; ``cycle``: friction of the temperature.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq
from scipy.interpolate import make_interp_spline

from ragg_runtime.model.model import DerivedEffect, DerivedParameter, Model
from ragg_runtime.model.record import Record
from ragg_runtime.signals.derivative import bridge_gaps

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

SLIPPING = ("slip", "play", "cycle")
RELAXING = ("heat", "creep", "flow")  # kinds of memory that are alike, each of one effect
FORGOTTEN = 14.0  # time constants after which a linear response has forgotten: exp(-14) is a millionth
# s after which it no longer matters in which state a slipping part began: the force has changed often enough
SLIPPED = 120.0
WHOLE = 1e9  # s: a temperature may turn but once in a record
SETTLED = 3.0  # s in which a turning disc has turned the force over, so that what can slip has slipped
LEAST = 2e-3  # least value of what describes a memory, in neutral ones

SHARE = 0.15
"""Width of friction at which a search begins, over the standard deviation of the force in the disc's plane: from 0.01 to 0.4
the signatures beside the calibration correlate by 0.7 and more (two flights)."""

FINER = 4  # instants a sample at which what slips is followed: a force turns back between samples
# relative step of the width for the derivative by it: what slips has no derivative at some instants
DIFFERENCE = 1e-3


@dataclass(frozen=True)
class Memory:
    """Of an effect: its ``kind``, and the values, SI, that describe it: ``f_0`` and ``Q``, ``tau``, or ``w``."""

    kind: str
    values: Mapping[str, float]

    @property
    def lasts(self) -> float:
        """For how long, s, it remembers."""
        v = self.values
        if self.kind in SLIPPING:
            return WHOLE if self.kind == "cycle" else SLIPPED
        return FORGOTTEN * (v["tau"] if self.kind in RELAXING else v["Q"] / (np.pi * v["f_0"]))

    @property
    def settles(self) -> float:
        """s after which the time before a record no longer matters: 0 for relaxation, whose initial state has parameters, and for
        a temperature's cycle, whose initial state is a bias.
        """
        if self.kind in (*RELAXING, "cycle"):
            return 0.0
        return SETTLED if self.kind in SLIPPING else self.lasts


def list_memories(model: Model, p: Array) -> Iterator[Memory]:
    """Memories of a model's effects, by the parameters p (size,), SI."""
    places = model.chain.places
    for e in (e for e in model.effects if e.memory is not None):
        shape = (q for q in e.parameters if q.shape)
        yield Memory(str(e.memory), {q.name: float(p[places[q.symbol].start]) for q in shape})


def allows_memories(model: Model, p: Array) -> bool:
    """Whether the parameters p (size,), SI, describe memories: no frequency, time or width is below zero, or next to it."""
    shape = (q for e in model.effects if e.memory is not None for q in e.parameters if q.shape)
    return all(p[model.chain.places[q.symbol].start] >= LEAST * q.default for q in shape)


def first_memories(effects: Iterable[DerivedEffect], r: Record) -> Iterator[tuple[DerivedEffect, Memory]]:
    """Memories of effects that are not in the model, with which a search in this record begins."""
    for e in (e for e in effects if e.memory is not None):
        values = {q.name: q.default for q in e.parameters if q.shape}
        if e.memory in SLIPPING:
            x, y, _ = (r.whole or r).along_disc()
            values = {"w": max(SHARE * float(np.hypot(np.nanstd(x), np.nanstd(y))), LEAST * values["w"])}
        yield e, Memory(str(e.memory), values)


def add_responses(r: Record, memories: Iterable[Memory], names: Container[str]) -> Record:
    """The record with the ``names`` series that these memories make of it."""
    wide = dict(r.wide)
    for m in memories:
        wide |= _compute_responses(r, m, names)
    return r if len(wide) == len(r.wide) else replace(r, wide=wide)


def _compute_responses(r: Record, m: Memory, names: Container[str]) -> dict[str, Array]:
    """Name -> (before + N + after,), as the channels of a part."""
    record = r.whole or r
    start, stop = r.first, r.first + len(r.time) + sum(r.halo)
    reach = min(int(np.ceil(abs(m.lasts) * r.rate)), len(record.time))  # of a fit that went below zero, too
    first, last = max(start - reach, 0), min(stop + reach, len(record.time))
    near = record.part(slice(first, last))
    # a part of a record has zeros for what is missing
    series = {
        n: bridge_gaps(x, near.valid | ((x != 0.0) & np.isfinite(x)))
        for n, x in _collect_inputs(m.kind, near).items()
    }
    slips = m.kind in SLIPPING
    responses = _slip(series, m, names) if slips else _filter_record(series, m, near.rate, reach, names)
    if m.kind in RELAXING:
        t, tau = near.time, m.values["tau"]
        decay = np.exp(-t / tau)
        responses |= {f"{m.kind}_start": decay, f"{m.kind}_start_by_tau": t / tau**2 * decay}
    return {n: x[start - first : stop - first] for n, x in responses.items() if n in names}


def _collect_inputs(kind: str, r: Record) -> Mapping[str, Array]:
    """The series that a memory of this kind acts on."""
    if kind == "mount":
        motion = (f"{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz")
        return {f"mount_{n}": r.channels[n] for n in motion if n in r.channels}
    if kind == "cycle":
        return {n: r.channels[n] for n in ("temperature",) if n in r.channels}
    x, y, z = r.along_disc()
    force = (x * r.cos_phi + y * r.sin_phi, y * r.cos_phi - x * r.sin_phi, z)
    if kind == "heat":
        pairs = ((i, k) for i in range(3) for k in range(i, 3))
        return {f"heat_{'rta'[i]}{'rta'[k]}": force[i] * force[k] for i, k in pairs}
    names = ("radial", "tangential", "axial")
    # each accelerometer's axes must be those of the one at angle 0, up to their order and signs
    if kind in SLIPPING and any(abs(cosine * sine) >= 1e-9 for cosine, sine, _ in r.input_axes):
        return {}
    prefix = f"{kind}_" if kind in RELAXING else ""
    return {f"{prefix}{n}": x for n, x in zip(names, force, strict=True)}


def _slip(force: Mapping[str, Array], m: Memory, names: Container[str]) -> dict[str, Array]:
    responses, w = {}, m.values["w"]
    for axis, x in force.items():
        name = f"{m.kind}_{axis}"
        if name not in names:
            continue
        between = make_interp_spline(np.arange(len(x)), x, k=3)(np.arange(FINER * len(x)) / FINER)
        responses[name] = apply_stop(between, w)[::FINER]
        if f"{name}_by_w" in names:
            narrower, wider = (apply_stop(between, w * (1.0 + side * DIFFERENCE)) for side in (-1.0, 1.0))
            responses[f"{name}_by_w"] = (wider - narrower)[::FINER] / (2 * DIFFERENCE * w)
    return responses


def apply_stop(x: Array, w: float) -> Array:
    """(N,): the stop operator of x, over w: it follows x between -1 and 1, at first from 0.

    It is x - y over w, with play y = clip(y before, x - w, x + w). Two such steps in succession are one with other limits, so
    that all are combined in log2 N rounds.
    """
    low, high = x - w, x + w
    low[0] = high[0] = x[0]
    step = 1
    while step < len(x):
        ends = low[step:].copy(), high[step:].copy()
        before = low[:-step].copy(), high[:-step].copy()
        low[step:], high[step:] = np.clip(before[0], *ends), np.clip(before[1], *ends)
        step *= 2
    return (x - low) / w


def _filter_record(
    inputs: Mapping[str, Array], m: Memory, rate: float, reach: int, names: Container[str]
) -> dict[str, Array]:
    responses: dict[str, Array] = {}
    for name, x in inputs.items():
        length = next_fast_len(len(x) + 2 * reach, real=True)
        s = np.asarray(2j * np.pi * rfftfreq(length, 1.0 / rate), dtype=np.complex128)
        ways = {n: H for n, H in _derive_transfer(m, name, s).items() if n in names}
        if ways:
            spectrum: Complex = rfft(_continue_smoothly(x, reach, length - len(x) - reach))
            for n, H in ways.items():
                responses[n] = float(H[0].real) * np.mean(x) + irfft(spectrum * H, length)[reach:][: len(x)]
    return responses


def _continue_smoothly(x: Array, before: int, after: int) -> Array:
    """A series less its mean, continued smoothly beyond both ends and faded out, as an edge would ring in all of it."""
    level = np.mean(x)
    longer = np.pad(x - level, (before, after), mode="reflect", reflect_type="odd")
    longer[:before] *= 0.5 - 0.5 * np.cos(np.pi * (np.arange(before) + 0.5) / max(before, 1))
    longer[len(longer) - after :] *= 0.5 + 0.5 * np.cos(np.pi * (np.arange(after) + 0.5) / max(after, 1))
    return longer


def _derive_transfer(m: Memory, name: str, s: Complex) -> dict[str, Complex]:
    """Response -> transfer function at s, 1/s, and its derivatives by what describes the memory."""
    if m.kind in RELAXING:
        H = 1 / (1 + m.values["tau"] * s)
        return {name: H, f"{name}_by_tau": -s * H**2}
    f_0, Q = m.values["f_0"], m.values["Q"]
    d, b = 1 / (2 * np.pi * f_0 * Q), 1 / (2 * np.pi * f_0) ** 2
    D = 1 + d * s + b * s**2
    if m.kind == "mount":
        ways = {name: (-b * s**2 / D, -(s**2) * (1 + d * s) / D**2, b * s**3 / D**2)}
    else:
        powers = {"rate": s, "curvature": s**2}
        ways = {f"{k}_{name}": (N / D, -N * s**2 / D**2, -N * s / D**2) for k, N in powers.items()}
    responses: dict[str, Complex] = {}
    for response, (H, by_b, by_d) in ways.items():
        responses[response] = H
        responses[f"{response}_by_f_0"] = -(2 * b * by_b + d * by_d) / f_0
        responses[f"{response}_by_Q"] = -d / Q * by_d
    return responses


def move_record(model: Model, r: Record, p: Array) -> tuple[Record, Array]:
    """The record with its motion shifted, and the parameters p (size,), SI, without what moved it.

    What describes a memory is left at its neutral values, about which the chain has its series.
    Motion is moved exactly: a series in a lateness fails at half a sample.
    """
    rest, memories = p.copy(), [*list_memories(model, p)]
    if memories:
        r, places = add_responses(r, memories, model.chain.INPUTS), model.chain.places
        for q in (q for e in model.effects if e.memory for q in e.parameters if q.shape):
            rest[places[q.symbol]] = q.neutral
    moves: dict[str, tuple[float, float]] = {}
    for k, q in list_late(model):
        if not p[k]:
            continue
        rest[k] = 0.0
        for quantity in q.late:
            offset, drift = moves.get(quantity, (0.0, 0.0))
            moves[quantity] = (offset, drift + p[k]) if q.growing else (offset + p[k], drift)
    return (r.shift(moves) if moves else r), rest


def list_late(model: Model) -> Iterator[tuple[int, DerivedParameter]]:
    """Parameters of a model that make motion late, each with its place in the parameter vector."""
    parameters = [q for e in model.effects for q in e.parameters if q.late]
    places = model.chain.places if parameters else {}
    yield from sorted(((places[q.symbol].start, q) for q in parameters), key=lambda x: x[0])
