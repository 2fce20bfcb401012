"""Which physical effect is missing: the method, its verdict, and what the record cannot tell.

The model is calibrated, every candidate tested on what no parameter absorbs, strong ones derived into the model one after the
other; a refit with all chosen effects shows whether the residual comes down to noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation import columns as design
from ragg_runtime.estimation import fitted as fitted_
from ragg_runtime.estimation import prepared_flight
from ragg_runtime.estimation.fitted import Fitted, Scored, calibrated, fit
from ragg_runtime.estimation.observation import Observation, observations_of
from ragg_runtime.estimation.off_sheet import QUIET, off_sheet
from ragg_runtime.estimation.passes import Piece
from ragg_runtime.estimation.score import Error
from ragg_runtime.estimation.thinning import thinned
from ragg_runtime.identification import comparison, next_motion, omnibus, selection, sequential, strong
from ragg_runtime.identification.comparison import Explained, explained
from ragg_runtime.identification.contenders import Extend
from ragg_runtime.identification.likelihood_ratio import Test, Variance, pooled
from ragg_runtime.identification.line_rival import LineRival, Steady, line_rival
from ragg_runtime.identification.omnibus import Remainder
from ragg_runtime.identification.ranking import (
    Ranked,
    _not_testable,
    _place,
    _ranked_random,
    _ranking,
    _sizes,
    staged,
    weighed,
    with_probability,
)
from ragg_runtime.identification.result import Diagnosis, groups
from ragg_runtime.identification.strong import Stage, Taken
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.model import Model, Recogniser

Array = NDArray[np.float64]


@one_thread
def diagnose(
    model: Model,
    instrument: Instrument,
    flights: Sequence[Flight],
    extend: Extend | None = None,
    limits: Mapping[str, float] = next_motion.LIMITS,
) -> Diagnosis:
    """Find which of the model's candidate effects the flights, of one instrument, need.

    ``extend`` derives the model with the chosen effects for the final, nonlinear check, which is linear without it; ``limits`` are
    the largest amplitudes ``a`` (m/s^2) and ``omega`` (rad/s) of a motion to fly next.
    """
    observations = thinned(model, instrument, observations_of(flights, instrument))
    f = fit(model, instrument, observations)
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
    apart = contradiction(first)
    # before strong effects, whose columns take the place of these
    ranked = _ranking(first.fitted, first.field, first.choice, first.instants, output)
    steps, last = ([], first.without_choice()) if apart else strong.taken(first, extend)
    last, c = confirmed(last, extend)
    chosen = [*(t.effect for t in steps), *last.choice.chosen]
    left = _left(steps, last, c)
    end = _end(last, c, apart)
    verdict, found = _verdict(left, end, chosen, output)
    by_terms = sum(s.chi2 for s in left.remainder.searches) if left.remains else 0.0
    whitened = sum(s.square for s in left.remainder.searches)
    ranking = _ranked(*ranked, steps, last, end.target, left)
    credence = weighed(last.field, steps)
    rivals = selection.rivals(first.field, first.choice) if not steps else {t.effect: t.rivals for t in steps}
    steady = [s for s in left.steady if s.effect in found]
    return Diagnosis(
        verdict=verdict,
        fitted=first.fitted,
        ranking=tuple(
            sorted(
                (with_probability(r, credence, first.field.candidates) for r in ranking), key=_place(chosen)
            )
        ),
        found=tuple(found),
        not_testable=tuple(_not_testable(first.fitted, first.field)),
        remainder=left.remainder if left.remains else _without_terms(left.remainder),
        remainder_share=by_terms / whitened if whitened else 0.0,
        before=ranked[1],
        scored=end.scored,
        noise_floor=end.noise_floor,
        sizes=tuple(_sizes(first.fitted, first.field)),
        target=end.target,
        coefficients=end.coefficients,
        next_motion=tuple(
            next_motion.proposals(first.fitted, first.field, next_motion.pairs_of(rivals), limits)
        ),
        complaint=end.complaint,
        remark=_remark(end.doubt, left, steady, comparison.disturbed(end.target)),
        explained=end.explained,
        groups=groups(found, ranking, steady),
        credible_set=credence.credible,
        holds=_followed(end.target, [(t.effect, t.instant) for t in steps] + [*last.instants.items()], found),
        staged=bool(steps),
        off_sheet=tuple(off_sheet(end.target.model, end.target.instrument, end.target.calibration)),
    )


@dataclass(frozen=True, eq=False)
class _Left:
    """What the chosen effects leave: a remainder, a line of the output, random effects; ``remains``: more than chance does.

    ``random_found`` are (log p, effect), the surest first; ``steady`` the chosen effects that act as a constant term.
    """

    remainder: Remainder
    line: LineRival | None
    steady: Sequence[Steady]
    random: Mapping[str, Test]
    random_found: Sequence[tuple[float, str]]
    remains: bool


def _left(steps: Sequence[Taken], last: Stage, c: Confirmed) -> _Left:
    random = {e: v.test() for e, v in c.random.items()}
    count = len(last.field.candidates) + len(random)
    random_found = sorted((t.log_p, e) for e, t in random.items() if selection.significant(t, count))
    rem = c.remainder
    line, steady = line_rival(steps, last)
    if line is not None and not line.better(rem):
        line = None
    rem = rem if line is None else line.within(rem)
    remains = line is not None or rem.significant
    if remains:
        random, random_found = {}, []
    return _Left(
        remainder=rem,
        line=line,
        steady=steady,
        random=random,
        random_found=random_found,
        remains=remains,
    )


@dataclass(frozen=True, eq=False)
class _End:
    """The flights with the chosen effects in, how they fit, and what speaks against the fit (in words, or ``None``)."""

    target: Fitted
    coefficients: Array
    scored: Scored
    noise_floor: float
    explained: Explained
    complaint: str | None
    doubt: str | None


def _end(last: Stage, c: Confirmed, apart: str | None) -> _End:
    f = last.fitted
    given = [n for e in last.choice.chosen for n, _ in last.field.candidates[e]]
    target = f if c.final is None else c.final
    v = f.vector(f.coefficients(given)[0], given) if c.final is None else np.zeros(target.size)
    (after,) = target.score([v])
    output_explained = explained(target, after)
    return _End(
        target=target,
        coefficients=v,
        scored=after,
        noise_floor=fitted_.noise_floor(target),
        explained=output_explained,
        complaint=target.calibration.complaint,
        doubt=apart or output_explained.complaint,
    )


def _verdict(
    left: _Left, end: _End, chosen: Sequence[str], output: Sequence[str]
) -> tuple[str, Sequence[str]]:
    """The verdict, and the effects that are claimed."""
    # noise that follows the motion is louder where the motion is: a random effect says so itself
    loud = comparison.loud(end.target, end.scored, end.noise_floor) and not left.random_found
    if end.complaint is not None or end.doubt is not None or left.remains or loud:
        return "unexplained", []
    found = [*chosen, *(e for _, e in left.random_found[:1]), *output]
    return ("missing-effect" if found else "adequate"), found


def _ranked(
    ranking: Sequence[Ranked],
    before: Error,
    steps: Sequence[Taken],
    last: Stage,
    target: Fitted,
    left: _Left,
) -> list[Ranked]:
    """The effects as they stand in the ranking; ``ranking`` is the first stage's, ``before`` the error without any."""
    ranking = [*ranking, *_ranked_random(last.fitted, left.random, before)]
    if steps:
        chosen = last.choice.chosen
        later = (
            _ranking(last.fitted, last.field, last.choice, last.instants, only=chosen)[0] if chosen else []
        )
        ranking = staged(steps, later, ranking, target)
    return ranking


def _remark(doubt: str | None, left: _Left, steady: Sequence[Steady], disturbed: str | None) -> str | None:
    """What is wrong with the record, or what else than the effects found would do, or how the record is disturbed."""
    if doubt is not None:
        return doubt
    if left.line is not None:
        return left.line.words
    return "; ".join([*(s.words for s in steady), *([] if disturbed is None else [disturbed])]) or None


def _followed(
    target: Fitted, instants: Sequence[tuple[str, float | None]], found: Sequence[str]
) -> sequential.Evidence | None:
    """From when on the model no longer holds; a step that is found is such an instant itself."""
    if target.observations[0].recorded.demodulated:
        return None  # neighbouring samples of a demodulated channel are not independent
    followed = sequential.evidence(target)
    for effect, instant in instants:
        if effect in found and instant is not None:
            name = target.observations[0].flight_name
            change = sequential.Change(flight=name, until=instant, log_evidence=followed.limit)
            return replace(followed, change=change)
    return followed


def _without_terms(rem: Remainder) -> Remainder:
    return Remainder(tuple(replace(s, terms=()) for s in rem.searches))


def _output_effects(f: Fitted, flights: Sequence[Flight]) -> list[str]:
    """Effects of the recorder, recognised in the columns in which each is looked for: the recorded outputs, or those it names."""
    found = set()
    place = f.prepared[0].observation.place
    first = [(w, b) for w, b in zip(f.prepared, f.beyond, strict=True) if w.observation.place == place]
    for x, (w, fast) in zip(flights, first, strict=True):
        columns = {**x.channels, **x.outputs}
        noise = float(np.sqrt(np.mean([m.rms**2 for m in w.noise.models]) + fast))
        outputs = [n for n in x.outputs if n in f.instrument.layout.columns]
        for effect, r in f.model.recognisers.items():
            looked_at = (columns[n] for n in getattr(r, "CHANNELS", outputs) if n in columns)
            if any(_present(r, c, x.valid, noise) for c in looked_at):
                found.add(effect)
    return sorted(found)


def _present(r: Recogniser, c: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Whether an effect of the recorder shows in a column (N,), which is not kept in memory."""
    return r.present(c, np.isfinite(c) & valid, noise)


UNEXPLAINED = 10.0
"""Times the noise's chi-square that all effects of the catalogue together must leave for flights to contradict each other."""


def contradiction(first: Stage) -> str | None:
    """That flights contradict each other, in words, and which agree; ``None`` if they do not. ``first`` is the stage without
    effects.
    """
    f = first.fitted
    flights: dict[int, list[Observation]] = {}
    for o in f.observations:
        flights.setdefault(o.flight, []).append(o)
    left = float(first.field.P[-1, -1] ** 2)
    if len(flights) < 2 or left < UNEXPLAINED * f.calibration.rows:
        return None
    if not all(_quiet(f, x) for x in flights.values()):
        return None
    agree: list[list[Sequence[Observation]]] = []
    for one in flights.values():
        group = next((g for g in agree if _quiet(f, [*g[0], *one])), None)
        if group is None:
            agree.append([one])
        else:
            group.append(one)
    names = "; ".join(", ".join(x[0].flight_name for x in g) for g in agree)
    return (
        f"each of the {len(flights)} flights alone is explained to its noise, but they contradict each other, and no effect of"
        f" the catalogue acts so between flights. Those that agree: {names}. Was the instrument, its mounting, an axis or a unit"
        " changed between them? ragg calibrate of each shows what differs; diagnose those together that agree"
    )


def _quiet(f: Fitted, observations: Sequence[Observation]) -> bool:
    """Whether the model leaves but noise of some of the observations."""
    return calibrated(f.model, f.instrument, observations)[1].excess <= QUIET


@dataclass(frozen=True)
class Confirmed:
    """What the chosen effects of the last stage leave; without ``final``, the fit with them in the model, all is linear."""

    final: Fitted | None
    remainder: Remainder
    random: Mapping[str, Variance]


def confirmed(last: Stage, extend: Extend | None) -> tuple[Stage, Confirmed]:
    """The chosen effects of the last stage fitted in the model; and the stage without those that then have an impossible size."""
    f = last.fitted
    final = _derived(f, last.choice.chosen, extend)
    while final is not None and (wrong := strong.impossible(final, last.choice.chosen)):
        kept = {e: c for e, c in last.field.candidates.items() if e not in wrong}
        field = replace(last.field, candidates=kept)
        last = replace(last, field=field, choice=selection.choose(field))
        final = _derived(f, last.choice.chosen, extend)
    given = [n for e in last.choice.chosen for n, _ in last.field.candidates[e]]
    rem, random = _remainder(f, given) if final is None else _remainder(final, ())
    return last, Confirmed(final=final, remainder=rem, random=random)


def _derived(f: Fitted, chosen: Sequence[str], extend: Extend | None) -> Fitted | None:
    """The chosen effects derived into the model and everything fitted again, if that can be done."""
    steps = {e.id for e in f.model.candidates if e.kind == "step"}
    if not chosen or extend is None or (steps & set(chosen)):
        return None
    extended = extend(f.model, chosen)
    start = _linear(f, chosen, extended)
    return fit(extended, f.instrument, f.observations, f.calibration.noise, start)


def _linear(f: Fitted, chosen: Sequence[str], extended: Model) -> Array:
    """Parameter vector of the extended model as the linear fit has it, SI."""
    own = [(n, c) for n, c in enumerate(f.candidates) if c.effect in chosen]
    fitted, _ = f.coefficients([n for n, _ in own])
    columns = (*f.calibration.columns, *(c for _, c in own))
    before = (*f.calibration.p[f.calibration.index], *(0.0 for _ in own))
    value = {c.label: b + x * c.scale for c, b, x in zip(columns, before, fitted, strict=True)}
    p = vector(extended, f.instrument)
    for c, place in design.base_columns(extended, f.instrument):
        p[place] = value[c.label]
    return p


def _remainder(f: Fitted, given: Sequence[int]) -> tuple[Remainder, dict[str, Variance]]:
    """What is left once ``given`` columns are projected out, and the sums of random effects, in one pass."""
    random = _random_columns(f)
    searches, counted = [], []
    for x, triangles in zip(f.prepared, f.triangles, strict=True):
        taken = prepared_flight.projector(triangles, f.n_base, given)
        lean, projector, places = taken.lean(x, list(random.values()))

        def variances(piece: Piece, y: Array, places: Sequence[int] = places) -> dict[str, Variance]:
            return {e: Variance.of(piece, k, y) for e, k in zip(random, places, strict=True)}

        found, more = omnibus.search(lean, projector, variances)
        searches.append(found)
        counted += more
    return Remainder(tuple(searches)), {e: pooled([v[e] for v in counted]) for e in random}


def _random_columns(f: Fitted) -> dict[str, int]:
    """The place of every random effect's column."""
    if any(o.recorded.demodulated for o in f.observations):
        return {}  # neighbouring samples of a demodulated channel are not independent
    columns = f.candidates
    found = {}
    for e in f.model.candidates:
        own = [n for n, c in enumerate(columns) if c.effect == e.id]
        if e.kind == "random" and own:
            found[e.id] = f.n_base + own[0]
    return found
