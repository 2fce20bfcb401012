"""The report of ``ragg diagnose``: which physical effect is missing, and how sure that is."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.columns import Column
from ragg_runtime.estimation.fitted import Fitted, Posterior, posterior
from ragg_runtime.identification import series
from ragg_runtime.identification.parameters import SEEN, UNSEEN, ParameterValue, gains
from ragg_runtime.identification.parameters import headlines as of_parameters
from ragg_runtime.identification.parameters import own_name as _name
from ragg_runtime.identification.ranking import Ranked, other_accelerometers
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.report import figures, page, panels, parameters
from ragg_runtime.report.figures import Bar
from ragg_runtime.report.page import Origin
from ragg_runtime.report.parameters import PATTERNS, Row
from ragg_runtime.wording import numbers

SHOWN_BARS = 12
"""Effects whose evidence is drawn."""

MOST_SAID = 3
"""Values of an effect that the lead says."""

CLEAR = 3.0
"""Standard errors from which a value is said in the report's first lines."""


def diagnose_html(
    diagnosis: Diagnosis,
    *,
    title: str,
    command: str,
    sources: Sequence[tuple[str, str]],
    notes: Sequence[str] = (),
) -> str:
    """The report as one HTML document; parameters as of :func:`~ragg_runtime.report.compare_page.compare_html`."""
    d = diagnosis
    f = d.fitted
    context: dict[str, Any] = {
        "kind": "What is missing",
        "state": {"adequate": "good", "missing-effect": "found"}.get(d.verdict, "bad"),
        "headline": headline(d),
        "lead": lead(d),
        "facts": panels.facts(f),
        "errors": errors(d),
        "sections": [*_sections(d), *_panels(d)],
        "ranking": ranking(d),
        "evidence": evidence(d, "evidence"),
        "groups": [(main, others) for main, others, _ in groups(d) if others],
        "unexplained": unexplained(d) if d.verdict == "unexplained" else None,
        "physics": physics(d),
        "headlines": [(r.effect, _headlines(r)) for r in d.ranking if r.effect in d.found],
        "effects": effect_rows(d, parameters.by_accelerometer),
        "combined": effect_rows(d, parameters.by_combination),
        "patterns": [name for name, _ in parameters.PATTERNS],
        "not_testable": [(n.effect, n.why) for n in d.not_testable],
        "next_motion": [numbers.clean(p.in_words()) for p in d.next_motion],
        "sizes": sizes(d),
        "digest": f.model.digest,
    }
    return page.render("diagnose.html.j2", Origin(title, command, sources, notes), context)


def headline(d: Diagnosis) -> str:
    """The verdict in one sentence."""
    before, after, noise = (numbers.number(x) for x in (d.before.rms_Eo, d.after.rms_Eo, d.noise_floor))
    if d.verdict == "adequate":
        return (
            f"Nothing is missing that this record could show: the calibrated model leaves {before} Eo,"
            f" and the noise is {noise} Eo."
        )
    if d.verdict == "missing-effect":
        names = numbers.listed([numbers.clean(e) for e in d.found])
        if d.after.rms_Eo >= d.before.rms_Eo * (1.0 - 1e-6):
            return f"The model lacks {names}, which the data show; its error stays {before} Eo."
        it = "it" if len(d.found) == 1 else "them"
        return (
            f"The model lacks {names}: with {it} the error falls from {before} to {after} Eo,"
            f" and the noise is {noise} Eo."
        )
    if d.complaint is not None:
        return f"Nothing can be said: {numbers.clean(d.complaint)}."
    left = (
        ", and the best of the known effects leave a significant remainder"
        if any(s.terms for s in d.remainder.searches)
        else ""
    )
    return (
        f"Something is missing that no known effect accounts for: {before} Eo remain where the noise is"
        f" {noise} Eo{left}."
    )


def lead(d: Diagnosis, sizes: str = "listed at the end") -> list[str]:
    """What the verdict rests on; ``sizes`` says where those stand that this record would show."""
    said = [] if d.remark is None else [f"Note: {numbers.clean(d.remark)}."]
    for r in d.ranking:
        if r.effect in d.found:
            clear = [x for x in _headlines(r) if abs(x.z) > CLEAR]
            if clear:
                sizes_ = numbers.listed([f"{_named(x)} = {x.text}" for x in clear[:MOST_SAID]])
                instead = _instead(values(d.fitted, r))
                said.append(f"{numbers.clean(r.effect)}: {sizes_}{instead}.")
    for main, others, name in groups(d):
        if name is not None:
            said.append(f"All that this record shows of {main} is a {name}.")
        if others:
            said.append(
                f"This record cannot tell {main} from {numbers.listed(others, 'or')}: treat them as one finding."
            )
    if d.verdict == "unexplained" and d.remark is None and d.ranking and claimed(d, d.ranking[0]):
        best = d.ranking[0]
        said.append(
            f"Of the known effects, {numbers.clean(best.effect)} comes nearest ({numbers.number(d.after.rms_Eo)} Eo with"
            " what was tried), but it is not claimed: what remains shows that the cause is another one."
        )
    if d.verdict == "adequate":
        said.append(
            f"An effect smaller than the sizes {sizes} may still be there: this record would not show it."
        )
    return said


def _headlines(r: Ranked) -> tuple[Value, ...]:
    return headlines(r.parameters, r.combinations)


def _named(v: Value) -> str:
    both = f"{v.of} of {v.name}" if v.of[:1] in ("D", "Σ") else f"{v.name} of {v.of}"
    return numbers.clean(both if v.of else v.name)


def _instead(v: Values) -> str:
    """Accelerometers that would do as well, in words."""
    if not v.instead:
        return ""
    return f"; {numbers.listed([f'{_named(x)} = {x.text}' for x in v.instead], 'or')} would do as well"


def claimed(d: Diagnosis, r: Ranked) -> bool:
    """Whether an effect's own test is significant over the whole ranking."""
    return bool(r.rank > 0 and r.log_p < threshold(d))


def threshold(d: Diagnosis) -> float:
    """Logarithm of the p-value below which one of all tested effects is significant."""
    return float(np.log(false_alarms.CATALOGUE / max(1, len(d.ranking))))


def errors(d: Diagnosis) -> list[dict[str, Any]]:
    """Rows of the table of errors."""
    rows = [
        panels.error_row("model as it is", d.before, "calibrated"),
        panels.error_row(
            "held out", panels.holdout_before(d.fitted), "the same, fitted on half of the blocks of time"
        ),
    ]
    if d.after != d.before:
        what = numbers.listed([numbers.clean(e) for e in d.found]) or "the best known effects"
        rows.append(panels.error_row(f"with {what}", d.after, "calibrated again"))
        if d.final is not None:
            rows.append(
                panels.error_row("held out", panels.holdout_before(d.final), "the same, fitted on half")
            )
    rows.append(panels.noise_row(d.final or d.fitted, d.noise_floor))
    return rows


def ranking(d: Diagnosis) -> list[dict[str, Any]]:
    """Rows of the ranking, best first."""
    rows = []
    for r in d.ranking:
        effect = d.fitted.model.effect(r.effect)
        rows.append(
            {
                "effect": r.effect,
                "title": effect.title if effect else "",
                "found": r.effect in d.found,
                "significant": claimed(d, r),
                "p": numbers.probability(r.log_p),
                "log10_p": numbers.number(r.log_p / math.log(10.0)),
                "delta_bic": numbers.number(r.delta_bic),
                "after": numbers.number(r.after.rms_Eo),
                "holdout": numbers.number(r.after_holdout.rms_Eo),
                "inline": numbers.number(r.after.inline_Eo_per_rtHz),
                "cross": numbers.number(r.after.cross_Eo_per_rtHz),
                "fitted": _fitted(d, r) if claimed(d, r) or r.effect in d.found else None,
                "indistinguishable": list(r.indistinguishable_from),
            }
        )
    return rows


def _fitted(d: Diagnosis, r: Ranked) -> Values:
    """Values of an effect alone; of one that was derived into the model first, those that it has there."""
    if d.staged and d.final is not None and any(q.effect == r.effect for q in d.final.calibration.columns):
        best_first = sorted(joint(d.final, r.effect), key=lambda v: -abs(v.z))
        return Values(tuple(best_first), 0, ())
    return values(d.fitted, r)


def evidence(d: Diagnosis, key: str) -> dict[str, Any] | None:
    """Bar chart of the evidence of the best effects; ``None`` if nothing was tested."""
    if not d.ranking:
        return None
    bars = []
    for r in d.ranking[:SHOWN_BARS]:
        value = -r.log_p / math.log(10.0)
        bars.append(Bar(r.effect, value if math.isfinite(value) else math.inf, strong=r.effect in d.found))
    level = -threshold(d) / math.log(10.0)
    finite = [b.value for b in bars if math.isfinite(b.value)]
    log = bool(finite) and max(finite) > 8.0 * level
    unit = "evidence, −log₁₀ p" + (" (logarithmic scale)" if log else "")
    svg = figures.lying(bars, key, "evidence for each effect", unit, level, log)
    caption = (
        "Evidence for each effect by itself, with nothing else added, best first. Dark: what would be added."
        f" Right of the dashed line the whole catalogue would raise a false alarm in {100 * false_alarms.CATALOGUE:.0f} records"
        " of a hundred."
    )
    if len(d.ranking) > SHOWN_BARS:
        caption += f" {len(d.ranking) - SHOWN_BARS} further effects are in the table only."
    return page.figure(svg, caption)


def groups(d: Diagnosis) -> list[tuple[str, list[str], str | None]]:
    """(found effect, those that the record cannot tell from it, a name for them all)."""
    return [(main, others, g.name) for g in d.groups for main, *others in [map(numbers.clean, g.effects)]]


def effect_rows(d: Diagnosis, table: Callable[[Fitted], list[Row]]) -> list[Row]:
    """Rows of a table of parameters that belong to the found effects, as fitted together."""
    if d.final is None or not d.found:
        return []
    return [r for r in table(d.final) if r.symbol.name.split(".", 1)[0] in d.found]


def physics(d: Diagnosis) -> list[dict[str, str]]:
    """What the found effects are, from the catalogue."""
    found = []
    for e in d.found:
        effect = d.fitted.model.effect(e)
        if effect is not None:
            found.append({"id": e, "title": effect.title, "physics": effect.physics, "source": effect.source})
    return found


def unexplained(d: Diagnosis) -> dict[str, Any]:
    """Where the remainder lives, in no effect's name."""
    f = d.final or d.fitted
    rows = panels.terms(d.terms(), d.after.rms_Eo)
    return {
        "share": numbers.percent(d.remainder_share),
        "p": numbers.probability(d.remainder.log_p),
        "terms": rows,
        "figures": page.figures(panels.remainder_figures(f, d.coefficients, rows, "remainder")),
    }


def sizes(d: Diagnosis) -> list[tuple[str, list[str]]]:
    """(effect, size of each parameter at which this record would show it at three sigma)."""
    found: dict[str, list[str]] = {}
    for s in d.sizes:
        text = f"{s.name} = {numbers.with_unit(numbers.number(s.size), s.unit)}"
        found.setdefault(s.effect, []).append(text)
    return list(found.items())


def _panels(d: Diagnosis) -> list[dict[str, Any]]:
    before = d.residual if d.after != d.before else None
    return [panels.demodulated_panel(d.target, d.residual_after, before), *panels.own_effect_panel(d)]


def _sections(d: Diagnosis) -> list[dict[str, Any]]:
    f = d.final or d.fitted
    chosen = series.worst(d.fitted, d.residual, panels.FLIGHTS)
    changed = d.after != d.before
    if changed:
        lines = [(figures.BEFORE, d.residual), (figures.AFTER, d.residual_after)]
    else:
        lines = [(figures.ONLY, d.residual)]
    drawn = []
    if spectra := panels.spectrum_panels(f, lines, chosen):
        what = "before and after" if changed else "of the model as it is"
        svg = figures.spectra(spectra, "spectrum", f"spectrum of the residual {what}")
        caption = (
            f"Amplitude density of the residual {what}, and the noise. Dotted: multiples of the spin rate."
        )
        drawn.append(page.figure(svg, caption))
    svg = figures.in_blocks(panels.time_panels(f, lines, chosen), "blocks", "error in blocks of time")
    caption = "Error in 24 blocks of time before demodulation."
    if any(o.thin is not None for o in f.observations):
        caption += " Of a thinned flight, and its noise, what lies below half of the rate that is left."
    if len(chosen) < len(f.prepared):
        caption += f" The {len(chosen)} worst of {len(f.prepared)} flights are drawn."
    drawn.append(page.figure(svg, caption))
    title = "The residual before and after" if changed else "The residual"
    return [{"title": title, "text": [], "figures": drawn}]


Array = NDArray[np.float64]

MOST = 6
"""Values that a row of the ranking holds, the most significant ones."""


@dataclass(frozen=True)
class Value:
    """``name`` of accelerometer or combination ``of`` (empty: shared), with unit, and its significance."""

    name: str
    of: str
    text: str
    z: float


@dataclass(frozen=True)
class Values:
    """What a row shows: values, how many more there are, and accelerometers that would do as well."""

    values: tuple[Value, ...]
    more: int
    instead: tuple[Value, ...]


def values(f: Fitted, r: Ranked) -> Values:
    """The values of a ranked effect."""
    columns = [(n, c) for n, c in enumerate(f.candidates) if c.effect == r.effect]
    wanted = {(p.name, p.accelerometer) for p in r.parameters}
    own = [(n, c) for n, c in columns if (_name(c), c.accelerometer) in wanted]
    extra = [
        _plain(p.name, p.value, p.unit) for p in r.parameters if p.name not in {_name(c) for _, c in own}
    ]
    if not own:
        return Values(tuple(extra), 0, ())
    accelerometers = {c.accelerometer for _, c in own}
    if len(accelerometers) == 1 and None not in accelerometers:
        found = _single(f, own)
        others = other_accelerometers(f, r.effect, own, columns)
        return Values((*found, *extra), 0, tuple(v for block in others for v in _single(f, block)))
    found = _combined(f, own, _fit(f, own))
    kept = sorted(found, key=lambda v: -abs(v.z))[:MOST]
    return Values((*kept, *extra), len(found) - len(kept), ())


def headlines(
    parameters: Sequence[ParameterValue], combinations: Sequence[ParameterValue]
) -> tuple[Value, ...]:
    """One value per parameter, the same numbers as on the terminal and in the JSON."""
    return tuple(_headline(q) for q in of_parameters(parameters, combinations))


def _headline(q: ParameterValue) -> Value:
    of, _, name = q.name.rpartition(" ")
    if q.std <= 0.0:
        return _plain(name, q.value, q.unit)
    of = of.replace("Sigma", "Σ") or q.accelerometer_name
    text = numbers.with_unit(numbers.plus_minus(q.value, q.std), q.unit)
    return Value(name, of, text, q.value / q.std)


def _plain(name: str, value: float, unit: str) -> Value:
    return Value(name, "", numbers.with_unit(numbers.number(value, 4), unit), 0.0)


def _fit(f: Fitted, own: Sequence[tuple[int, Column]]) -> Posterior:
    """Values of an effect's columns, in scales, with their uncertainty."""
    both = posterior(f, [n for n, _ in own])
    return both.of(range(f.n_base, f.n_base + len(own)))


def joint(f: Fitted, effect: str) -> list[Value]:
    """The values of an effect that is in the model of ``f``, as calibrated."""
    places = [k for k, c in enumerate(f.calibration.columns) if c.effect == effect]
    own = [(k, f.calibration.columns[k]) for k in places]
    scale = np.array([c.scale for _, c in own])
    value = f.calibration.p[f.calibration.index[places]] / scale
    return _combined(f, own, Posterior(value, posterior(f).of(places).covariance))


def _single(f: Fitted, own: Sequence[tuple[int, Column]]) -> list[Value]:
    fitted = _fit(f, own)
    return [_value(c, c.accelerometer_name, np.eye(len(own))[k], fitted) for k, (_, c) in enumerate(own)]


def _value(c: Column, of: str, weights: Array, fitted: Posterior) -> Value:
    factor = c.scale / c.unit_factor
    v, s = float(weights @ fitted.value), fitted.std(weights)
    text = numbers.with_unit(numbers.plus_minus(v * factor, s * factor), c.unit)
    return Value(_name(c), of, text, v / s if s > 0.0 else 0.0)


def _combined(f: Fitted, own: Sequence[tuple[int, Column]], fitted: Posterior) -> list[Value]:
    """Combinations that the record sees of parameters of all four; others one by one unless they are unseen."""
    places: dict[str, list[int]] = {}
    for k, (_, c) in enumerate(own):
        places.setdefault(_name(c), []).append(k)
    found = []
    for positions in places.values():
        column = own[positions[0]][1]
        rows: list[tuple[str, Array, float]] = []
        if len(positions) == 4 and f.instrument.layout.like_paper:
            for name, signs in PATTERNS:
                w = np.zeros(len(own))
                w[positions] = np.array(signs) * gains(f.model, f.calibration.p, column.name)
                rows.append((name, w, SEEN))
        else:
            for k in positions:
                rows.append((own[k][1].accelerometer_name, np.eye(len(own))[k], UNSEEN))
        for of, w, limit in rows:
            if fitted.std(w) < limit * float(np.linalg.norm(w)):
                found.append(_value(column, of, w, fitted))
    return found
