"""What the figures of the page draw: windows of series, spectra, spectrograms, the map of harmonic and motion term."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.identification import comparison, heat, predict
from ragg_runtime.identification import series as reported
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.report import parameters, whiteness
from ragg_runtime.report.plots import draw_file
from ragg_runtime.studio.sampled import Sampled
from ragg_runtime.studio.session import State
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

UNITS = ("V", "Eo", *DEMODULATED)

DENSE = 260
"""Frequencies of a spectrum."""

MULTIPLES = 6.0
"""A spectrogram reaches to this multiple of the spin unless more is asked for."""

COLUMNS = 26
"""Products of channels that the map of terms shows."""

MOST_COLUMNS, ROWS = 240, 160
"""Most instants and frequencies of a spectrogram."""

RESOLUTION = 0.25
"""Width of a bin over the spin frequency, at most: neighbouring multiples must stay apart."""

LEAST = 0.9
"""Share of the samples under a window that must be valid."""


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


def draw_series(s: State, a: Asked) -> bytes:
    """The window of a series that is asked for."""
    kind, _, name = a.what.partition(":")
    if s.compared is None and kind == "measured" and 0 <= a.flight < len(s.flights):
        made = _unexamined(s, a.flight)
    elif kind == "compensated":
        made = _compensated(s, name, a.flight)
    elif kind == "channel":
        made = _channel(s, name, _place(s, a))
    else:
        made = _drawn(s, a, _place(s, a))
    return made.window(a.first, a.last, a.points)


def _known(s: State) -> Comparison:
    if s.compared is None:
        raise UserError("there is nothing to draw yet", remedy="wait until the flights are compared")
    return s.compared


def _tested(s: State) -> Diagnosis:
    if s.diagnosed is None:
        raise UserError("the effects are not tested yet", remedy="wait a moment")
    return s.diagnosed


def _place(s: State, a: Asked) -> int:
    """Which observation an output of a flight is: what ``n`` means everywhere below."""
    known = [n for n, o in enumerate(_known(s).fitted.observations) if o.flight == a.flight]
    if not 0 <= a.output < len(known):
        raise UserError("there is no such flight", found=f"flight {a.flight + 1}, output {a.output + 1}")
    return known[a.output]


def _unexamined(s: State, flight: int) -> Sampled:
    """The output of a flight as it was read, before it is compared."""
    x = s.flights[flight]
    if not x.outputs or not len(x):
        raise UserError("the flight holds no output", where=x.name)
    values = next(iter(x.outputs.values()))
    return s.cache.get(("read", flight), lambda: Sampled.of(0.0, 1.0 / x.rate, values))


def _compensated(s: State, what: str, flight: int) -> Sampled:
    """``inline`` and such, or ``inline:low`` and ``inline:high``: one standard uncertainty below and above it, Eo."""
    c = s.compensated
    name, _, edge = what.partition(":")
    if (
        c is None
        or not 0 <= flight < len(c.series)
        or f"{name}_std" not in c.units
        or edge not in ("", "low", "high")
    ):
        raise UserError("there is no such compensated channel", found=what[:40])
    x, sign = c.series[flight], {"": 0.0, "low": -1.0, "high": 1.0}[edge]
    start, end = (float(x["time"][k]) for k in (0, -1))
    y = x[name] + sign * x[f"{name}_std"] if sign else x[name]
    key = ("compensated", c.result["calibration"], c.result["demodulator"]["name"], what, flight)
    return s.cache.get(key, lambda: Sampled.of(start, (end - start) / max(1, len(y) - 1), y))


def _channel(s: State, name: str, n: int) -> Sampled:
    """A recorded channel in its own unit."""
    r = _known(s).fitted.prepared[n].observation.record
    if name not in r.wide:
        raise UserError("the flight has no such channel", found=repr(name[:40]))
    y = np.where(r.valid, r.wide[name], np.nan)
    return s.cache.get(("channel", name, n), lambda: Sampled.of(float(r.time[0]), 1.0 / r.rate, y))


def _drawn(s: State, a: Asked, n: int) -> Sampled:
    """A series in V, Eo, or demodulated (``inline``, ``cross``, Eo)."""
    f = _known(s).fitted
    r, rows = f.prepared[n].observation.record, _rows_known(s, a, n)

    def make() -> Sampled:
        x, time = _volts(s, a, n, a.what, rows), r.time[rows]
        if a.unit not in DEMODULATED:
            y = np.where(r.valid[rows], x / (1.0 if a.unit == "V" else f.scales[n]), np.nan)
            return Sampled.of(float(time[0]), 1.0 / r.rate, y)
        if not r.turning:
            raise UserError("disc not spinning: no demodulation")
        if len(x) < len(r.time):
            raise UserError("the signature of an effect is drawn in V or Eo alone in so long a flight")
        found = comparison.demodulated_one(f, n, x)
        if not len(found[0]):
            raise UserError("the flight is too short to be demodulated", where=f.observations[n].name)
        return Sampled.with_gaps(found[0], found[1 + DEMODULATED.index(a.unit)], 1.0 / r.rate)

    effects = a.effects if a.what in ("effect", "left") else ()
    return s.cache.get(("drawn", a.what, a.unit, n, effects, rows.start, rows.stop), make)


def _rows_known(s: State, a: Asked, n: int) -> slice:
    """Samples at which a series is known: of a long flight the signature of an effect only where the window lies."""
    if a.what in ("effect", "left"):
        return _signature(s, a, n)[0]
    return slice(0, len(_known(s).fitted.prepared[n].observation.record.time))


def _signature(s: State, a: Asked, n: int) -> tuple[slice, Array]:
    """Samples, and what the ticked effects would take out of the residual there, V."""
    d = _tested(s)
    rows = predict.choose_rows(d.fitted, n, (a.first, a.last))

    def make() -> tuple[slice, Array]:
        return predict.compute_signature(
            d.fitted, n, predict.fit_effects(d.fitted, predict.field_of_diagnosis(d), a.effects), rows
        )

    return s.cache.get(("signature", a.effects, n, rows.start, rows.stop), make)


def _volts(s: State, a: Asked, n: int, name: str, rows: slice) -> Array:
    """(rows,) V of any series; zero where a sample is not valid.

    ``effect`` is what the ticked effects would take out of the residual, ``left`` what they would leave; ``term:h:p`` a generic
    term as it would be fitted by itself; ``band:low:high`` (Hz) what of the residual lies there; ``before`` the residual of the
    last step, ``beside`` that of the model beside it.
    """
    now = _known(s)
    kind, _, of = name.partition(":")
    if kind in ("effect", "left"):
        known, taken = _signature(s, a, n)
        if known.start > rows.start or known.stop < rows.stop:
            raise UserError("of so long a flight the signature is not known everywhere")
        taken = taken[rows.start - known.start : rows.stop - known.start]
        return taken if kind == "effect" else now.residual[n][rows] - taken
    match kind:
        case "measured":
            x = reported.measured(now.fitted.prepared[n])
        case "residual":
            x = now.residual[n]
        case "modelled":
            x = reported.measured(now.fitted.prepared[n]) - now.residual[n]
        case "before" | "beside":
            x = _other(s, kind, n)
        case "term":
            x = _term(s, of, n)
        case "band":
            x = _band(s, of, n)
        case _:
            raise UserError("there is no such series", found=repr(name[:40]))
    return np.asarray(x[rows])


def _other(s: State, kind: str, n: int) -> Array:
    other = s.previous if kind == "before" else s.beside[1] if s.beside else None
    if other is None or len(other.fitted.prepared) != len(_known(s).fitted.prepared):
        raise UserError("there is no step before this one" if kind == "before" else "no model is beside it")
    return other.residual[n]


def _term(s: State, name: str, n: int) -> Array:
    harmonic, _, product = name.partition(":")
    h = terms_of(s, (), n)
    if harmonic not in h.harmonics or product not in h.products:
        raise UserError("there is no such term", found=f"{harmonic} x {product}"[:80])
    c = float(h.coefficient[h.harmonics.index(harmonic), h.products.index(product)])
    if not np.isfinite(c):
        raise UserError("the model holds this term already", found=f"{harmonic} x {product}")
    return heat.series(_known(s).fitted.prepared[n], harmonic, product, c)


def _band(s: State, name: str, n: int) -> Array:
    try:
        low, high = (float(x) for x in name.split(":"))
    except ValueError:
        raise UserError("a band is needed", found=repr(name[:40]), expected="band:0.2:0.3") from None
    now = _known(s)
    return reported.within_band(now.residual[n], now.fitted.prepared[n].observation.record.rate, low, high)


def terms_of(s: State, effects: tuple[str, ...], n: int) -> heat.Heat:
    """Harmonic x motion term of the residual once these effects are in."""
    d = s.diagnosed
    f = _known(s).fitted if d is None else d.fitted
    given = [] if d is None else predict.columns_of(predict.field_of_diagnosis(d), effects)
    make = lambda: heat.heat(f.prepared[n], f.triangles[n], f.n_base, given)  # noqa: E731
    return s.cache.get(("heat", effects, n, d is None), make)


def predict_error(s: State, a: Asked) -> dict[str, Any]:
    """The error that the ticked effects would leave, and that without them."""
    d, unwhitened = _tested(s), s.unwhitened
    if unwhitened is None:
        raise UserError("the effects are not tested yet", remedy="wait a moment")
    known = predict.field_of_diagnosis(d)

    def predicted(*effects: str) -> predict.Prediction:
        make = lambda: predict.predict_error(d.fitted, unwhitened, known, effects)  # noqa: E731
        return s.cache.get(("predicted", effects), make)

    found = predicted(*(e for e in a.effects if e in known.candidates))
    return found.as_json() | {"before_Eo": predicted().rms_Eo, "noise_Eo": d.noise_floor}


def _window(time: Array, rate: float, a: Asked) -> slice:
    n = len(time)
    first, last = ((t - float(time[0])) * rate for t in (a.first, a.last))
    i, j = int(np.clip(np.floor(first), 0, n)), int(np.clip(np.ceil(last) + 1, 0, n))
    if j - i < 64:
        raise UserError("the segment is too short for a spectrum", found=f"{max(0, j - i)} samples")
    return slice(i, j)


def draw_spectra(s: State, a: Asked) -> dict[str, Any]:
    """Amplitude densities, Eo/sqrt(Hz), of the residual now, before the last step, and with effects; and the noise."""
    f, n = _known(s).fitted, _place(s, a)
    w, k_ggi = f.prepared[n], f.scales[n]
    r = w.observation.record
    rows = _window(r.time, r.rate, a)
    ticked = a.effects and s.diagnosed is not None
    wanted = {"beside": s.beside, "before": s.previous, "residual": True, "left": ticked}
    lines = {}
    for name in (k for k, v in wanted.items() if v):
        try:
            x = _volts(s, a, n, name, rows)
        except UserError:
            continue
        found = reported.spectrum(x / k_ggi, r.valid[rows], r.rate, DENSE)
        if found is not None:
            lines[name] = found
    if not lines:
        raise UserError("no segment without gaps is long enough for a spectrum")
    grid = next(iter(lines.values())).frequency
    return {
        "frequency": grid.tolist(),
        "lines": {k: x.density.tolist() for k, x in lines.items()},
        "noise": reported.noise_density(w, k_ggi, r.spin_frequency, grid).tolist(),
        "spin_Hz": abs(r.spin_frequency),
    }


def draw_spectrogram(s: State, a: Asked) -> bytes:
    """Instants, frequencies and densities (Eo/sqrt(Hz)) as floats: two lengths, first and last of each axis, values."""
    f, n = _known(s).fitted, _place(s, a)
    r = f.prepared[n].observation.record
    rows = _window(r.time, r.rate, a)
    spin = abs(r.spin_frequency)
    top = min(MULTIPLES * spin or r.rate, r.rate / 2)
    name = a.what if a.what in ("residual", "before", "left", "measured") else "residual"
    x = _volts(s, a, n, name, rows) / f.scales[n]
    time, frequency, density = spectrogram(x, np.asarray(r.valid[rows]), r.rate, spin or top / MULTIPLES, top)
    if not np.isfinite(density).any():
        raise UserError("no segment without gaps is long enough for a spectrogram")
    t = r.time[rows.start] + time
    ends = t[0], t[-1], frequency[0], frequency[-1]
    head = struct.pack("<4sIIdddd", b"RAGS", len(t), len(frequency), *ends)
    return head + np.ascontiguousarray(density, dtype="<f4").tobytes()


def spectrogram(
    x: Array, valid: NDArray[np.bool_], rate: float, spin: float, highest: float
) -> tuple[Array, Array, Array]:
    """Instants (s since the first sample), frequencies up to ``highest`` (Hz), and densities (frequencies, instants), unit/sqrt(Hz).

    NaN where too little is valid; no instants if the samples are too few for one window.
    """
    from scipy import signal

    size = int(min(rate / (RESOLUTION * spin) * 2, len(x) / 3)) if len(x) else 0
    if size < 16:
        return np.zeros(0), np.zeros(0), np.zeros((0, 0))
    hop = max(1, size // 4, -(-(len(x) - size) // MOST_COLUMNS))
    given = np.where(valid, x, 0.0)
    f, t, p = signal.spectrogram(given, rate, "hann", size, size - hop, detrend="constant")
    share = np.lib.stride_tricks.sliding_window_view(valid, size)[::hop].mean(axis=1)
    kept = (f > 0.0) & (f <= highest)
    f, p = f[kept], np.where(share >= LEAST, p[kept] / np.maximum(share, LEAST), np.nan)
    by = -(-len(f) // ROWS)
    whole = len(f) // by * by
    f, p = (v[:whole].reshape(-1, by, *v.shape[1:]).mean(axis=1) for v in (f, p))
    return np.asarray(t), np.asarray(f), np.sqrt(p)


def draw_heat(s: State, a: Asked) -> dict[str, Any]:
    """Significance of harmonic x product of channels: the single channels, and the products that stand out most."""
    h = terms_of(s, a.effects, _place(s, a))
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


def draw_panel(s: State, a: Asked) -> bytes:
    """A panel of the reports as SVG: ``correlations``, ``whiteness``, or ``against:CHANNEL`` of a flight."""
    now, n = _known(s), _place(s, a)
    kind, _, channel = a.what.partition(":")
    residual = now.residual[n]
    match kind:
        case "correlations":
            plot: Any = parameters.correlations(now.fitted)[0]
        case "whiteness":
            plot = whiteness.plot_whiteness(now.fitted, n, residual)
        case "against":
            plot = whiteness.plot_against(now.fitted, n, residual, channel)
        case _:
            raise UserError("there is no such panel", found=repr(kind[:40]))
    return draw_file(plot).encode()
