"""Figures of the page: windows of series, spectra, spectrograms, the map of harmonic and motion term."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.identification import series as reported
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.studio import tracks
from ragg_runtime.studio.session import State
from ragg_runtime.studio.tracks import HEAD, Pyramid, pyramid
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

UNITS = ("V", "Eo", *DEMODULATED)

DENSE = 260
"""Frequencies of a spectrum."""

MULTIPLES = 6.0
"""A spectrogram reaches to this multiple of the spin unless more is asked for."""

COLUMNS = 26
"""Products of channels that the map of terms shows."""


@dataclass(frozen=True)
class Asked:
    """What is to be drawn: a series, its unit, the flight and which of its outputs, effects that are ticked, a window (s), points."""

    what: str
    unit: str
    flight: int
    output: int
    effects: tuple[str, ...]
    first: float
    last: float
    points: int


def series(s: State, a: Asked) -> bytes:
    """One series, or several (``what`` joined by ``;``) one after the other, each with its length in front."""
    if s.compared is None and a.what == "measured" and (found := _unexamined(s, a.flight)) is not None:
        return found.window(a.first, a.last, a.points)
    if a.what.startswith("compensated:"):
        c, what = s.compensated, a.what.partition(":")[2]
        how = () if c is None else (c.result["calibration"], c.result["demodulator"]["name"])
        key = ("compensated", *how, what, a.flight)
        made = s.tracks.cache.get(key, lambda: tracks.curve(c, what, a.flight))
        assert isinstance(made, Pyramid)
        return made.window(a.first, a.last, a.points)
    window, n = (a.first, a.last), s.tracks.place(a.flight, a.output)
    if a.what.startswith("channel:"):
        return s.tracks.channel(a.what.partition(":")[2], n).window(a.first, a.last, a.points)
    drawn = s.tracks.drawn(a.what, a.unit, n, a.effects, window)
    return drawn.window(a.first, a.last, a.points)


def _rows(time: Array, rate: float, a: Asked) -> slice:
    n = len(time)
    first, last = ((t - float(time[0])) * rate for t in (a.first, a.last))
    i, j = int(np.clip(np.floor(first), 0, n)), int(np.clip(np.ceil(last) + 1, 0, n))
    if j - i < 64:
        raise UserError("the stretch is too short for a spectrum", found=f"{max(0, j - i)} samples")
    return slice(i, j)


def _unexamined(s: State, flight: int) -> Pyramid | None:
    """The output of a flight as it was read, before it is compared."""
    x = s.flights[flight] if 0 <= flight < len(s.flights) else None
    if x is None or not x.outputs or not len(x):
        return None
    values = next(iter(x.outputs.values()))
    make = lambda: pyramid(0.0, 1.0 / x.rate, len(x), lambda k: values[k])  # noqa: E731
    made = s.tracks.cache.get(("read", flight), make)
    assert isinstance(made, Pyramid)
    return made


def spectra(s: State, a: Asked) -> dict[str, Any]:
    """Amplitude densities, Eo/sqrt(Hz), of the residual now, before the last step, and with effects; and the noise."""
    f, n = s.tracks.compared.fitted, s.tracks.place(a.flight, a.output)
    r, k_ggi = f.prepared[n].observation.record, f.scales[n]
    rows = _rows(r.time, r.rate, a)
    valid = r.valid[rows]
    lines = {}
    for name in _lines(s, a):
        try:
            x = _volts(s, a, n, name, rows)
        except UserError:
            continue  # of so long a flight the signature is not known everywhere
        found = reported.spectrum(x / k_ggi, valid, r.rate, DENSE)
        if found is not None:
            lines[name] = found
    if not lines:
        raise UserError("no stretch without gaps is long enough for a spectrum")
    grid = next(iter(lines.values())).frequency
    noise = reported.noise_density(f.prepared[n], k_ggi, r.spin_frequency, grid)
    return {
        "frequency": grid.tolist(),
        "lines": {n: x.density.tolist() for n, x in lines.items()},
        "noise": noise.tolist(),
        "spin_Hz": abs(r.spin_frequency),
    }


def _lines(s: State, a: Asked) -> list[str]:
    found = ["residual"]
    if s.tracks.before is not None:
        found.insert(0, "before")
    if s.beside is not None:
        found.insert(0, "beside")
    if a.effects and s.tracks.found is not None:
        found.append("left")
    return found


def _volts(s: State, a: Asked, n: int, name: str, rows: slice) -> Array:
    if name == "left":
        e = s.tracks.effect(a.effects, n, (a.first, a.last))
        if e.rows.start > rows.start or e.rows.stop < rows.stop:
            raise UserError("not known there")
        inside = slice(rows.start - e.rows.start, rows.stop - e.rows.start)
        return s.tracks.volts("residual", n)[rows] - e.volts[inside]
    if name == "beside" and s.beside is not None:
        step, old = s.beside
        kept = s.tracks.cache.get(("beside", step), lambda: old.residual)
        return kept[n][rows]  # type: ignore[index,no-any-return]
    return s.tracks.volts(name, n)[rows]


def spectrogram_of(s: State, a: Asked, highest: float) -> bytes:
    """Instants, frequencies and densities (Eo/sqrt(Hz)) as floats: two lengths, first and last of each axis, values."""
    f, n = s.tracks.compared.fitted, s.tracks.place(a.flight, a.output)
    r, k_ggi = f.prepared[n].observation.record, f.scales[n]
    rows = _rows(r.time, r.rate, a)
    spin = abs(r.spin_frequency)
    top = highest or MULTIPLES * spin or r.rate / 2
    name = a.what if a.what in ("residual", "before", "left", "measured") else "residual"
    x = _volts(s, a, n, name, rows) / k_ggi
    found = spectrogram(
        x,
        np.asarray(r.valid[rows]),
        r.rate,
        float(r.time[rows.start]),
        spin or top / MULTIPLES,
        min(top, r.rate / 2),
    )
    if found is None or not np.isfinite(found.density).any():
        raise UserError("no stretch without gaps is long enough for a spectrogram")
    t, g = found.time, found.frequency
    head = struct.pack("<4sIIdddd", b"RAGS", len(t), len(g), t[0], t[-1], g[0], g[-1])
    return head + np.ascontiguousarray(found.density, dtype="<f4").tobytes()


def heat_map(s: State, a: Asked) -> dict[str, Any]:
    """Significance of harmonic x product of channels: the single channels, and the products that stand out most."""
    h = s.tracks.heat(a.effects, s.tracks.place(a.flight, a.output))
    strongest = np.nanmax(np.abs(np.where(np.isnan(h.z), 0.0, h.z)), axis=0)
    single = [
        k
        for k, p in enumerate(h.products)
        if "*" not in p and "(" not in p and not p.startswith(("d_", "d2_"))
    ]
    rest = [int(k) for k in np.argsort(-strongest, kind="stable") if k not in single]
    chosen = [*single, *rest[: max(0, COLUMNS - len(single))]]
    # without spin there are no harmonics
    there = [i for i in range(len(h.harmonics)) if np.isfinite(h.z[i]).any()]
    return {
        "harmonics": [{"id": h.harmonics[i], "words": numbers.harmonic(h.harmonics[i])} for i in there],
        "products": [{"id": h.products[k], "words": numbers.product(h.products[k])} for k in chosen],
        "z": [[float(h.z[i, k]) for k in chosen] for i in there],
        "level": h.level,
        "tried": int(np.sum(np.isfinite(h.z))),
    }


__all__ = ["HEAD", "UNITS", "Asked", "heat_map", "series", "spectra", "spectrogram_of"]


MOST_COLUMNS = 240
"""Most instants of a spectrogram."""

ROWS = 160
"""Most frequencies of a spectrogram."""

RESOLUTION = 0.25
"""Width of a bin over the spin frequency, at most: neighbouring multiples must stay apart."""

LEAST = 0.9
"""Share of the samples under a window that must be valid."""


@dataclass(frozen=True)
class Spectrogram:
    """Amplitude densities, unit/sqrt(Hz), (frequencies, instants); NaN where too little is valid."""

    time: Array
    frequency: Array
    density: Array


def spectrogram(
    x: Array, valid: NDArray[np.bool_], rate: float, start: float, spin: float, highest: float
) -> Spectrogram | None:
    """Of samples from ``start`` (s) on, up to a frequency (Hz); ``None`` if they are too few for one window."""
    n = len(x)
    size = int(min(rate / (RESOLUTION * spin) * 2, n / 3)) if n else 0
    if size < 16:
        return None
    hop = max(1, size // 4, -(-(n - size) // MOST_COLUMNS))
    starts = np.arange(0, n - size + 1, hop)
    window = np.hanning(size)
    scale = 2.0 / (rate * float(np.sum(window**2)))
    f: Array = np.asarray(np.fft.rfftfreq(size, 1.0 / rate), dtype=np.float64)
    kept = (f > 0.0) & (f <= highest)
    density = np.full((int(np.sum(kept)), len(starts)), np.nan)
    for k, a in enumerate(starts):
        v = valid[a : a + size]
        share = float(np.mean(v))
        if share >= LEAST:
            y = np.where(v, x[a : a + size], 0.0)
            p = np.abs(np.fft.rfft((y - np.mean(y)) * window)[kept]) ** 2
            density[:, k] = p * scale / share
    f = f[kept]
    by = -(-len(f) // ROWS)
    if by > 1:
        edges = np.arange(0, len(f) - by + 1, by)
        density = np.add.reduceat(density, edges, axis=0)[: len(edges)] / by
        f = f[edges] + 0.5 * (by - 1) * (f[1] - f[0])
    return Spectrogram(
        time=np.asarray(start + (starts + 0.5 * size) / rate, dtype=np.float64),
        frequency=np.asarray(f, dtype=np.float64),
        density=np.sqrt(density),
    )
