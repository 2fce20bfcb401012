"""Data of the page's figures: windows of series, spectra, spectrograms, the map of harmonic and motion term, predictions."""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread
from ragg_runtime.compensation.calibrate import information, invert_root
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.scores import demodulate_residual
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import Term, list_harmonics
from ragg_runtime.identification.omnibus import Scores
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.identification.selection import ProjectedProblem, make_problem
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.report import panels
from ragg_runtime.report.plots import draw_file
from ragg_runtime.studio.session import State
from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Plot

Array = NDArray[np.float64]

UNITS = ("V", "Eo", *DEMODULATED)

DENSE = 260  # frequencies of a spectrum
MULTIPLES = 6.0  # a spectrogram reaches to this multiple of the spin unless more is asked for
COLUMNS = 26  # products of channels that the map of terms shows
MOST_COLUMNS, ROWS = 240, 160  # most instants and frequencies of a spectrogram
RESOLUTION = 0.25  # width of a bin over the spin frequency, at most: neighbouring multiples must stay apart
LEAST = 0.9  # share of the samples under a window that must be valid
MODELS = 12  # models that are drawn from the posterior


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


# header of a series: mark, number of points, first abscissa, step, kind (0: values, 1: least and greatest values)
HEAD = struct.Struct("<4sIddI")


@dataclass(frozen=True)
class Sampled:
    """A uniformly sampled series (N,), NaN where there is none, from ``start`` in steps of ``step`` (s); single precision draws all.

    Of a fan of models the values are (2, N), the least and the greatest.
    """

    start: float
    step: float
    values: NDArray[np.float32]

    def window(self, first: float, last: float, points: int) -> bytes:
        """The series between two abscissae, as :data:`HEAD` and floats: its samples, or the extremes of about ``points`` segments."""
        rows = np.atleast_2d(self.values)
        n = rows.shape[1]
        a = int(np.clip(np.floor((first - self.start) / self.step), 0, n))
        b = int(np.clip(np.ceil((last - self.start) / self.step) + 1, a, n))
        if b - a <= 2 * points:
            return self._pack(rows[:, a:b], float(a), 1)
        length = -(-(b - a) // points)
        a -= a % length  # segments stay the same ones where the window moves
        x = np.pad(rows[:, a:b], ((0, 0), (0, -(b - a) % length)), constant_values=np.nan)
        parts = x.reshape(len(rows), -1, length)
        extremes = np.stack([np.fmin.reduce(parts[0], axis=1), np.fmax.reduce(parts[-1], axis=1)])
        return self._pack(extremes, a + 0.5 * (length - 1), length)

    def _pack(self, values: NDArray[np.float32], first: float, length: int) -> bytes:
        start, step = self.start + first * self.step, length * self.step
        head = HEAD.pack(b"RAGG", values.shape[1], start, step, len(values) - 1)
        return head + np.ascontiguousarray(values, dtype="<f4").tobytes()


def sample(start: float, step: float, x: NDArray[np.floating[Any]]) -> Sampled:
    """A series (N,) as the page draws it."""
    return Sampled(start, step, np.asarray(x, dtype=np.float32))


# --- what effects would do before they are derived, and a generic term by itself ---------------------


def make_problem_of(d: Diagnosis) -> ProjectedProblem:
    """The testable effects, steps included, on the R factors of everything."""
    return make_problem(d.fitted, [r.effect for r in d.ranking])


def list_columns(problem: ProjectedProblem, effects: Sequence[str]) -> list[int]:
    """The testable candidate columns of some effects."""
    return [n for e in effects if e in problem.candidates for n in problem.testable(e)]


def fit_effects(
    f: Fitted, problem: ProjectedProblem, effects: Sequence[str], *, held_out: bool = False
) -> Array:
    """(size,): fitted coefficients of all columns with these effects in."""
    extra = list_columns(problem, effects)
    fitted, _ = f.coefficients(extra, held_out=held_out)
    return f.vector(fitted, extra)


@one_thread
def predict_error(f: Fitted, problem: ProjectedProblem, effects: Sequence[str]) -> tuple[float, float]:
    """The error before demodulation, Eo, calibrated and held out, that these effects would leave if everything is linear."""
    fit_scores, held_out = f.score([fit_effects(f, problem, effects, held_out=h) for h in (False, True)])
    return fit_scores.whole.rms_Eo, held_out.held_out.rms_Eo


@dataclass(frozen=True)
class Heat:
    """Significance ``z`` (harmonics, products of channels) of generic terms, each alone, in standard deviations (NaN: not
    asked); ``coefficient`` in V per SI unit of the product; from ``level`` on one of all the terms is significant.
    """

    harmonics: tuple[str, ...]
    products: tuple[str, ...]
    z: Array
    coefficient: Array
    level: float


@one_thread
def score_terms(f: Fitted, flight: int, projected: Sequence[int] = ()) -> Heat:
    """The scores of all terms in one flight once base and ``projected`` candidate columns are projected out, in one pass."""
    prepared, projector, _ = omnibus.project_out(f, flight, projected)
    s = Scores(prepared, projector)
    s.collect(lambda piece, y: None)
    norm = np.where(np.isfinite(s.norms), s.norms, np.nan)
    terms = s.dictionary.terms
    rows = list_harmonics()
    columns = tuple(dict.fromkeys(t.product for t in terms if t.harmonic in rows))
    z, coefficient = (np.full((len(rows), len(columns)), np.nan) for _ in range(2))
    row, column = ({name: k for k, name in enumerate(names)} for names in (rows, columns))
    for k, t in enumerate(terms):
        if t.harmonic in row:
            cell = row[t.harmonic], column[t.product]
            z[cell] = s.dot[k] / norm[k]
            coefficient[cell] = z[cell] / (norm[k] * s.dictionary.size(t))
    share = omnibus.FAMILY * omnibus.SHARES[0] / (2 * max(int(np.sum(np.isfinite(norm))), 1))
    return Heat(
        harmonics=rows, products=columns, z=z, coefficient=coefficient, level=-float(special.ndtri(share))
    )


# --- series over time ----------------------------------------------------------------------------------


def draw_series(s: State, a: Asked) -> bytes:
    """The window of a series that is asked for; before a flight is compared, of its output as it was read."""
    if s.compared is None and a.what == "measured" and 0 <= a.flight < len(s.flights):
        x = s.flights[a.flight]
        if not x.outputs or not len(x):
            raise UserError("the flight has no output", where=x.name)
        series = sample(0.0, 1.0 / x.rate, next(iter(x.outputs.values())))
    else:
        series = View(s, a).sample()
    return series.window(a.first, a.last, a.points)


class View:
    """A request for an output of a flight, ``n`` in its comparison ``c``; on a flight kept for ``validation`` nothing is fitted."""

    def __init__(self, s: State, a: Asked) -> None:
        self.s, self.a = s, a
        self.c, flight = s.result_for(a.flight)
        self.f, self.validation = self.c.fitted, self.c is not s.compared
        positions = [n for n, o in enumerate(self.f.observations) if o.flight == flight]
        if not 0 <= a.output < len(positions):
            place = f"flight {a.flight + 1}, output {a.output + 1}"
            raise UserError("there is no such flight", found=place)
        self.n = positions[a.output]
        self.prepared, self.k_ggi = self.f.prepared[self.n], self.f.scales[self.n]
        self.record, self.residual = self.prepared.observation.record, self.c.residual[self.n]

    def remember(self, key: tuple[object, ...], make: Callable[[], Any]) -> Any:
        """Something of this output, made once a state."""
        return self.s.cache.get((self.a.flight, self.n, *key), make)

    def sample(self) -> Sampled:
        """The series in V, Eo, or demodulated (``inline``, ``cross``, Eo); a recorded channel in its own unit."""
        kind, _, name = self.a.what.partition(":")
        r = self.record
        if kind == "channel":
            if name not in r.wide:
                raise UserError("the flight has no such channel", found=repr(name[:40]))
            return sample(float(r.time[0]), 1.0 / r.rate, np.where(r.valid, r.wide[name], np.nan))
        effects = self.a.effects if kind in ("effect", "left") else ()
        make = self._draw_fan if kind == "fan" else lambda: self._convert(self.volts(self.a.what))
        drawn: Sampled = self.remember(("drawn", self.a.what, self.a.unit, effects), make)
        return drawn

    def _draw_fan(self) -> Sampled:
        """The outermost residuals of models drawn from the posterior of the parameters, the same ones each time."""
        if self.validation:
            raise UserError("no model is drawn for a validation flight")
        draws = np.random.default_rng(0).standard_normal((MODELS, self.f.n_base))
        root = invert_root(information(self.f))
        residuals = self.prepared.residuals(np.stack([self.f.vector(root @ x) for x in draws]))
        series = [self._convert(x) for x in residuals]
        values = [x.values for x in series]
        return replace(series[0], values=np.stack([np.fmin.reduce(values), np.fmax.reduce(values)]))

    def _convert(self, x: Array) -> Sampled:
        """A series, V, in the unit that is asked for."""
        r, unit = self.record, self.a.unit
        start, step = float(r.time[0]), 1.0 / r.rate
        if unit not in DEMODULATED:
            return sample(start, step, np.where(r.valid, x / (1.0 if unit == "V" else self.k_ggi), np.nan))
        if not r.turning:
            raise UserError("disc not spinning: no demodulation")
        g = demodulate_residual(x, r, self.f.scales[self.n])
        if not np.isfinite(g).any():
            where = self.prepared.observation.name
            raise UserError("the flight is too short to be demodulated", where=where)
        return sample(start, step, g.real if unit == DEMODULATED[0] else g.imag)

    def _predict_left(self) -> Array:
        """The residual (N,), V, that the ticked effects would leave."""
        d, effects = self.s.require("diagnosed"), self.a.effects
        if self.validation:
            raise UserError("no effect is predicted for a validation flight")

        def make() -> list[Array]:
            v = fit_effects(d.fitted, make_problem_of(d), effects)
            return list(d.fitted.residuals(v))

        return self.s.cache.get(("left", effects), make)[self.n]

    def volts(self, name: str) -> Array:
        """(N,) V of any series; zero where a sample is not valid.

        ``effect`` is what the ticked effects would take out of the residual, ``left`` what they would leave; ``term:h:p`` a generic
        term fitted alone; ``band:low:high`` (Hz) the part of the residual there; ``before`` the residual before the
        last step.
        """
        kind, _, of = name.partition(":")
        match kind:
            case "effect":
                return self.residual - self._predict_left()
            case "left":
                return self._predict_left()
            case "measured":
                return panels.compute_measured(self.prepared)
            case "residual":
                return self.residual
            case "modelled":
                return panels.compute_measured(self.prepared) - self.residual
            case "before":
                return self._find_previous()
            case "term":
                return self._fit_term(of)
            case "band":
                return self._pass_band(of)
        raise UserError("there is no such series", found=repr(name[:40]))

    def _find_previous(self) -> Array:
        """The residual (N,), V, of the model before the last step."""
        other = self.s.previous
        if other is None or len(other.fitted.prepared) != len(self.f.prepared):
            raise UserError("there is no step before this one")
        return other.residual[self.n]

    def terms(self, effects: tuple[str, ...]) -> Heat:
        """Harmonic x motion term of the residual once these effects are in."""
        d = self.s.diagnosed
        if self.validation:
            d, effects = None, ()
        f = self.f if d is None else d.fitted
        columns = [] if d is None else list_columns(make_problem_of(d), effects)
        make = lambda: score_terms(f, self.n, columns)  # noqa: E731
        heat: Heat = self.remember(("heat", effects, d is None), make)
        return heat

    def _fit_term(self, name: str) -> Array:
        harmonic, _, product = name.partition(":")
        h = self.terms(())
        if harmonic not in h.harmonics or product not in h.products:
            raise UserError("there is no such term", found=f"{harmonic} x {product}"[:80])
        c = float(h.coefficient[h.harmonics.index(harmonic), h.products.index(product)])
        if not np.isfinite(c):
            raise UserError("the model already has this term", found=f"{harmonic} x {product}")
        channels = () if product == "1" else tuple(product.split("*"))
        x = omnibus.make_dictionary(self.prepared).series(Term(harmonic, channels), self.record)
        return np.asarray(np.where(self.record.valid, c * x, 0.0))

    def _pass_band(self, name: str) -> Array:
        try:
            low, high = (float(x) for x in name.split(":"))
        except ValueError:
            expected = "band:0.2:0.3"
            raise UserError("a band is needed", found=repr(name[:40]), expected=expected) from None
        f = np.fft.rfftfreq(len(self.residual), 1.0 / self.record.rate)
        passed = np.where((f >= low) & (f <= high), np.fft.rfft(self.residual), 0.0)
        return np.asarray(np.fft.irfft(passed, len(self.residual)))

    def rows(self) -> slice:
        """The samples of the window; UserError if these are too few for a spectrum."""
        n, t0, rate = len(self.record.time), float(self.record.time[0]), self.record.rate
        first, last = ((t - t0) * rate for t in (self.a.first, self.a.last))
        i, j = int(np.clip(np.floor(first), 0, n)), int(np.clip(np.ceil(last) + 1, 0, n))
        if j - i < 64:
            size = f"{max(0, j - i)} samples"
            raise UserError("the segment is too short for a spectrum", found=size)
        return slice(i, j)


# --- everything else -----------------------------------------------------------------------------------


def draw_preview(s: State, a: Asked) -> dict[str, Any]:
    """The error that the ticked effects would leave, and that without them."""
    d = s.require("diagnosed")
    problem = make_problem_of(d)

    def predicted(*effects: str) -> tuple[float, float]:
        make = lambda: predict_error(d.fitted, problem, effects)  # noqa: E731
        return s.cache.get(("predicted", effects), make)

    rms, held_out = predicted(*(e for e in a.effects if e in problem.candidates))
    return {"rms_Eo": rms, "holdout_Eo": held_out, "before_Eo": predicted()[0], "noise_Eo": d.noise_floor}


def draw_spectra(s: State, a: Asked) -> dict[str, Any]:
    """Amplitude densities, Eo/sqrt(Hz), of the residual now, before the last step, and with effects; and the noise."""
    v = View(s, a)
    r, rows, lines = v.record, v.rows(), {}
    ticked = a.effects and s.diagnosed is not None
    available = {"before": s.previous, "residual": True, "left": ticked}
    for name in (k for k, present in available.items() if present):
        try:
            x = v.volts(name)[rows]
        except UserError:
            continue
        spectrum = panels.estimate_spectrum(x / v.k_ggi, r.valid[rows], r.rate, DENSE)
        if spectrum is not None:
            lines[name] = spectrum
    if not lines:
        raise UserError("no segment without gaps is long enough for a spectrum")
    grid = next(iter(lines.values()))[0]
    return {
        "frequency": grid.tolist(),
        "lines": {k: density.tolist() for k, (_, density) in lines.items()},
        "noise": panels.compute_noise_density(v.prepared, v.k_ggi, r.spin_frequency, grid).tolist(),
        "spin_Hz": abs(r.spin_frequency),
    }


def draw_spectrogram(s: State, a: Asked) -> bytes:
    """Instants, frequencies and densities (Eo/sqrt(Hz)) as floats: two lengths, first and last of each axis, values."""
    v = View(s, a)
    r, rows, spin = v.record, v.rows(), abs(v.record.spin_frequency)
    top = min(MULTIPLES * spin or r.rate, r.rate / 2)
    name = a.what if a.what in ("residual", "before", "left", "measured") else "residual"
    x, valid = v.volts(name)[rows] / v.k_ggi, np.asarray(r.valid[rows])
    time, frequency, density = spectrogram(x, valid, r.rate, spin or top / MULTIPLES, top)
    if not np.isfinite(density).any():
        raise UserError("no segment without gaps is long enough for a spectrogram")
    t = r.time[rows.start] + time
    head = struct.pack("<4sIIdddd", b"RAGS", len(t), len(frequency), t[0], t[-1], frequency[0], frequency[-1])
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
    filled = np.where(valid, x, 0.0)
    f, t, p = signal.spectrogram(filled, rate, "hann", size, size - hop, detrend="constant")
    share = np.lib.stride_tricks.sliding_window_view(valid, size)[::hop].mean(axis=1)
    band = (f > 0.0) & (f <= highest)
    f, p = f[band], np.where(share >= LEAST, p[band] / np.maximum(share, LEAST), np.nan)
    group = -(-len(f) // ROWS)
    end = len(f) // group * group
    f, p = (v[:end].reshape(-1, group, *v.shape[1:]).mean(axis=1) for v in (f, p))
    return np.asarray(t), np.asarray(f), np.sqrt(p)


def draw_heat(s: State, a: Asked) -> dict[str, Any]:
    """Significance of harmonic x product of channels: the single channels, and the most significant products."""
    h = View(s, a).terms(a.effects)
    strongest = np.nanmax(np.abs(np.nan_to_num(h.z)), axis=0)
    single = [
        k
        for k, p in enumerate(h.products)
        if not any(c in p for c in "*(") and not p.startswith(("d_", "d2_"))
    ]
    rest = [int(k) for k in np.argsort(-strongest, kind="stable") if k not in single]
    products = [*single, *rest[: max(0, COLUMNS - len(single))]]
    # without spin there are no harmonics
    rows = [i for i in range(len(h.harmonics)) if np.isfinite(h.z[i]).any()]
    return {
        "harmonics": [{"id": h.harmonics[i], "words": numbers.harmonic(h.harmonics[i])} for i in rows],
        "products": [{"id": h.products[k], "words": numbers.product(h.products[k])} for k in products],
        "z": [[float(h.z[i, k]) for k in products] for i in rows],
        "level": h.level,
        "tried": int(np.sum(np.isfinite(h.z))),
    }


def draw_panel(s: State, a: Asked) -> bytes:
    """A panel of the reports as SVG: ``correlations``, ``compensated``, or of a flight ``whiteness`` or ``against:CHANNEL``."""
    kind, _, channel = a.what.partition(":")
    plot: Plot | None
    match kind:
        case "compensated":
            plot = panels.plot_compensated(s.require("compensated").series)
        case "correlations":
            plot = panels.correlate_parameters(View(s, a).f)[0]
        case "whiteness":
            v = View(s, a)
            plot = panels.plot_whiteness(v.f, v.n, v.residual)
        case "against":
            v = View(s, a)
            plot = panels.plot_against(v.f, v.n, v.residual, channel)
        case _:
            plot = None
    if plot is None:
        raise UserError("there is no such panel", found=repr(kind[:40]))
    return draw_file(plot).encode()
