"""How far a model is from a flight, and where it fails."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import calibrate, design
from ragg_runtime.calibrate import Calibration, Noise
from ragg_runtime.demodulate import low_pass
from ragg_runtime.design import Observation
from ragg_runtime.errors import UserError
from ragg_runtime.evaluate import record, scale_factor, vector, voltages
from ragg_runtime.evidence import likelihood, omnibus, search, special, work
from ragg_runtime.evidence.omnibus import Omnibus
from ragg_runtime.evidence.search import Field
from ragg_runtime.evidence.work import BLOCKS, Work
from ragg_runtime.flight import Flight
from ragg_runtime.flight.record import SI_UNITS
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Model
from ragg_runtime.metrics import Error, channels, error, pooled
from ragg_runtime.terms import Dictionary, harmonics
from ragg_runtime.threads import one_thread

Array = NDArray[np.float64]

FITTED_BLOCKS = tuple(b for b in range(BLOCKS) if (b // 4) % 2 == 0)
"""Blocks of time on which a held-out fit is made; the others, in turn with them, score it."""


@dataclass(frozen=True)
class Fitted:
    """A model fitted to flights, and everything that evidence is read from."""

    model: Model
    instrument: Instrument
    observations: tuple[Observation, ...]
    calibration: Calibration
    works: tuple[Work, ...]
    to_nominal: Array
    k_ggi: float

    @property
    def n_base(self) -> int:
        return len(self.calibration.columns)

    @cached_property
    def whole(self) -> Array:
        """Triangle of all flights, the prior in it."""
        return self._triangle(range(BLOCKS))

    @cached_property
    def half(self) -> Array:
        """The same over the blocks on which a held-out fit is made."""
        return self._triangle(FITTED_BLOCKS)

    def _triangle(self, blocks: Sequence[int]) -> Array:
        joined = np.vstack([w.triangles[b] for w in self.works for b in blocks])
        return likelihood.with_prior(joined, self.n_base, self.to_nominal)

    def field(self, available: Sequence[str]) -> Field:
        """The candidates among ``available`` effects, on the triangle of everything."""
        candidates = likelihood.grouped(design.candidate_columns(self.model, self.instrument))
        kept = {e: tuple(c) for e, c in candidates.items() if e in available}
        return Field(self.whole, self.n_base, kept, self.calibration.rows)

    def coefficients(self, extra: Sequence[int], *, held_out: bool = False) -> tuple[Array, Array]:
        """Fit of base and ``extra`` candidate columns, in scales, with its covariance, priors included.

        With ``held_out`` only the blocks of :data:`FITTED_BLOCKS` are fitted.
        """
        T = self.half if held_out else self.whole
        n = self.n_base
        picked = [*range(n), *(n + k for k in extra)]
        prior = np.zeros((len(extra), len(picked) + 1))
        prior[:, n:-1] = np.eye(len(extra))
        R = np.asarray(np.linalg.qr(np.vstack([T[:, [*picked, T.shape[1] - 1]], prior]), mode="r"))
        k = len(picked)
        inverse = np.linalg.inv(R[:k, :k])
        return inverse @ R[:k, k], inverse @ inverse.T

    def residuals(self, coefficients: Array, extra: Sequence[int]) -> list[Array]:
        """Residual of G_out, (N,) V, of every flight once these coefficients are in."""
        found = []
        n = self.n_base
        for w in self.works:
            e = w.lin.residual - np.tensordot(coefficients[:n], w.lin.base, 1)
            if len(extra):
                e = e - np.tensordot(coefficients[n:], w.lin.candidates[list(extra)], 1)
            found.append(as_output(w.observation, w.without_gradient(e)))
        return found

    def error(self, residuals: Sequence[Array], blocks: Sequence[int] | None = None) -> Error:
        """The error object over all flights, of some blocks of time or of all."""
        errors, weights = [], []
        for w, e in zip(self.works, residuals, strict=True):
            r = w.observation.record
            selected = r.valid
            if blocks is not None:
                inside = np.zeros(len(r.time), dtype=bool)
                for b in blocks:
                    inside[w.edges[b] : w.edges[b + 1]] = True
                selected = selected & inside
            errors.append(error(e, r, self.k_ggi, selected))
            weights.append(float(np.sum(selected)))
        return errors[0] if len(errors) == 1 else pooled(errors, weights)


def as_output(o: Observation, e: Array) -> Array:
    """G_out of what an observation holds: itself, or V_1 + V_2 - V_3 - V_4."""
    return design.combined(e) if o.kind == "voltages" else e[0]


def observe(flight: Flight, instrument: Instrument) -> Observation:
    """The most telling output of a flight: the four voltages if recorded, else G_out, else the channels."""
    r = record(flight, instrument)
    volts = [f"V_{j}" for j in (1, 2, 3, 4)]
    if all(v in flight.outputs for v in volts):
        data, kind = np.stack([flight.outputs[v] for v in volts]), "voltages"
    elif "G_out" in flight.outputs:
        data, kind = flight.outputs["G_out"][None, :], "G_out"
    else:
        a = instrument.accelerometers
        k_ggi = float(np.sum(a["k_VI"] * a["K1"] * (instrument.radius + a["dR"])))
        data = design.carried(flight.outputs["inline"], flight.outputs["cross"], r, k_ggi)[None, :]
        kind = "channels"
        edge = len(low_pass(r.rate)) // 2  # there our demodulator has not seen enough
        inside = np.zeros(len(r.time), dtype=bool)
        inside[edge : len(r.time) - edge] = True
        r = replace(r, valid=r.valid & inside)
    valid = r.valid & np.all(np.isfinite(data), axis=0)
    clipped = special.saturation(flight.outputs["G_out"], valid) if "G_out" in flight.outputs else None
    if clipped is not None:
        valid = valid & ~clipped[1]
    clean = {n: np.where(np.isfinite(x), x, 0.0) for n, x in r.channels.items()}
    r = replace(r, valid=valid, channels=clean)
    return Observation(kind, r, np.where(valid, data, 0.0), flight.name)


def fit(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    noise: Sequence[Noise] | None = None,
) -> Fitted:
    """Calibrate a model on flights and prepare the evidence; the noise is estimated unless given."""
    c = calibrate.fit(model, instrument, observations, noise=noise)
    if not scale_factor(model.chain, c.p) > 0.0:
        raise UserError(
            "the calibration does not converge: the record is not one of this instrument",
            where=", ".join(o.name for o in observations),
            found="a scale factor of the gradiometer below zero",
            expected="the disc angle, spin frequency, axes and signs of the model",
            remedy="check spin_frequency, spin_angle, the order of the axes, units and the sign of G_out",
        )
    works = work.prepare(model, instrument, observations, c)
    return Fitted(
        model,
        instrument,
        tuple(observations),
        c,
        tuple(works),
        work.to_nominal(model, instrument, c),
        scale_factor(model.chain, c.p),
    )


@dataclass(frozen=True)
class Remainder:
    """What is left of all flights: one search of the dictionary a flight."""

    searches: tuple[Omnibus, ...]

    @property
    def log_p(self) -> float:
        """Significance of the largest score of all flights."""
        return min(0.0, min(s.log_p for s in self.searches) + float(np.log(len(self.searches))))

    @property
    def significant(self) -> bool:
        return bool(self.log_p < np.log(omnibus.FAMILY))


def remainder(f: Fitted, given: Sequence[int] = ()) -> Remainder:
    """Search what is left once base and ``given`` candidate columns are projected out."""
    found = []
    for w in f.works:
        Q = w.projection(f.n_base, given)
        y = w.columns[-1] - Q @ (Q.T @ w.columns[-1])
        o = w.observation
        weights = np.array([0.25, 0.25, -0.25, -0.25]) if o.kind == "voltages" else np.ones(1)
        view = partial(design.narrow, r=o.record) if o.kind == "channels" else None
        dictionary = Dictionary(o.record)
        found.append(omnibus.search(dictionary, o.record.valid, w.noise, weights, Q, y, view))
    return Remainder(tuple(found))


@dataclass(frozen=True)
class Comparison:
    """The result of ``compare``: the interface's JSON, and series for the report."""

    fitted: Fitted
    nominal: Error
    calibrated: Error
    holdout: Error
    noise_floor: float
    adequate: bool
    remainder: Remainder
    residual_nominal: tuple[Array, ...]
    residual: tuple[Array, ...]

    def as_json(self) -> dict[str, object]:
        f = self.fitted
        records = [o.record for o in f.observations]
        return {
            "effects": [e.id for e in f.model.effects],
            "samples": int(sum(len(r.time) for r in records)),
            "duration_s": float(sum(r.time[-1] + 1 / r.rate for r in records)),
            "rate_Hz": float(records[0].rate),
            "error": {
                "nominal": self.nominal.as_json(),
                "calibrated": self.calibrated.as_json(),
                "holdout": self.holdout.as_json(),
            },
            "noise_floor": {"rms_Eo": self.noise_floor},
            "adequate": self.adequate,
            "where": {
                "harmonics": self.by_harmonic(),
                "time": self.by_time(),
                "motion": terms_json(self.remainder, self.residual, f),
            },
        }

    def by_harmonic(self) -> list[dict[str, object]]:
        """Slow error at every harmonic of the spin, Eo, largest first (see :func:`harmonic_errors`)."""
        return harmonic_errors(self.fitted, self.residual)

    def by_time(self) -> list[dict[str, object]]:
        """Error in every block of time, Eo, largest first."""
        rows: list[dict[str, object]] = []
        for w, e in zip(self.fitted.works, self.residual, strict=True):
            r = w.observation.record
            for b in range(BLOCKS):
                part = slice(w.edges[b], w.edges[b + 1])
                v = r.valid[part]
                if np.any(v):
                    rms = float(np.sqrt(np.mean(e[part][v] ** 2))) / self.fitted.k_ggi
                    rows.append(
                        {
                            "flight": w.observation.name,
                            "from_s": float(r.time[part][0]),
                            "to_s": float(r.time[part][-1]),
                            "rms_Eo": rms,
                            "over_noise": rms / self.noise_floor,
                        }
                    )
        return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


def harmonic_errors(f: Fitted, residuals: Sequence[Array]) -> list[dict[str, object]]:
    """Residual demodulated at const, cos k, sin k, as the demodulator would see it."""
    rows: list[dict[str, object]] = []
    total: dict[str, float] = {}
    for w, e in zip(f.works, residuals, strict=True):
        r = w.observation.record
        taps = low_pass(r.rate)
        if len(e) < 2 * len(taps):
            continue
        z = r.cos_phi + 1j * r.sin_phi
        for h in harmonics():
            k = 0 if h == "const" else int(h.split()[1])
            carrier = np.ones(len(e)) if k == 0 else (2 * (z**k).real if h[0] == "c" else 2 * (z**k).imag)
            low = np.convolve(np.where(r.valid, e, 0.0) * carrier, taps, mode="valid") / f.k_ggi
            total[h] = total.get(h, 0.0) + float(np.mean(low**2)) / len(f.works)
    power = sum(total.values())
    for h, p in total.items():
        rows.append({"harmonic": h, "rms_Eo": float(np.sqrt(p)), "share": p / power if power else 0.0})
    return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


def terms_json(rem: Remainder, residuals: Sequence[Array], f: Fitted) -> list[dict[str, object]]:
    """Generic terms in the residual, largest first; ``share`` is of the residual's power."""
    best: dict[tuple[str, str], dict[str, object]] = {}
    for w, s, e in zip(f.works, rem.searches, residuals, strict=True):
        d = Dictionary(w.observation.record)
        r = w.observation.record
        power = float(np.sum(e[r.valid] ** 2))
        for t in s.terms:
            x = t.coefficient * d.series(t.term)[r.valid]
            share = float(np.sum((x - np.mean(x) * (t.term.harmonic == "const")) ** 2)) / power
            key = (t.term.harmonic, t.term.product)
            row = {
                "harmonic": t.term.harmonic,
                "term": t.term.product,
                "coefficient": float(t.coefficient),
                "std": float(t.std),
                "unit": term_unit(t.term.channels),
                "share": min(1.0, share),
                "z": t.z,
            }
            if key not in best or abs(t.z) > abs(float(str(best[key]["z"]))):
                best[key] = row
    return sorted(best.values(), key=lambda x: -abs(float(str(x["z"]))))


_UNITS = {"a": "m/s^2", "omega": "rad/s", "omegadot": "rad/s^2", "d_a": "m/s^3", "time": "s"}


def term_unit(channels_: Sequence[str]) -> str:
    """Unit of a term's coefficient: V over the units of its channels."""
    units = [channel_unit(c) for c in channels_]
    return "V" if not units else f"V/({'*'.join(units)})"


def channel_unit(name: str) -> str:
    """SI unit of a channel."""
    stem = name.rsplit("_", 1)[0] if name[-2:] in ("_x", "_y", "_z") else name
    return _UNITS.get(stem) or SI_UNITS.get(name, "1")


@one_thread
def compare(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Comparison:
    """Nominal, calibrated and held-out errors of a model on flights, the noise, and where it fails."""
    observations = [observe(x, instrument) for x in flights]
    f = fit(model, instrument, observations)
    nominal = nominal_residuals(f, instrument)
    zero = np.zeros(f.n_base)
    residual = f.residuals(zero, ())
    half, _ = f.coefficients((), held_out=True)
    scored = [b for b in range(BLOCKS) if b not in FITTED_BLOCKS]
    rem = remainder(f)
    available = testable_effects(f)
    field = f.field(available)
    choice = search.choose(field) if available else None
    adequate = not rem.significant and not (choice and choice.chosen)
    return Comparison(
        f,
        f.error(nominal),
        f.error(residual),
        f.error(f.residuals(half, ()), scored),
        noise_floor(f),
        adequate,
        rem,
        tuple(nominal),
        tuple(residual),
    )


def nominal_residuals(f: Fitted, instrument: Instrument) -> list[Array]:
    """Residual of G_out, (N,) V, of every flight with the instrument's values as they are."""
    p = vector(f.model, instrument)
    found = []
    for o in f.observations:
        v = voltages(f.model.chain, o.record, p)
        predicted = design.observe(o, v, None)
        found.append(as_output(o, np.where(o.record.valid, o.data - predicted, 0.0)))
    return found


def noise_floor(f: Fitted) -> float:
    """rms of the estimated noise of G_out before demodulation, Eo."""
    variances = []
    for w in f.works:
        share = design.noise_gain(w.observation.record.rate) if w.observation.kind == "channels" else 1.0
        variances.append(share * sum(m.rms**2 for m in w.noise.models))
    return float(np.sqrt(np.mean(variances))) / f.k_ggi


def testable_effects(f: Fitted) -> list[str]:
    """Deterministic candidates of which every flight has the channels."""
    have = [set(o.record.channels) for o in f.observations]
    return [
        e.id
        for e in f.model.candidates
        if e.kind == "deterministic" and all(c in h for c in e.channels for h in have)
    ]


def demodulated(f: Fitted, residuals: Sequence[Array]) -> list[tuple[Array, Array, Array]]:
    """(time, inline, cross) of every flight's residual, s and Eo."""
    return [
        channels(e, w.observation.record, f.k_ggi, w.observation.record.valid)
        for w, e in zip(f.works, residuals, strict=True)
    ]
