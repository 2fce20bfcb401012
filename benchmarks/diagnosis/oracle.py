"""How large an effect must be to stand so many sigmas above a flight's noise, for one who knows that noise.

The strength of an effect is the norm of its signature, whitened with the noise as it is, once everything is projected out that
a calibration could take for it: the parameters of the instrument within what a sheet leaves open, an unknown gradient, and a
second effect with all of its parameters. It is the expected significance of the best test there is. Signatures are the
derivatives of the generated model at the true instrument. No column has: ``spin-rate-jitter`` (the expected score of the test
of its variance), ``quantisation`` (the growth of the variance by q^2/12, in sigmas of its estimate) and ``saturation`` (the
norm of what is clipped, at least ten samples).

``weigh`` says what could be found at most: an oracle that knows noise and true instrument tests the effect that is hidden, and no other.
Its test is that of the diagnosis, with the same columns and the same sheet (``likelihood_ratio.test``), at the level of the catalogue over
the number of independent tests; of a step it knows the instant. Of effects without columns it has the scores of above.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, signal, special
from scipy.interpolate import BSpline

from benchmarks.diagnosis.plan import World
from benchmarks.diagnosis.records import Loudness, Table
from ragg_runtime.base import false_alarms
from ragg_runtime.estimation import likelihood_ratio
from ragg_runtime.estimation import regressors as design
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.observation import BLOCKS, observe
from ragg_runtime.estimation.regressors import Column, linearise, make_point
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.io import Flight
from ragg_runtime.model.model import load_packaged, make_vector
from ragg_runtime.reference.effects import CATALOGUE

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Plausible sizes beyond which an effect is not hidden: up to 10 sigma, and above
LARGEST, LARGEST_STRONG = 30.0, 1000.0
# s: what the simulator can do, and a Taylor series describes
LONGEST: Mapping[str, float] = {"lag": 0.03, "gyro-delay": 0.1, "imu-skew": 0.1, "time-offset": 0.1}
NEVER = ("arm-length", "disc-spin", "imu-saturation", "second-order-misalignment")
"""Effects that are not hidden: nature knows them at one size alone, or a sheet as sure as these does not offer them."""

FILTERS = ("imu-filter", "lag", "output-filter", "second-order-loop")  # no filter at all with the other sign
# Of a vibration along one line
COVARIANCES = ("angular-jitter", "vibration-level", "vibration-rectification")
DIRECTIONS = 6  # directions of an effect's parameters that are tried before another effect takes its place
CLIPPED = 10  # least number of samples that a hidden saturation clips
KNOT = 10.0  # s: between the knots of an unknown gradient


@dataclass(frozen=True)
class Hidden:
    """An effect as it is hidden: its parameters for the simulator, SI, the largest over its plausible size, and sigmas."""

    effect: str
    values: Mapping[str, float | list[float]]
    plausible: float
    strength: float


class Oracle:
    """A flight without effects, whitened with the noise as it is: what strengths are measured on."""

    def __init__(
        self,
        w: World,
        flight: Flight,
        noise_rms: Loudness,
        lost: Mask | None = None,
        catalogue: Container[str] | None = None,
    ) -> None:
        """``lost``: samples whose output is missing; ``catalogue``: the effects that there are (``None``: all)."""
        self.model, self.flight = load_packaged(), flight
        effects = [e for e in self.model.candidates if catalogue is None or e.id in catalogue]
        self.o = observe(flight, w.known)
        self.valid = self.o.record.valid if lost is None else self.o.record.valid & ~lost
        i = w.known.accelerometers
        scale = (i["k_VI"] * i["K1"])[:, None]
        of_each = np.broadcast_to(scale * noise_rms.level, (4, len(flight))) ** 2
        variance = of_each if w.output == "voltages" else np.sum(of_each, axis=0, keepdims=True)
        self.rms = np.sqrt(w.density * flight.rate / 2 * variance)
        self.taps = whitening(noise_rms, flight.rate, len(flight))
        p = make_vector(self.model, w.known)
        columns, ids = design.list_candidate_columns(self.model, w.known), {e.id for e in effects}
        self.columns = [c for c in columns if c.effect in ids]
        self.raw = linearise(make_point(self.model, w.known, p, self.columns), self.o)[:-1]
        self.n = len(self.raw) - len(self.columns)
        white = self.whitened(self.raw)
        self.rows = white.shape[1]
        base = [np.hstack([white[: self.n], np.eye(self.n)])]
        if not w.gradient:
            unknown = self.whitened(self._gradient())
            base.append(np.pad(unknown, ((0, 0), (0, self.n))))
        self.Q = _basis(np.concatenate(base), 1e-10)
        self.white = white[self.n :]
        self.left = self.projected(self.white)
        self.kinds = {e.id: e.kind for e in effects if e.id not in NEVER}

    def whitened(self, x: Array) -> Array:
        """(k, rows) of columns (k, m, N), V."""
        y = signal.lfilter(self.taps, [1.0], x / self.rms, axis=-1)
        return np.asarray(y[:, :, self.valid].reshape(len(x), -1))

    def projected(self, rows: Array) -> Array:
        """(k, rows + n): whitened rows less what the calibration takes for them."""
        wide = np.pad(rows, ((0, 0), (0, self.n)))
        return np.asarray(wide - (wide @ self.Q) @ self.Q.T)

    def of(self, effect: str) -> list[int]:
        return [n for n, c in enumerate(self.columns) if c.effect == effect]

    def block(self, effect: str, instant: float | None = None) -> Array:
        """Projected columns of an effect; of a step from its instant on."""
        if self.kinds[effect] != "step" or instant is None:
            return self.left[self.of(effect)]
        on = self.flight.time >= instant
        return self.projected(self.whitened(self.raw[self.n :][self.of(effect)] * on))

    def _gradient(self) -> Array:
        t, r = self.flight.time, self.o.record
        inner = np.linspace(t[0], t[-1], max(2, int((t[-1] - t[0]) / KNOT) + 1))
        steps = (inner[1] - inner[0]) * np.arange(1.0, 4.0)
        knots = np.concatenate([t[0] - steps[::-1], inner, t[-1] + steps])
        splines = BSpline.design_matrix(t, knots, 3).toarray().T
        sin2, cos2 = 2 * r.sin_phi * r.cos_phi, r.cos_phi**2 - r.sin_phi**2
        signs = np.ones(1) if len(self.rms) == 1 else np.array(self.o.output.signs)
        turned = np.concatenate([splines * sin2, splines * cos2])[:, None] * signs[:, None]
        return np.asarray(turned * np.mean(self.rms))

    def drawn(
        self, effect: str, strength: float, rng: np.random.Generator, beside: Array | None = None
    ) -> Hidden | None:
        """An effect of this strength in a random direction of its parameters; ``None`` if that is not sane on this flight."""
        kind, at = self.kinds[effect], self.of(effect)
        if kind == "output" and len(self.rms) > 1:
            return None
        if kind == "output":
            return self._quantised(strength) if effect == "quantisation" else self._saturated(strength)
        if kind == "random":
            return self._jitter(effect, strength)
        time = self.flight.time
        instant = float(time[0] + (time[-1] - time[0]) * rng.uniform(0.15, 0.85)) if kind == "step" else None
        block, columns = self.block(effect, instant), [self.columns[n] for n in at]
        for _ in range(DIRECTIONS if at else 0):  # it may have no column beside an unknown gradient
            weights = _direction(effect, columns, rng)
            signature = weights @ block
            norm = float(np.linalg.norm(signature if beside is None else _beside(signature, beside)))
            # what is all but absorbed is rounding: its size would mean nothing
            if norm <= 1e-5 * np.linalg.norm(weights @ self.white[at]):
                continue
            values = _values(effect, columns, strength / norm * weights)
            size = float(np.max(np.abs(weights))) * strength / norm * design.EFFECT_PRIOR
            largest = LARGEST if strength <= 10.0 else LARGEST_STRONG
            most = max(float(np.max(np.abs(v))) for v in values.values())
            if size <= largest and most <= LONGEST.get(effect, np.inf):
                return Hidden(
                    effect, values | ({} if instant is None else {"t_step": instant}), size, strength
                )
        return None

    def row(self, change: Array) -> Array:
        """A change (N,) of the output, of the first voltage where these are recorded, projected."""
        series = np.zeros((1, len(self.rms), len(change)))
        series[0, 0] = change
        return np.asarray(self.projected(self.whitened(series))[0])

    def beyond_all(self, change: Array) -> float:
        """Norm of such a change beyond the calibration and all effects together."""
        return float(np.linalg.norm(_beside(self.row(change), self.left)))

    def _jitter(self, effect: str, strength: float) -> Hidden | None:
        at = self.of(effect)[0]
        c = self.columns[at]
        s2 = (self.white[at] / c.scale) ** 2
        sigma = float(np.sqrt(strength * np.sqrt(2.0 / np.sum((s2 - np.mean(s2)) ** 2))))
        size = design.EFFECT_PRIOR * sigma / c.scale
        return None if size > LARGEST else Hidden(effect, {"sigma_phi": sigma}, size, strength)

    def _quantised(self, strength: float) -> Hidden:
        rms = float(np.sqrt(np.mean(self.rms**2)))
        q = float(rms * np.sqrt(12 * strength * np.sqrt(2 / self.rows)))
        return Hidden("quantisation", {"q": q}, float("nan"), strength)

    def _saturated(self, strength: float) -> Hidden:
        G = self.flight.outputs["G_out"]
        low, high = 0.0, float(np.sort(np.abs(G))[-CLIPPED])

        def seen(limit: float) -> float:
            return float(np.linalg.norm(self.row(np.clip(G, -limit, limit) - G)))

        for _ in range(30):
            middle = (low + high) / 2
            low, high = (middle, high) if seen(middle) > strength else (low, middle)
        return Hidden("saturation", {"V_max": high}, float("nan"), seen(high))


def whitening(noise_rms: Loudness, rate: float, size: int) -> Array:
    """Taps of the causal filter that makes stationary noise white: the minimum phase of one over the root of its spectrum."""
    n = 1 << int(np.ceil(np.log2(4 * size)))
    f = np.fft.rfftfreq(n, 1 / rate)
    f[0] = rate / (2 * size)
    log = -0.5 * np.log(noise_rms.psd(np.maximum(f, rate / (2 * size))))
    if not np.any(log):
        return np.ones(1)
    cepstrum = np.fft.irfft(log, n)
    cepstrum[1 : n // 2] *= 2.0
    cepstrum[n // 2 + 1 :] = 0.0
    return np.asarray(np.fft.irfft(np.exp(np.fft.rfft(cepstrum)), n)[: min(size, 4096)])


def _basis(rows: Array, rounding: float) -> Array:
    """(n, k): an orthonormal basis of rows (k, n), those that are zero aside."""
    sizes = np.linalg.norm(rows, axis=1)
    return np.asarray(linalg.orth((rows[sizes > 0.0] / sizes[sizes > 0.0, None]).T, rounding))


def _beside(signature: Array, others: Array) -> Array:
    U = _basis(others, 1e-7)
    return np.asarray(signature - U @ (U.T @ signature))


def _direction(effect: str, columns: Sequence[Column], rng: np.random.Generator) -> Array:
    """Unit vector over an effect's columns: one parameter, in one accelerometer or in all four."""
    weights = np.zeros(len(columns))
    if effect in COVARIANCES:
        d = rng.standard_normal(3)
        d /= np.linalg.norm(d)
        for n, c in enumerate(columns):
            weights[n] = d["xyz".index(c.name[-2])] * d["xyz".index(c.name[-1])]
        return weights
    names = list(dict.fromkeys(c.name for c in columns))
    name = names[int(rng.integers(len(names)))]
    at = [n for n, c in enumerate(columns) if c.name == name]
    if len(at) > 1 and rng.random() < 0.5:
        at = [at[int(rng.integers(len(at)))]]
    drawn = rng.standard_normal(len(at))
    weights[at] = np.abs(drawn) if effect in FILTERS else drawn
    return weights / float(np.linalg.norm(weights))


def _values(effect: str, columns: Sequence[Column], coefficients: Array) -> dict[str, float | list[float]]:
    """Parameters for the simulator, SI: one, or one of each accelerometer."""
    values: dict[str, Any] = {}
    for c, x in zip(columns, coefficients * [c.scale for c in columns], strict=True):
        name = c.name.split(".", 1)[1]
        if name not in CATALOGUE[effect] or x == 0.0:
            continue
        if c.accelerometer is None:
            values[name] = float(x)
        else:
            values.setdefault(name, [0.0] * 4)[c.accelerometer - 1] = float(x)
    return values


# --- the ceiling -----------------------------------------------------------------------------------------


def weigh(o: Oracle, w: World, table: Table, h: Hidden) -> dict[str, Any]:
    """The oracle's p-value of what is hidden in a flight, by itself and over the catalogue."""
    left = _left(o, w, table)
    log_p = _log_p(o, h, left) / np.log(10.0)
    over = log_p + np.log10(_field(o, left).effective_count)
    return {
        "hidden": h.effect,
        "log10_p": round(log_p, 2),
        "over_catalogue": round(over, 2),
        "alone": int(log_p < np.log10(false_alarms.PROMISED)),
        "found": int(over < np.log10(false_alarms.CATALOGUE)),
    }


def _left(o: Oracle, w: World, table: Table) -> Array:
    """(rows + n,): the whitened record and the sheet, less what the true instrument makes of the recorded motion, projected."""
    outputs = {n: np.nan_to_num(table[n]) for n in o.flight.outputs}
    x = observe(
        replace(o.flight, channels={n: table[n] for n in o.flight.channels}, outputs=outputs), w.known
    )
    true = make_vector(o.model, w.known)
    rest = np.stack(x.series) - design.predict_observed(o.model, x, true)
    base = design.list_base_columns(o.model, w.known)
    sheet = [(make_vector(o.model, w.scenario.sheet)[k] - true[k]) / c.scale for c, k in base]
    y = np.concatenate([o.whitened(np.where(o.valid, rest, 0.0)[None])[0], sheet])
    return np.asarray(y - o.Q @ (o.Q.T @ y))


def _log_p(o: Oracle, h: Hidden, left: Array) -> float:
    """Logarithm of the p-value of an effect's own test."""
    at, data = o.of(h.effect), left[: o.rows]
    if o.kinds[h.effect] == "random":
        shape = o.white[at[0]] ** 2
        return _normal((shape - np.mean(shape)) @ data**2 / np.sqrt(2.0 * len(data)) / np.std(shape))
    if h.effect == "quantisation":
        return _normal(np.sum(data**2 - 1.0) / np.sqrt(2.0 * len(data)))
    if h.effect == "saturation":
        G, most = o.flight.outputs["G_out"], h.values["V_max"]
        clipped = o.row(np.clip(G, -most, most) - G)
        return _normal(clipped @ left / np.linalg.norm(clipped))
    block = o.block(h.effect, h.values.get("t_step"))  # type: ignore[arg-type]
    P = compute_r_factor(np.concatenate([block, left[None]]))
    columns = [(n, o.columns[k]) for n, k in enumerate(at)]
    charge = float(np.log(2 * BLOCKS)) if o.kinds[h.effect] == "step" else 0.0
    return likelihood_ratio.test(P, columns, np.full(len(P), likelihood_ratio.TESTABLE), charge).log_p


def _normal(z: float | np.floating[Any]) -> float:
    return float(special.log_ndtr(-z))


def _field(o: Oracle, left: Array) -> ProjectedProblem:
    """All effects with columns; steps from the middle on."""
    middle = float(np.mean(o.flight.time[[0, -1]]))
    ids = [e for e, kind in o.kinds.items() if kind in ("deterministic", "step")]
    T = compute_r_factor(np.concatenate([*(o.block(e, middle) for e in ids), left[None]]))
    columns = iter(enumerate(o.columns[k] for e in ids for k in o.of(e)))
    candidates = {e: tuple(next(columns) for _ in o.of(e)) for e in ids}
    return ProjectedProblem(T=T, n_base=0, candidates=candidates)
