"""How far a model is from a flight, and where it fails."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray
from scipy.signal import oaconvolve

from ragg_runtime import calibrate, design, display, ingredients
from ragg_runtime.calibrate import Calibration
from ragg_runtime.demodulate import low_pass
from ragg_runtime.design import Observation
from ragg_runtime.errors import UserError
from ragg_runtime.evaluate import record, scale_factor, vector, voltages
from ragg_runtime.evidence import likelihood, omnibus, search, special, work
from ragg_runtime.evidence.omnibus import Omnibus
from ragg_runtime.evidence.search import Field
from ragg_runtime.evidence.work import Flown
from ragg_runtime.flight import Flight
from ragg_runtime.flight.record import SI_UNITS
from ragg_runtime.flight.spool import let_go
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Model
from ragg_runtime.metrics import Error, Stretch, Tally, channels, pooled
from ragg_runtime.passes import Noise, Piece, as_output
from ragg_runtime.segments import BLOCKS, ROWS
from ragg_runtime.terms import carrier, harmonics
from ragg_runtime.threads import one_thread

Array = NDArray[np.float64]

FITTED_BLOCKS = tuple(b for b in range(BLOCKS) if (b // 4) % 2 == 0)
"""Blocks of time on which a held-out fit is made; the others, in turn with them, score it."""


@dataclass(frozen=True)
class Scored:
    """How large one residual is.

    Attributes
    ----------
    whole, held_out
        The error object over everything, and over the blocks of time that a held-out fit does not see.
    mean_square
        Of each flight, V^2.
    blocks
        (flights, BLOCKS): rms in each block of time, V; NaN where it has no valid sample.
    """

    whole: Error
    held_out: Error
    mean_square: tuple[float, ...]
    blocks: Array


@dataclass(frozen=True)
class _Counted:
    """Of one segment: its tally, and sums in the blocks of time."""

    tally: Tally
    squares: Array
    samples: Array


def _left(v: Array, piece: Piece) -> Array:
    return np.asarray(piece.left(v)[0])


def _counted(piece: Piece, V: Array, further: Callable[[Piece], Array] | None) -> _Counted:
    r = piece.observation.record
    e = piece.left(V)
    if further is not None:
        e = np.concatenate([e, further(piece)])
    squares, samples = np.zeros((BLOCKS, len(e))), np.zeros(BLOCKS)
    scored = np.zeros(len(r.time), dtype=np.bool_)
    for b, rows in piece.segment.blocks:
        here = slice(rows.start - piece.segment.rows.start, rows.stop - piece.segment.rows.start)
        scored[here] = b not in FITTED_BLOCKS
        v = r.valid[here]
        squares[b] = np.sum(e[:, here][:, v] ** 2, axis=1)
        samples[b] = np.sum(v)
    selected = np.stack([np.ones(len(scored), dtype=np.bool_), scored])
    return _Counted(Tally.of(Stretch(e, r.phi, selected, r.valid), r.rate), squares, samples)


@dataclass(frozen=True)
class Fitted:
    """A model fitted to flights, and everything that evidence is read from.

    ``triangles`` holds for every flight the triangle of its whitened columns [base | candidates | residual]
    in each block of time; all tests are made on them alone. ``sums`` (BLOCKS, size + 1) are those of the plain columns.
    """

    model: Model
    instrument: Instrument
    observations: tuple[Observation, ...]
    calibration: Calibration
    flown: tuple[Flown, ...]
    triangles: tuple[tuple[Array, ...], ...]
    sums: tuple[Array, ...]
    to_nominal: Array
    k_ggi: float

    @property
    def n_base(self) -> int:
        return len(self.calibration.columns)

    @property
    def size(self) -> int:
        """Number of columns, base and candidates."""
        return int(self.triangles[0][0].shape[1]) - 1

    @cached_property
    def whole(self) -> Array:
        """Triangle of all flights, the prior in it."""
        return self._triangle(range(BLOCKS))

    @cached_property
    def half(self) -> Array:
        """The same over the blocks on which a held-out fit is made."""
        return self._triangle(FITTED_BLOCKS)

    def _triangle(self, blocks: Sequence[int]) -> Array:
        joined = np.vstack([t[b] for t in self.triangles for b in blocks])
        return likelihood.with_prior(joined, self.n_base, self.to_nominal)

    def field(self, available: Sequence[str]) -> Field:
        """The candidates among ``available`` effects, on the triangle of everything."""
        candidates = likelihood.grouped(design.candidate_columns(self.model, self.instrument))
        kept = {e: tuple(c) for e, c in candidates.items() if e in available}
        return Field(self.whole, self.n_base, kept, self.calibration.rows)

    def coefficients(self, extra: Sequence[int], *, held_out: bool = False) -> tuple[Array, Array]:
        """Fit of base and ``extra`` candidate columns, in scales, with its covariance, priors included.

        With ``held_out`` only the blocks of :data:`FITTED_BLOCKS` are fitted. The null biases take the residual's mean.
        """
        T = self.half if held_out else self.whole
        n = self.n_base
        picked = [*range(n), *(n + k for k in extra)]
        prior = np.zeros((len(extra), len(picked) + 1))
        prior[:, n:-1] = np.eye(len(extra))
        R = np.asarray(np.linalg.qr(np.vstack([T[:, [*picked, T.shape[1] - 1]], prior]), mode="r"))
        k = len(picked)
        inverse = np.linalg.inv(R[:k, :k])
        blocks = list(FITTED_BLOCKS if held_out else range(BLOCKS))
        sums = np.sum([x[blocks] for x in self.sums], axis=(0, 1))[[*picked, -1]]
        biases = design.null_biases(self.calibration.columns)
        return design.levelled(inverse @ R[:k, k], sums, biases), inverse @ inverse.T

    def vector(self, coefficients: Array, extra: Sequence[int] = ()) -> Array:
        """(size,): coefficients of base and ``extra`` candidates among those of all columns."""
        v = np.zeros(self.size)
        v[: self.n_base] = coefficients[: self.n_base]
        v[[self.n_base + k for k in extra]] = coefficients[self.n_base :]
        return v

    def residuals(self, coefficients: Array, extra: Sequence[int] = ()) -> list[Array]:
        """Residual of G_out, (N,) V, of every flight once these coefficients are in."""
        return self.residuals_of(self.vector(coefficients, extra))

    def residuals_of(self, v: Array) -> list[Array]:
        """The same with the coefficients of all columns, (size,)."""
        found = []
        for x in self.flown:
            lean, w = x.for_residuals(v[None], self.n_base)
            parts = lean.each(partial(_left, w), whitened=False)
            found.append(np.concatenate([*parts]))
        return found

    def score(
        self, vectors: Sequence[Array], further: Callable[[Piece], Array] | None = None, count: int = 0
    ) -> list[Scored]:
        """How large the residuals are with these coefficients (size,), in one pass over the flights.

        ``further`` yields ``count`` more residuals (count, N), V, of a piece.
        """
        V = np.stack(vectors) if vectors else np.empty((0, self.size))
        k = len(V) + count
        tallies, blocks = [], np.full((len(self.flown), BLOCKS, k), np.nan)
        for n, x in enumerate(self.flown):
            tally = Tally(k, 2, x.observation.record.rate)
            squares, samples = np.zeros((BLOCKS, k)), np.zeros(BLOCKS)
            lean, W = x.for_residuals(V, self.n_base)

            def counted(piece: Piece, W: Array = W) -> _Counted:
                return _counted(piece, W, further)

            for part in lean.each(counted, whitened=False):
                squares += part.squares
                samples += part.samples
                tally.join(part.tally)
            tallies.append(tally)
            some = samples > 0
            blocks[n, some] = np.sqrt(squares[some] / samples[some, None])
        return [
            Scored(
                self._pooled(tallies, j, 0),
                self._pooled(tallies, j, 1),
                tuple(float(t.squares[0, j] / t.samples[0]) for t in tallies),
                blocks[:, :, j],
            )
            for j in range(k)
        ]

    def _pooled(self, tallies: Sequence[Tally], series: int, group: int) -> Error:
        errors = [t.error(series, self.k_ggi, group) for t in tallies]
        if len(errors) == 1:
            return errors[0]
        return pooled(errors, [float(t.samples[group]) for t in tallies])

    def released(self) -> Fitted:
        """The same without the columns of its flights in memory."""
        return replace(self, flown=tuple(x.released() for x in self.flown))


def observe(flight: Flight, instrument: Instrument) -> Observation:
    """The most telling output of a flight: the four voltages if recorded, else G_out, else the channels."""
    r = record(flight, instrument)
    volts = [f"V_{j}" for j in (1, 2, 3, 4)]
    if all(v in flight.outputs for v in volts):
        series, kind = tuple(flight.outputs[v] for v in volts), "voltages"
    elif "G_out" in flight.outputs:
        series, kind = (flight.outputs["G_out"],), "G_out"
    else:
        a = instrument.accelerometers
        k_ggi = float(np.sum(a["k_VI"] * a["K1"] * (instrument.radius + a["dR"])))
        series = (design.carried(flight.outputs["inline"], flight.outputs["cross"], r, k_ggi),)
        kind = "channels"
        edge = len(low_pass(r.rate)) // 2  # there our demodulator has not seen enough
        inside = np.zeros(len(r.time), dtype=bool)
        inside[edge : len(r.time) - edge] = True
        r = replace(r, valid=r.valid & inside)
    valid = np.array(r.valid)
    for x in series:
        valid &= np.isfinite(x)
    clipped = special.saturation(flight.outputs["G_out"], valid) if "G_out" in flight.outputs else None
    if clipped is not None:
        valid &= ~clipped[1]
    let_go(*flight.outputs.values())
    wide = r.wide
    if len(r.time) <= ROWS:  # longer ones are cleaned part by part
        wide = {n: np.where(np.isfinite(x), x, 0.0) for n, x in r.wide.items()}
    return Observation(kind, replace(r, valid=valid, wide=wide), series, flight.name)


@one_thread
def fit(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    noise: Sequence[Noise] | None = None,
    start: Array | None = None,
) -> Fitted:
    """Calibrate a model on flights and prepare the evidence.

    The noise is estimated unless given; the fit begins at the nominal values unless a parameter vector is given.
    """
    model = model.for_fits(sum(len(o.record.time) for o in observations))
    c = calibrate.fit(model, instrument, observations, noise=noise, start=start)
    if not scale_factor(model.chain, c.p) > 0.0:
        raise UserError(
            "the calibration does not converge: the record is not one of this instrument",
            where=", ".join(o.name for o in observations),
            found="a scale factor of the gradiometer below zero",
            expected="the disc angle, spin frequency, axes and signs of the model",
            remedy="check spin_frequency, spin_angle, the order of the axes, units and the sign of G_out",
        )
    return about(model, instrument, observations, c)


@one_thread
def about(
    model: Model, instrument: Instrument, observations: Sequence[Observation], c: Calibration
) -> Fitted:
    """The evidence about a calibration, however it was found."""
    flown = work.prepare(model, instrument, observations, c)
    triangles, sums = zip(*(work.blocks(x) for x in flown), strict=True)
    return Fitted(
        model,
        instrument,
        tuple(observations),
        c,
        flown,
        triangles,
        sums,
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
    for x, triangles in zip(f.flown, f.triangles, strict=True):
        projector = work.projector(triangles, f.n_base, given)
        found.append(omnibus.search(x, projector, lambda piece, y: None)[0])
    return Remainder(tuple(found))


@dataclass(frozen=True)
class Comparison:
    """The result of ``compare``: the interface's JSON, and what the report draws."""

    fitted: Fitted
    nominal: Error
    scored: Scored
    holdout: Error
    noise_floor: float
    adequate: bool
    remainder: Remainder
    nominal_values: Array

    @property
    def calibrated(self) -> Error:
        return self.scored.whole

    @cached_property
    def residual(self) -> list[Array]:
        """(N,) V of every flight, calibrated."""
        return self.fitted.residuals(np.zeros(self.fitted.n_base))

    @cached_property
    def residual_nominal(self) -> list[Array]:
        """(N,) V of every flight, with the values as they were given."""
        f = self.fitted
        return [
            np.concatenate([*lean.each(partial(nominal_residual, f, self.nominal_values), whitened=False)])
            for lean, _ in (x.for_residuals(np.zeros((1, f.size)), f.n_base) for x in f.flown)
        ]

    def with_nominal(self, instrument: Instrument) -> Comparison:
        """The same, ``nominal`` being these values."""
        p = vector(self.fitted.model, instrument)
        (scored,) = self.fitted.score((), lambda x: nominal_residual(self.fitted, p, x)[None], 1)
        return replace(self, nominal=scored.whole, nominal_values=p)

    def _repr_html_(self) -> str:
        return display.comparison(self.as_json(), [o.name for o in self.fitted.observations])

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
                "harmonics": self.harmonics,
                "time": self.by_time(),
                "motion": self.terms(),
            },
        }

    @cached_property
    def harmonics(self) -> list[dict[str, object]]:
        """Slow error at every harmonic of the spin, Eo, largest first (see :func:`harmonic_errors`)."""
        return harmonic_errors(self.fitted, self.fitted.vector(np.zeros(self.fitted.n_base)))

    def terms(self) -> list[dict[str, object]]:
        """Generic terms in the calibrated residual (see :func:`terms_json`)."""
        return terms_json(self.remainder, self.scored.mean_square)

    def by_time(self) -> list[dict[str, object]]:
        """Error in every block of time, Eo, largest first."""
        rows: list[dict[str, object]] = []
        for x, blocks in zip(self.fitted.flown, self.scored.blocks, strict=True):
            time = x.observation.record.time
            for b, volts in enumerate(blocks):
                if np.isfinite(volts):
                    rms = float(volts) / self.fitted.k_ggi
                    rows.append(
                        {
                            "flight": x.observation.name,
                            "from_s": float(time[x.edges[b]]),
                            "to_s": float(time[x.edges[b + 1] - 1]),
                            "rms_Eo": rms,
                            "over_noise": rms / self.noise_floor,
                        }
                    )
        return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


def harmonic_errors(f: Fitted, coefficients: Array) -> list[dict[str, object]]:
    """Residual demodulated at const, cos k, sin k, as the demodulator would see it, largest first."""
    total = dict.fromkeys(harmonics(), 0.0)
    counted = 0
    for x in f.flown:
        rate = x.observation.record.rate
        taps = low_pass(rate)
        if len(x.observation.record.time) < 2 * len(taps):
            continue
        counted += 1
        squares, samples = dict.fromkeys(total, 0.0), 0
        lean, v = x.for_residuals(coefficients[None], f.n_base)
        tail = np.empty((len(total), 0))

        def mix(piece: Piece, v: Array = v) -> Array:
            r = piece.observation.record
            e = np.where(r.valid, piece.left(v)[0], 0.0) / f.k_ggi
            return np.stack([e * carrier(r, h) * (1 if h == "const" else 2) for h in total])

        for mixed in lean.each(mix, whitened=False):
            mixed = np.concatenate([tail, mixed], axis=1)
            if mixed.shape[1] >= len(taps):
                low = oaconvolve(mixed, taps[None], mode="valid", axes=1)
                samples += low.shape[1]
                for h, y in zip(total, low, strict=True):
                    squares[h] += float(y @ y)
            tail = mixed[:, -len(taps) + 1 :]
        for h in total:
            total[h] += squares[h] / samples
    power = sum(total.values())
    if not counted:
        return []
    rows: list[dict[str, object]] = [
        {"harmonic": h, "rms_Eo": float(np.sqrt(p / counted)), "share": p / power if power else 0.0}
        for h, p in total.items()
    ]
    return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


def terms_json(rem: Remainder, mean_squares: Sequence[float]) -> list[dict[str, object]]:
    """Generic terms in residuals of these mean squares, V^2, largest first; ``share`` is of the power."""
    best: dict[tuple[str, str], dict[str, object]] = {}
    for s, power in zip(rem.searches, mean_squares, strict=True):
        for t in s.terms:
            key = (t.term.harmonic, t.term.product)
            row = {
                "harmonic": t.term.harmonic,
                "term": t.term.product,
                "coefficient": float(t.coefficient),
                "std": float(t.std),
                "unit": term_unit(t.term.channels),
                "share": min(1.0, t.mean_square / power),
                "z": t.z,
                "kind": t.kind,
                "how": t.how,
            }
            if key not in best or abs(t.z) > abs(float(str(best[key]["z"]))):
                best[key] = row
    return sorted(best.values(), key=lambda x: -abs(float(str(x["z"]))))


_RATES = {"d_": "m/s^3", "d2_": "m/s^4"}


def term_unit(channels_: Sequence[str]) -> str:
    """Unit of a term's coefficient: V over the units of its channels."""
    units = [channel_unit(c) for c in channels_]
    return "V" if not units else f"V/({'*'.join(units)})"


def channel_unit(name: str) -> str:
    """SI unit of a series of :mod:`ragg_runtime.ingredients`."""
    if name in ingredients.FORCES:
        return "m/s^2"
    if (call := ingredients.FUNCTION.fullmatch(name)) is not None:
        unit = channel_unit(call["of"])
        return {"abs": unit, "sign": "1", "square": f"({unit})^2"}[call[1]]
    if (slow := ingredients.SLOW.fullmatch(name)) is not None:
        return channel_unit(slow["of"])
    if name not in SI_UNITS and (rate := ingredients.DERIVATIVE.fullmatch(name)) is not None:
        unit, per = channel_unit(rate["of"]), name.partition("_")[0]
        if unit == "m/s^2":
            return _RATES[f"{per}_"]
        return f"{unit}/{'s' if per == 'd' else 's^2'}"
    return SI_UNITS.get(name, "1")


@one_thread
def compare(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Comparison:
    """Nominal, calibrated and held-out errors of a model on flights, the noise, and where it fails."""
    f = fit(model, instrument, [observe(x, instrument) for x in flights])
    half, _ = f.coefficients((), held_out=True)
    calibrated, held_out, nominal = errors(f, [np.zeros(f.n_base), half])
    return concluded(f, nominal.whole, calibrated, held_out.held_out)


def errors(f: Fitted, coefficients: Sequence[Array]) -> list[Scored]:
    """How large the residuals are with these coefficients of the base columns, and with the nominal values (last)."""
    p = vector(f.model, f.instrument)
    return f.score([f.vector(c) for c in coefficients], lambda x: nominal_residual(f, p, x)[None], 1)


def concluded(f: Fitted, nominal: Error, calibrated: Scored, holdout: Error) -> Comparison:
    """Search what is left, and say whether the model is adequate."""
    rem = remainder(f)
    available = testable_effects(f)
    choice = search.choose(f.field(available)) if available else None
    adequate = not rem.significant and not (choice and choice.chosen)
    p = vector(f.model, f.instrument)
    return Comparison(f, nominal, calibrated, holdout, noise_floor(f), adequate, rem, p)


def nominal_residual(f: Fitted, p: Array, piece: Piece) -> Array:
    """Residual of G_out, (N,) V, of a piece of a flight with these values."""
    o = piece.observation
    predicted = design.observe(o, voltages(f.model.chain, o.record, p), None)
    return as_output(o, np.where(o.record.valid, o.data - predicted, 0.0))


def noise_floor(f: Fitted) -> float:
    """rms of the estimated noise of G_out before demodulation, Eo."""
    variances = []
    for x in f.flown:
        share = design.noise_gain(x.observation.record.rate) if x.observation.kind == "channels" else 1.0
        variances.append(share * sum(m.rms**2 for m in x.noise.models))
    return float(np.sqrt(np.mean(variances))) / f.k_ggi


def testable_effects(f: Fitted) -> list[str]:
    """Deterministic candidates of which every flight has the channels."""
    have = [set(o.record.wide) for o in f.observations]
    return [
        e.id
        for e in f.model.candidates
        if e.kind == "deterministic" and all(c in h for c in e.channels for h in have)
    ]


def demodulated(f: Fitted, residuals: Sequence[Array]) -> list[tuple[Array, Array, Array]]:
    """(time, inline, cross) of every flight's residual, s and Eo."""
    return [
        channels(e, x.observation.record, f.k_ggi, x.observation.record.valid)
        for x, e in zip(f.flown, residuals, strict=True)
    ]
