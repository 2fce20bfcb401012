"""Motion and force that reach the instrument through a resonance: the record's own, passed through it.

With b = 1/(2 pi f_0)^2 and d = 1/(2 pi f_0 Q) a mount adds (H - 1) x to the motion x, H = (1 + d s)/(1 + d s + b s^2); an
accelerometer sees s/(1 + d s + b s^2) and s^2/(1 + d s + b s^2) of the force that turns with the disc.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

from ragg_runtime.model.evaluator import find_places
from ragg_runtime.model.model import DerivedEffect, Model
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

MEMORY = 14.0
"""Time constants after which a resonance has forgotten: exp(-14) is a millionth."""

LEAST = 1e-2
"""Least frequency, Hz, and Q: a fit may try others on its way."""


def list_resonances(model: Model, p: Array) -> Iterator[tuple[DerivedEffect, float, float]]:
    """The effects of a model that act through a resonance, with its frequency, Hz, and Q by the parameters p (size,), SI."""
    for e in (e for e in model.effects if e.resonance is not None):
        places = find_places(model.chain)
        f_0, Q = (float(p[places[q.symbol].start]) for q in e.parameters if q.shape)
        yield e, max(f_0, LEAST), max(Q, LEAST)


def neutral_values(effects: Iterable[DerivedEffect]) -> Iterator[tuple[DerivedEffect, float, float]]:
    """The same of effects that are not in the model: where a search begins."""
    for e in effects:
        if e.resonance is not None:
            f_0, Q = (q.default for q in e.parameters if q.shape)
            yield e, f_0, Q


def memory(f_0: float, Q: float) -> float:
    """For how long, s, a resonance remembers."""
    return MEMORY * Q / (np.pi * f_0)


def with_responses(
    r: Record, effects: Iterable[tuple[DerivedEffect, float, float]], wanted: Container[str]
) -> Record:
    """The record with the ``wanted`` series that these effects take through their resonances."""
    wide = dict(r.wide)
    for e, f_0, Q in effects:
        wide |= _responses(r, str(e.resonance), f_0, Q, wanted)
    return r if len(wide) == len(r.wide) else replace(r, wide=wide)


def _responses(r: Record, kind: str, f_0: float, Q: float, wanted: Container[str]) -> dict[str, Array]:
    """Name -> (before + N + after,), as the channels of a part."""
    whole = r.whole or r
    before, after = r.halo
    start = int(np.searchsorted(whole.time, r.time[0])) - before
    stop = start + before + len(r.time) + after
    reach = min(int(np.ceil(memory(f_0, Q) * r.rate)), len(whole.time))
    first, last = max(start - reach, 0), min(stop + reach, len(whole.time))
    near = whole.part(slice(first, last))
    given = _motion(near) if kind == "mount" else _turning_force(near)
    size = last - first + 2 * reach
    length = next_fast_len(size, real=True)
    s = np.asarray(2j * np.pi * rfftfreq(length, 1.0 / r.rate), dtype=np.complex128)
    found: dict[str, Array] = {}
    at = np.arange(last - first)
    for name, x in given.items():
        there = near.valid | ((x != 0.0) & np.isfinite(x))  # a part has zeros for what is missing
        if there.any() and not there.all():
            x = np.interp(at, at[there], x[there])
        spectrum: Complex = rfft(_continued(x, reach, length - size + reach))
        for response, H in _transfer(kind, name, s, f_0, Q).items():
            if response in wanted:
                found[response] = irfft(spectrum * H, length)[reach + start - first :][: stop - start]
    return found


def _continued(x: Array, before: int, after: int) -> Array:
    """A series that goes on smoothly beyond both ends and fades: an edge would ring in all of it."""
    level = np.mean(x)
    longer = np.pad(x - level, (before, after), mode="reflect", reflect_type="odd")
    longer[:before] *= 0.5 - 0.5 * np.cos(np.pi * (np.arange(before) + 0.5) / max(before, 1))
    longer[len(longer) - after :] *= 0.5 + 0.5 * np.cos(np.pi * (np.arange(after) + 0.5) / max(after, 1))
    return longer


def _motion(r: Record) -> Mapping[str, Array]:
    names = (f"{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz")
    return {f"mount_{n}": r.channels[n] for n in names if n in r.channels}


def _turning_force(r: Record) -> Mapping[str, Array]:
    """Specific force by axes that turn with the disc, of angle 0 on it."""
    x, y, z = r.along_disc
    radial, tangential = x * r.cos_phi + y * r.sin_phi, y * r.cos_phi - x * r.sin_phi
    return {"radial": radial, "tangential": tangential, "axial": z}


def _transfer(kind: str, name: str, s: Complex, f_0: float, Q: float) -> dict[str, Complex]:
    """Response -> transfer function at s, 1/s, and its derivatives by f_0 and Q."""
    d, b = 1 / (2 * np.pi * f_0 * Q), 1 / (2 * np.pi * f_0) ** 2
    D = 1 + d * s + b * s**2
    if kind == "mount":
        ways = {name: (-b * s**2 / D, -(s**2) * (1 + d * s) / D**2, b * s**3 / D**2)}
    else:
        powers = {"rate": s, "curvature": s**2}
        ways = {f"{k}_{name}": (N / D, -N * s**2 / D**2, -N * s / D**2) for k, N in powers.items()}
    found: dict[str, Complex] = {}
    for response, (H, by_b, by_d) in ways.items():
        found[response] = H
        found[f"{response}_by_f_0"] = -(2 * b * by_b + d * by_d) / f_0
        found[f"{response}_by_Q"] = -d / Q * by_d
    return found
