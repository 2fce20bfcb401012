"""Effects of known strength: how large an effect must be to stand so many sigmas above a flight's noise.

The strength of an effect is the norm of its whitened signature once everything that the calibration can
absorb is projected out: the expected significance of the best test there is. It is measured on the
effect-free flight of the same seed. Effects that are no column of a fit:

- gain-step: the column of the scale factor, from a random instant on;
- spin-rate-jitter: the expected score, in sigmas, of the test of the variance;
- quantisation: the growth of the residual's variance by q^2/12, in sigmas of its estimate;
- saturation: the norm of the whitened and projected change of G_out, the limit found by bisection; but at least
  ten samples are clipped (a single one may stand ten sigmas high).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.evidence import sheet
from ragg_runtime.fit import columns as design
from ragg_runtime.fit import prepared_flight, unknown_gradient
from ragg_runtime.fit.columns import Column
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.reference.effects import CATALOGUE
from ragg_runtime.reference.simulate import Simulation
from ragg_runtime.signals.fir import filtered

Array = NDArray[np.float64]

LARGEST = 30.0
"""Plausible sizes beyond which an effect is not sane: it is untestable on the flight."""

LONGEST_LAG = 0.03
"""s: what the simulator's quadrature can do."""

DIRECTIONS = 6
"""Directions of an effect's parameters that are tried before it counts as untestable on a flight."""

CLIPPED = 10
"""Least number of samples that a hidden saturation clips."""

MOTION_RECORD = ("time-offset", "imu-lever-arm", "imu-misalignment", "gyro-scale")


@dataclass(frozen=True)
class Hidden:
    """An effect as it is hidden in a flight.

    Attributes
    ----------
    effect
        Id.
    values
        Parameters for the simulator, SI.
    plausible
        Largest parameter over its plausible size (NaN where that says nothing).
    strength
        Sigmas.
    signature
        (rows,) whitened and projected, of that norm; empty where the effect has none.
    instant
        Of a step, s.
    """

    effect: str
    values: Mapping[str, float | list[float]]
    plausible: float
    strength: float
    signature: Array = field(repr=False, default_factory=lambda: np.empty(0))
    instant: float | None = None

    def as_json(self) -> dict[str, object]:
        return {k: v for k, v in asdict(self).items() if k != "signature"}


class Bench:
    """The effect-free flight of a seed, fitted: what strengths are measured on."""

    def __init__(self, fitted: Fitted, simulation: Simulation) -> None:
        self.fitted = fitted
        self.simulation = simulation
        self.noise = fitted.prepared[0].noise
        (self.piece,) = fitted.prepared[0].each(lambda p: p)  # short flights are one piece
        self.columns = design.candidate_columns(fitted.model, fitted.instrument)
        self._base = self.basis(())

    def basis(self, given: Sequence[int]) -> Array:
        """(rows, k): orthonormal basis of base and ``given`` candidate columns."""
        f = self.fitted
        return prepared_flight.projector(f.triangles[0], f.n_base, given).basis(self.piece)

    def of(self, effect: str) -> list[int]:
        """Positions of an effect's columns among the candidates."""
        return [n for n, c in enumerate(self.columns) if c.effect == effect]

    def projected(self, columns: Array) -> Array:
        """Whitened columns (n, rows) less what the base absorbs."""
        return np.asarray(columns - (columns @ self._base) @ self._base.T)

    def whitened(self, series: Array) -> Array:
        """A change of G_out (N,) V as a row of the fit, base and unknown gradient projected out."""
        valid = self.piece.observation.record.valid
        row = filtered(np.where(valid, series, 0.0)[None], self.noise.filters[0])[:, valid]
        unknown_gradient.project(row, self.piece.windows)
        return self.projected(row)[0]

    def block(self, effect: str, instant: float | None = None) -> Array:
        """(n, rows): projected columns of an effect; of a step from its instant on."""
        at = self.of(effect)
        if instant is None:
            return self.projected(self.piece.white[[self.fitted.n_base + n for n in at]])
        on = self.piece.observation.record.time >= instant
        rows = self.piece.columns[self.fitted.n_base :, 0]
        return np.stack([self.whitened(np.where(on, rows[n], 0.0)) for n in at])


def drawn(
    bench: Bench, effect: str, strength: float, rng: np.random.Generator, beside: Array | None = None
) -> Hidden | None:
    """An effect of this strength in a random direction of its parameters; ``None`` if that is not sane.

    Several directions are tried. With ``beside`` (n, rows), projected columns of another effect, the strength
    is of what is left beside them.
    """
    candidate = next(e for e in bench.fitted.model.candidates if e.id == effect)
    kind = candidate.kind
    if effect == "imu-saturation":  # its samples are left out: it has no strength
        return None
    if candidate.told_from and sheet.doubtful(bench.fitted, effect):  # it is not offered
        return None
    if kind == "output":
        return _quantised(bench, strength) if effect == "quantisation" else _saturated(bench, strength)
    if kind == "random":
        return _jitter(bench, effect, strength)
    instant = None
    if kind == "step":
        duration = bench.piece.observation.record.time[-1]
        instant = float(duration * rng.uniform(0.15, 0.85))
    block = bench.block(effect, instant)
    whole = bench.piece.white[[bench.fitted.n_base + n for n in bench.of(effect)]]
    own = [bench.columns[n] for n in bench.of(effect)]
    for _ in range(DIRECTIONS):
        weights = _direction(effect, own, rng)
        signature = weights @ block
        norm = float(np.linalg.norm(signature if beside is None else _beside(signature, beside)))
        # a signature that is all but absorbed is rounding: its amplitude would be meaningless
        if norm <= 1e-5 * np.linalg.norm(weights @ whole):
            continue
        amplitude = strength / norm
        size = float(np.max(np.abs(amplitude * weights))) * design.EFFECT_PRIOR
        values = _values(effect, own, amplitude * weights)
        if size > LARGEST or (effect == "lag" and np.max(values["tau"]) > LONGEST_LAG):
            continue
        if instant is not None:
            values["t_step"] = instant
        return Hidden(effect, values, size, strength, amplitude * signature, instant)
    return None


def _beside(signature: Array, others: Array) -> Array:
    U, s, _ = np.linalg.svd(others.T, full_matrices=False)
    U = U[:, s > 1e-7 * s[0]]
    return np.asarray(signature - U @ (U.T @ signature))


def _direction(effect: str, own: Sequence[Column], rng: np.random.Generator) -> Array:
    """Unit vector over an effect's columns: one parameter, in one accelerometer or in all four."""
    names = list(dict.fromkeys(c.name for c in own))
    weights = np.zeros(len(own))
    if effect == "vibration-rectification":  # a covariance: of a vibration along one random line
        d = rng.standard_normal(3)
        d /= np.linalg.norm(d)
        for n, c in enumerate(own):
            weights[n] = d["xyz".index(c.name[-2])] * d["xyz".index(c.name[-1])]
        return weights
    name = names[int(rng.integers(len(names)))]
    at = [n for n, c in enumerate(own) if c.name == name]
    if len(at) > 1 and rng.random() < 0.5:
        at = [at[int(rng.integers(len(at)))]]
    drawn = rng.standard_normal(len(at))
    if effect in (
        "lag",
        "output-filter",
        "second-order-loop",
    ):  # what is no filter at all with the other sign
        drawn = np.abs(drawn)
    weights[at] = drawn / np.linalg.norm(drawn)
    return weights


def _values(effect: str, own: Sequence[Column], coefficients: Array) -> dict[str, float | list[float]]:
    values: dict[str, float | list[float]] = {}
    for c, x in zip(own, coefficients, strict=True):
        name = c.name.split(".", 1)[1]
        if name not in CATALOGUE[effect] or x == 0.0:
            continue
        if c.accelerometer is None:
            values[name] = float(x * c.scale)
        else:
            four = values.setdefault(name, [0.0] * 4)
            assert isinstance(four, list)
            four[c.accelerometer - 1] = float(x * c.scale)
    return values


def _jitter(bench: Bench, effect: str, strength: float) -> Hidden | None:
    at = bench.of(effect)[0]
    c = bench.columns[at]
    s2 = (bench.piece.white[bench.fitted.n_base + at] / c.scale) ** 2
    sigma = float(np.sqrt(strength * np.sqrt(2.0 / np.sum((s2 - np.mean(s2)) ** 2))))
    size = design.EFFECT_PRIOR * sigma / c.scale
    return None if size > LARGEST else Hidden(effect, {"sigma_phi": sigma}, size, strength)


def _quantised(bench: Bench, strength: float) -> Hidden:
    rows = bench.fitted.calibration.rows
    noise = bench.noise.models[0].rms
    q = float(noise * np.sqrt(12 * strength * np.sqrt(2 / rows)))
    return Hidden("quantisation", {"q": q}, float("nan"), strength)


def _saturated(bench: Bench, strength: float) -> Hidden:
    G = bench.simulation.G_out
    low, high = 0.0, float(np.sort(np.abs(G))[-CLIPPED])
    for _ in range(40):
        middle = (low + high) / 2
        change = float(np.linalg.norm(bench.whitened(np.clip(G, -middle, middle) - G)))
        low, high = (middle, high) if change > strength else (low, middle)
    limit = (low + high) / 2
    reached = float(np.linalg.norm(bench.whitened(np.clip(G, -limit, limit) - G)))
    return Hidden("saturation", {"V_max": limit}, float("nan"), reached)


def twins(bench: Bench, hidden: Hidden, chi2: float = 9.0) -> list[str]:
    """Effects that could explain a signature as well to within ``chi2``: no method could tell them apart."""
    if not hidden.signature.size:
        return []
    found = []
    for e in bench.fitted.model.candidates:
        if e.id == hidden.effect or e.kind not in ("deterministic", "step"):
            continue
        block = bench.block(e.id, hidden.instant if e.kind == "step" else None)
        if e.kind == "step" and hidden.instant is None:
            continue
        block = block[np.linalg.norm(block, axis=1) > 0.3]
        if len(block) and float(np.sum(_beside(hidden.signature, block) ** 2)) < chi2:
            found.append(e.id)
    return found
