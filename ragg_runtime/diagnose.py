"""Which physical effect is missing: the method, its verdict, and what the record cannot tell.

1. Calibrate the existing model on all flights; estimate the noise; whiten (``compare.fit``).
2. Test every candidate on what no parameter of the model can absorb; choose forward with swaps.
   Strong ones are derived into the model one after the other, and everything is done anew (``diagnosis.strong``).
3. Refit with the chosen effects derived into the model, so that their couplings and the calibration are
   nonlinear again; search the remainder for anything else. Several effects must do as well as
   any one generic term.
4. Verdict: ``adequate`` (nothing significant), ``missing-effect`` (the chosen effects bring the residual
   down to noise) or ``unexplained`` (something significant remains that no known effect accounts for).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import compare, design, display, next_motion, suggestion
from ragg_runtime.compare import Fitted, Remainder, Scored
from ragg_runtime.design import Column
from ragg_runtime.diagnosis import strong
from ragg_runtime.diagnosis.strong import Extend, Stage, Taken
from ragg_runtime.evaluate import missing_channels, vector
from ragg_runtime.evidence import likelihood, omnibus, search, special, work
from ragg_runtime.evidence.likelihood import Test
from ragg_runtime.evidence.omnibus import Found
from ragg_runtime.evidence.search import Choice, Field
from ragg_runtime.evidence.special import Variance
from ragg_runtime.fit import convergence
from ragg_runtime.fit.off_sheet import OffSheet, off_sheet
from ragg_runtime.flight import Flight
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Effect, Model
from ragg_runtime.metrics import Error, finite
from ragg_runtime.next_motion import Proposal
from ragg_runtime.passes import Piece
from ragg_runtime.threads import one_thread

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ParameterValue:
    """A fitted parameter, in its display unit."""

    name: str
    accelerometer: int | None
    value: float
    std: float
    unit: str

    def as_json(self) -> dict[str, object]:
        return {
            "name": self.name,
            "accelerometer": self.accelerometer,
            "value": self.value,
            "std": self.std,
            "unit": self.unit,
        }


@dataclass(frozen=True)
class Ranked:
    """One effect and the evidence for it, alone."""

    effect: str
    log_p: float
    chi2: float
    rank: int
    delta_bic: float
    before: Error
    after: Error
    after_holdout: Error
    parameters: tuple[ParameterValue, ...]
    combinations: tuple[ParameterValue, ...]
    indistinguishable_from: tuple[str, ...]

    @property
    def p_value(self) -> float:
        """p-value, corrected for the effect's own sub-blocks (0 where it underflows: see ``log_p``)."""
        return float(np.exp(self.log_p))

    def as_json(self) -> dict[str, object]:
        return {
            "effect": self.effect,
            "p_value": self.p_value,
            "log10_p": finite(self.log_p / np.log(10.0)),
            "chi2": finite(self.chi2),
            "rank": self.rank,
            "delta_bic": finite(self.delta_bic),
            "error_before": self.before.as_json(),
            "error_after": self.after.as_json(),
            "error_after_holdout": self.after_holdout.as_json(),
            "parameters": [p.as_json() for p in self.parameters],
            "combinations": [p.as_json() for p in self.combinations],
            "indistinguishable_from": list(self.indistinguishable_from),
        }


@dataclass(frozen=True)
class NotTestable:
    """An effect on which this record is silent, and why."""

    effect: str
    why: str


@dataclass(frozen=True)
class Diagnosis:
    """The result of ``diagnose``: the interface's JSON, and what the report draws."""

    verdict: str
    fitted: Fitted
    ranking: tuple[Ranked, ...]
    found: tuple[str, ...]
    not_testable: tuple[NotTestable, ...]
    remainder: Remainder
    remainder_share: float
    before: Error
    scored: Scored
    noise_floor: float
    sizes: tuple[tuple[str, str], ...]
    target: Fitted
    coefficients: Array
    next_motion: tuple[Proposal, ...]
    complaint: str | None = None
    off_sheet: tuple[OffSheet, ...] = ()
    staged: bool = False
    """Whether what was found was derived into the model one after the other."""

    @property
    def converged(self) -> bool:
        """Whether the calibration with what was chosen in the model has arrived; if not, ``complaint`` says why."""
        return self.complaint is None

    @property
    def after(self) -> Error:
        """Error with the effects chosen (claimed or not) in the model."""
        return self.scored.whole

    @property
    def final(self) -> Fitted | None:
        """The model with the chosen effects derived into it, if that was done."""
        return None if self.target is self.fitted else self.target

    @cached_property
    def residual(self) -> list[Array]:
        """(N,) V of every flight, calibrated, as the model is."""
        return self.fitted.residuals(np.zeros(self.fitted.n_base))

    @cached_property
    def residual_after(self) -> list[Array]:
        """(N,) V of every flight, with the effects chosen (claimed or not) in the model."""
        return self.target.residuals_of(self.coefficients)

    def terms(self) -> list[dict[str, object]]:
        """Generic terms in what remains (see :func:`ragg_runtime.compare.terms_json`)."""
        return compare.terms_json(self.remainder, self.scored.mean_square)

    def expression(self) -> str | None:
        """The strongest unexplained term as a line for ``effects`` in model.toml, under a name of one's own."""
        found = self._suggested
        return None if found is None else found[1]

    def needs(self) -> list[str]:
        """Columns, in words, that a flight must have for :meth:`expression`."""
        found = self._suggested
        return [] if found is None else suggestion.columns(found[0].term)

    @cached_property
    def _suggested(self) -> tuple[Found, str] | None:
        steady = [t for s in self.remainder.searches for t in s.terms if t.kind == "steady"]
        for t in sorted(steady, key=lambda t: -abs(t.z)):
            units = [u for c in t.term.channels if (u := compare.channel_unit(c)) != "1"]
            line = suggestion.line(t.term, t.centre, "/".join(("m/s^2", *(f"({u})" for u in units))))
            if line is not None:
                return t, line
        return None

    def _repr_html_(self) -> str:
        return display.diagnosis(self.as_json())

    def as_json(self) -> dict[str, object]:
        return {
            "verdict": self.verdict,
            "converged": self.converged,
            "reason": self.complaint,
            "off_sheet": [x.as_json() for x in self.off_sheet],
            "ranking": [r.as_json() for r in self.ranking],
            "found": list(self.found),
            "not_testable": [{"effect": n.effect, "why": n.why} for n in self.not_testable],
            "unexplained": {
                "share": self.remainder_share,
                "log10_p": float(self.remainder.log_p / np.log(10.0)),
                "terms": self.terms(),
                "expression": self.expression(),
                "needs": self.needs(),
            },
            "error": {"before": self.before.as_json(), "after": self.after.as_json()},
            "noise_floor": {"rms_Eo": self.noise_floor},
            "next_motion": [p.as_json() for p in self.next_motion],
            "detectable": [{"effect": e, "three_sigma": s} for e, s in self.sizes],
        }


@one_thread
def diagnose(
    model: Model,
    instrument: Instrument,
    flights: Sequence[Flight],
    extend: Extend | None = None,
    limits: Mapping[str, float] = next_motion.LIMITS,
) -> Diagnosis:
    """Find which of the model's candidate effects the flights need.

    Parameters
    ----------
    flights
        Flights of one instrument, fitted together.
    extend
        Derives the model with the chosen effects in it, for the final, nonlinear check. Without it the
        check is linear.
    limits
        Largest amplitudes ``a`` (m/s^2) and ``omega`` (rad/s) of a motion to fly next.
    """
    observations = [compare.observe(x, instrument) for x in flights]
    f = compare.fit(model, instrument, observations)
    return diagnose_fitted(f, flights, extend, limits)


@one_thread
def diagnose_fitted(
    f: Fitted,
    flights: Sequence[Flight],
    extend: Extend | None = None,
    limits: Mapping[str, float] = next_motion.LIMITS,
) -> Diagnosis:
    """As :func:`diagnose`, on flights that are already fitted; ``limits`` as for ``next_motion.proposals``."""
    output = _output_effects(f, flights)
    first = Stage.of(f)
    steps, last = strong.taken(first, extend)
    f, field, choice = last.fitted, last.field, last.choice
    chosen = list(choice.chosen)
    given = [n for e in chosen for n, _ in field.candidates[e]]
    final = _confirmed(f, chosen, extend)
    rem, random = _remainder(f, given) if final is None else _remainder(final, ())
    if not rem.significant and (simpler := _simpler(f, field, choice)) is not None:
        rem = simpler
    if rem.significant:
        random = {}
    count = len(field.candidates) + len(random)
    random_found = sorted((t.log_p, e) for e, t in random.items() if search.significant(t, count))
    target = f if final is None else final
    v = f.vector(f.coefficients(given)[0], given) if final is None else np.zeros(target.size)
    half = target.vector(*_half(target, given if final is None else ()))
    after, held_out = target.score([v, half])
    noise = compare.noise_floor(target)
    complaint = convergence.complaint(target.calibration, after.held_out, held_out.held_out)
    if complaint is not None or rem.significant or after.whole.rms_Eo > compare.LOUD * noise:
        verdict, found = "unexplained", []
    else:
        found = [*(t.effect for t in steps), *chosen, *(e for _, e in random_found[:1]), *output]
        verdict = "missing-effect" if found else "adequate"
    explained = sum(s.chi2 for s in rem.searches) if rem.significant else 0.0
    whitened = sum(s.square for s in rem.searches)
    ranking, before = _ranking(first.fitted, first.field, first.choice, first.instants, output)
    ranking += _ranked_random(f, random, before)
    if steps:
        later, _ = _ranking(f, field, choice, last.instants, ())
        ranking = _staged(steps, [r for r in later if r.effect in chosen], ranking, target)
    groups = search.rivals(first.field, first.choice) if not steps else {t.effect: t.rivals for t in steps}
    return Diagnosis(
        verdict=verdict,
        fitted=first.fitted,
        ranking=tuple(sorted(ranking, key=_place([*(t.effect for t in steps), *chosen]))),
        found=tuple(found),
        not_testable=tuple(_not_testable(first.fitted, first.field)),
        remainder=rem if rem.significant else _without_terms(rem),
        remainder_share=explained / whitened if whitened else 0.0,
        before=before,
        scored=after,
        noise_floor=noise,
        sizes=tuple(_sizes(first.fitted, first.field)),
        target=target,
        coefficients=v,
        next_motion=tuple(
            next_motion.proposals(first.fitted, first.field, next_motion.pairs_of(groups), limits)
        ),
        complaint=complaint,
        staged=bool(steps),
        off_sheet=tuple(off_sheet(target.model, target.instrument, target.calibration)),
    )


def _half(f: Fitted, given: Sequence[int]) -> tuple[Array, Sequence[int]]:
    """Coefficients fitted to half of the blocks of time, and the candidates among them."""
    return f.coefficients(given, held_out=True)[0], given


def _staged(
    steps: Sequence[Taken], chosen: Sequence[Ranked], others: Sequence[Ranked], target: Fitted
) -> list[Ranked]:
    """The ranking where effects were derived into the model one after the other: each of them with what the model, with
    those before it in, leaves without and with it; the rest as they stand against the model as it was.
    """
    found = [_ranked_taken(t, target) for t in steps] + list(chosen)
    names = {r.effect for r in found}
    return [*found, *(r for r in others if r.effect not in names)]


def _ranked_taken(t: Taken, target: Fitted) -> Ranked:
    (before,) = t.before.score([np.zeros(t.before.size)])
    half = t.after.vector(*_half(t.after, ()))
    after, held_out = t.after.score([np.zeros(t.after.size), half])
    c = target.calibration
    own = [n for n, q in enumerate(c.columns) if q.effect == t.effect]
    columns = [c.columns[n] for n in own]
    values = np.array([c.p[c.index[n]] / c.columns[n].scale for n in own])
    covariance = c.covariance[np.ix_(own, own)]
    parameters = parameter_values(columns, values, covariance)
    if t.instant is not None:
        parameters.append(ParameterValue("t_step", None, t.instant, 0.0, "s"))
    return Ranked(
        effect=t.effect,
        log_p=t.test.log_p,
        chi2=t.test.chi2,
        rank=t.test.rank,
        delta_bic=float(t.test.chi2 - t.test.rank * np.log(c.rows)),
        before=before.whole,
        after=after.whole,
        after_holdout=held_out.held_out,
        parameters=tuple(parameters),
        combinations=tuple(visible_combinations(columns, values, covariance)),
        indistinguishable_from=t.rivals,
    )


def _simpler(f: Fitted, field: Field, choice: Choice) -> Remainder | None:
    """What the model alone leaves, if there one generic term explains more than all that is chosen.

    Asked of several effects and of one with many coefficients. Those that are really there could lose to one term only
    if it were nearly the sum of their signatures and fitted the noise better besides.
    """
    blocks = [choice.blocks[e] for e in choice.chosen]
    if not blocks or len(f.flown) > 1:
        return None
    picked, rank = field.joint(blocks)
    if len(blocks) < 2 and rank <= FEW:
        return None
    joint, freedom = field.joint([[n for n, _ in field.candidates[e]] for e in choice.chosen])
    rem = compare.remainder(f)
    best = max((t.z**2 for s in rem.searches for t in s.terms[:1] if t.kind == "steady"), default=0.0)
    margin = SIMPLER_THAN_ONE if len(blocks) < 2 else omnibus.INDISTINGUISHABLE
    return rem if best > max(picked, joint - freedom) + margin else None


FEW = 4
"""Coefficients up to which one effect need not fear that a generic term stands in its place."""

SIMPLER_THAN_ONE = 16.0
"""Chi-square by which one generic term must be better than one effect to take its place (4 sigma): of single effects there
are near copies among the terms. Of several it must be better by 3 sigma, and be all of them."""


def _without_terms(rem: Remainder) -> Remainder:
    return Remainder(tuple(replace(s, terms=()) for s in rem.searches))


def _confirmed(f: Fitted, chosen: Sequence[str], extend: Extend | None) -> Fitted | None:
    """The chosen effects derived into the model and everything fitted again, if that can be done."""
    steps = {e.id for e in f.model.candidates if e.kind == "step"}
    if not chosen or extend is None or (steps & set(chosen)):
        return None
    extended = extend(f.model, chosen)
    start = _linear(f, chosen, extended)
    return compare.fit(extended, f.instrument, f.observations, f.calibration.noise, start)


def _linear(f: Fitted, chosen: Sequence[str], extended: Model) -> Array:
    """Parameter vector of the extended model as the linear fit has it, SI."""
    own = [
        (n, c) for n, c in enumerate(design.candidate_columns(f.model, f.instrument)) if c.effect in chosen
    ]
    fitted, _ = f.coefficients([n for n, _ in own])
    columns = (*f.calibration.columns, *(c for _, c in own))
    before = (*f.calibration.p[f.calibration.index], *(0.0 for _ in own))
    value = {c.label: b + x * c.scale for c, b, x in zip(columns, before, fitted, strict=True)}
    p = vector(extended, f.instrument)
    for c, place in design.base_columns(extended, f.instrument):
        p[place] = value[c.label]
    return p


def _remainder(f: Fitted, given: Sequence[int]) -> tuple[Remainder, dict[str, Test]]:
    """What is left once ``given`` columns are projected out, and the tests of random effects, in one pass."""
    places = _random_columns(f)

    def variances(piece: Piece, y: Array) -> dict[str, Variance]:
        return {e: Variance.of(piece, place, y) for e, place in places.items()}

    searches, counted = [], []
    for x, triangles in zip(f.flown, f.triangles, strict=True):
        found, more = omnibus.search(x, work.projector(triangles, f.n_base, given), variances)
        searches.append(found)
        counted += more
    return Remainder(tuple(searches)), {e: special.pooled([v[e] for v in counted]).test() for e in places}


def _random_columns(f: Fitted) -> dict[str, int]:
    """The place of every random effect's column."""
    if any(o.kind == "channels" for o in f.observations):
        return {}  # neighbouring samples of a demodulated channel are not independent
    columns = design.candidate_columns(f.model, f.instrument)
    found = {}
    for e in f.model.candidates:
        own = [n for n, c in enumerate(columns) if c.effect == e.id]
        if e.kind == "random" and own:
            found[e.id] = f.n_base + own[0]
    return found


def _output_effects(f: Fitted, flights: Sequence[Flight]) -> list[str]:
    """Saturation and quantisation of a recorded output, recognised in its values."""
    known = {e.id for e in f.model.candidates if e.kind == "output"}
    found = []
    for x, w in zip(flights, f.flown, strict=True):
        for name, series in x.outputs.items():
            if name not in ("G_out", "V_1", "V_2", "V_3", "V_4"):
                continue
            valid = np.isfinite(series) & x.valid
            if "saturation" in known and special.saturation(series, valid):
                found.append("saturation")
            noise = w.noise.models[0].rms
            if "quantisation" in known and special.quantisation(series, valid, noise):
                found.append("quantisation")
    return sorted(set(found))


def _ranking(
    f: Fitted, field: Field, choice: Choice, instants: Mapping[str, float], output: Sequence[str]
) -> tuple[list[Ranked], Error]:
    """Every testable effect with the evidence for it alone, and the error without any."""
    rivals = search.rivals(field, choice)
    tested = [(e, t, field.testable(e)) for e, t in choice.tests.items() if t.rank]
    fits = [f.coefficients(extra) for _, _, extra in tested]
    vectors = [f.vector(np.zeros(f.n_base))]
    for (_, _, extra), (c, _) in zip(tested, fits, strict=True):
        half, _ = f.coefficients(extra, held_out=True)
        vectors += [f.vector(c, extra), f.vector(half, extra)]
    first, *scored = f.score(vectors)
    before = first.whole
    ranked = []
    for n, ((e, t, extra), (c, covariance)) in enumerate(zip(tested, fits, strict=True)):
        own = dict(field.candidates[e])
        mine = [own[k] for k in extra]
        values, spread = c[f.n_base :], covariance[f.n_base :, f.n_base :]
        parameters = parameter_values(mine, values, spread)
        if e in instants:
            parameters.append(ParameterValue("t_step", None, instants[e], 0.0, "s"))
        twins = rivals.get(e, ())
        for main, others in rivals.items():
            if e in others:
                twins = tuple(sorted({main, *others} - {e}))
        ranked.append(
            Ranked(
                e,
                t.log_p,
                t.chi2,
                t.rank,
                float(t.chi2 - t.rank * np.log(f.calibration.rows)),
                before,
                scored[2 * n].whole,
                scored[2 * n + 1].held_out,
                tuple(parameters),
                tuple(visible_combinations(mine, values, spread)),
                twins,
            )
        )
    for e in output:
        ranked.append(Ranked(e, -np.inf, np.inf, 1, np.inf, before, before, before, (), (), ()))
    return ranked, before


def _ranked_random(f: Fitted, random: dict[str, Test], before: Error) -> list[Ranked]:
    rows = np.log(f.calibration.rows)
    return [
        Ranked(e, t.log_p, t.chi2, t.rank, float(t.chi2 - rows), before, before, before, (), (), ())
        for e, t in random.items()
    ]


def _place(chosen: Sequence[str]) -> Callable[[Ranked], tuple[int, float, str]]:
    """Order of the ranking: chosen effects as they were chosen, then by significance."""
    order = {e: n for n, e in enumerate(chosen)}
    return lambda r: (order.get(r.effect, len(order)), r.log_p, r.effect)


def parameter_values(columns: Sequence[Column], values: Array, covariance: Array) -> list[ParameterValue]:
    """Fitted parameters (in scales) in their display units."""
    found = []
    for k, c in enumerate(columns):
        factor = c.scale / c.unit_factor
        name = c.name.split(".", 1)[1] if c.effect else c.name
        std = float(np.sqrt(covariance[k, k])) * factor
        found.append(ParameterValue(name, c.accelerometer, float(values[k]) * factor, std, c.unit))
    return found


PATTERNS: tuple[tuple[str, tuple[float, ...]], ...] = (
    ("{0}[1] - {0}[2]", (1.0, -1.0, 0.0, 0.0)),
    ("{0}[3] - {0}[4]", (0.0, 0.0, 1.0, -1.0)),
    ("{0}[1] + {0}[2] - {0}[3] - {0}[4]", (1.0, 1.0, -1.0, -1.0)),
    ("{0}[1] + {0}[2] + {0}[3] + {0}[4]", (1.0, 1.0, 1.0, 1.0)),
)
"""The paper's D^12, D^34, D^1234 and Sigma of a parameter: what the output may see of it."""


def visible_combinations(columns: Sequence[Column], values: Array, covariance: Array) -> list[ParameterValue]:
    """The combinations of four values that the record determines, where it does not determine each of them.

    A combination counts as seen where its standard deviation is below a tenth of the prior's.
    """
    found = []
    for name in dict.fromkeys(c.name for c in columns if c.accelerometer is not None):
        at = [k for k, c in enumerate(columns) if c.name == name]
        if len(at) != 4:
            continue
        c = columns[at[0]]
        factor = c.scale / c.unit_factor
        block = covariance[np.ix_(at, at)]
        if np.all(np.diag(block) < 0.01):
            continue  # each value is seen by itself
        for pattern, weights in PATTERNS:
            w = np.array(weights)
            variance = float(w @ block @ w)
            if variance < 0.01 * float(w @ w):
                label = pattern.format(name.split(".", 1)[-1])
                value = float(w @ values[at]) * factor
                found.append(ParameterValue(label, None, value, float(np.sqrt(variance)) * factor, c.unit))
    return found


def _not_testable(f: Fitted, field: Field) -> list[NotTestable]:
    found = []
    for e in f.model.candidates:
        missing = sorted({c for o in f.observations for c in missing_channels(e, o.record)})
        if missing:
            found.append(NotTestable(e.id, f"the flight has no channel {', '.join(missing)}"))
        elif e.id in field.candidates and not field.testable(e.id):
            found.append(NotTestable(e.id, _absorbed(f, field, e)))
    return found


def _absorbed(f: Fitted, field: Field, e: Effect) -> str:
    """In words: which parameters of the model absorb an effect, or that it is too weak to be seen."""
    columns = [n for n, _ in field.candidates[e.id]]
    n = f.n_base
    whole = np.linalg.norm(field.T[:, [n + k for k in columns]], axis=0)
    left = np.linalg.norm(field.P[:, columns], axis=0)
    k = int(np.argmax(whole))
    strongest = columns[k]
    if whole[k] < likelihood.TESTABLE:
        return "this record hardly excites it: even a hundred times its plausible size leaves no trace"
    solution = np.linalg.solve(field.T[:n, :n], field.T[:n, n + strongest])
    names: dict[str, float] = {}
    for c, v, norm in zip(
        f.calibration.columns, solution, np.linalg.norm(field.T[:, :n], axis=0), strict=True
    ):
        names[c.name] = names.get(c.name, 0.0) + float(np.abs(v * norm))
    most = sorted(names, key=lambda x: -names[x])[:3]
    share = float(left[k] / whole[k]) if whole[k] else 0.0
    return (
        f"absorbed by {', '.join(most)} of the model: {share:.1e} of its signature survives the calibration"
    )


def _sizes(f: Fitted, field: Field) -> list[tuple[str, str]]:
    """Size, in display units, at which each testable effect would be seen at three sigma."""
    rows = []
    left = np.linalg.norm(field.P, axis=0)
    for e, columns in field.candidates.items():
        own = dict(columns)
        for name in dict.fromkeys(c.name for _, c in columns):
            best = [(left[n], own[n]) for n in field.testable(e) if own[n].name == name]
            if best:
                norm, c = max(best, key=lambda x: float(x[0]))
                size = 3.0 / norm * c.scale / c.unit_factor
                rows.append((e, f"{name.split('.', 1)[1]} = {size:.3g} {c.unit}"))
    return rows
