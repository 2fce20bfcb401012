"""What each rule of the diagnosis is worth: the same 40 flights with it and without it.

A rule is switched off by putting something neutral in the place of a function or a constant of today's code. Flights: 20 of the kinds
that the rule was written for, by id those that are known to be lost without it, and the same 20 of all kinds for every rule, flown once.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

import numpy as np

from benchmarks.diagnosis import plan, score
from benchmarks.diagnosis.fly import fly
from benchmarks.diagnosis.plan import Spec
from benchmarks.diagnosis.score import Line
from ragg_runtime.estimation.likelihood_ratio import Scatter
from ragg_runtime.estimation.noise import Level

HALF = 20

# Kinds of the flights that every rule is tried on, and of their records
ALL = (
    "quiet white, outside white, five white, ten red, pair white, strong red, off-sheet white, "
    "quiet elsewhere, outside red, ten elsewhere"
)

STRONG = "strong white, strong red, pair white, pair red"
WEAK = "ten white, pair white, five red, outside white"
OUTSIDE = "outside white, outside red"
OFF = "off-sheet white, off-sheet red"


@dataclass(frozen=True)
class Rule:
    """A rule: what it does in a sentence, kinds of flights it was written for, and what takes the place of which name of the runtime."""

    id: str
    sentence: str
    kinds: str
    neutral: Mapping[str, Any]

    def flights(self) -> list[Spec]:
        """The 40 flights of a rule."""
        return [*_spread(self.kinds, 100), *_spread(ALL, 0)]


def _spread(kinds: str, first: int) -> list[Spec]:
    """Half of the flights: those that are named, and kinds in turn, from a number on."""
    names = kinds.split(", ")
    ids = (x.split("/") for x in names if "/" in x)
    known = [Spec(kind, record, int(n), int(sample)) for sample, kind, record, n in ids]
    pairs = [n.split() for n in names if "/" not in n]
    others = (Spec(*pairs[n % len(pairs)], first + n // len(pairs), plan.ABLATION) for n in range(HALF))
    return [*known, *others][:HALF]


def _always(value: Any) -> Callable[..., Any]:
    """A function of anything that returns a value."""
    return lambda *_, **__: value


def _first(x: Any, *_: Any) -> Any:
    """What goes in comes out."""
    return x


# fmt: off
RULES = (
    Rule("line-rival", "a line beside a multiple of the spin rate in the place of an effect",
         "quiet near-line, ten white, quiet spin-off", {"identification.verdict.find_line_rival": _always((None, ()))}),
    Rule("jumps", "jumps of the output are fitted beside the columns before the noise is estimated",
         "quiet jump, ten red, five white", {"estimation.spectrum._find_best_jump": _always(None)}),
    Rule("lines", "lines of the output are fitted beside the columns before the noise is estimated",
         "quiet line, quiet mains, outside white", {"estimation.spectrum.find_lines": lambda *a: []}),
    Rule("noise-level", "the noise's level follows time, motion or angle",
         "quiet ramp, quiet along-axes, quiet with-ax, quiet with-size, quiet cyclic, ten along-axes, ten ramp",
         {"estimation.noise_estimate._choose_level": lambda *a: Level()}),
    Rule("drift", "noise may be white noise, of a level that changes or not, upon a random walk",
         "quiet walk, quiet walk-and-heave, ten with-ax", {"estimation.noise_estimate._fit_drifts": lambda a, o, n, x: (n, 0.0)}),
    Rule("uneven", "where the level changes, tests are tempered by the variance of their scores",
         "quiet red-along-axes, quiet size-and-temperature, quiet heavy-with-size, quiet amplifier, ten along-axes, five with-size",
         {"estimation.likelihood_ratio.temper_test": _first,
          "identification.omnibus.Scores.measure_scatter":
              lambda self, places: Scatter(np.ones(len(places)), np.full(len(places), np.inf))}),
    Rule("off-sheet", "priors are widened where the record requires it",
         f"{OFF}, ten elsewhere", {"estimation.fitted.widen_priors": _always(None)}),
    Rule("time-varying", "generic terms that come and go",
         f"{OUTSIDE}, quiet ramp, 4412/outside/heavy-tails/013", {"identification.omnibus._find_varying": _always(None)}),
    Rule("nonlinear-selection", "strong effects are derived into the model one after the other",
         STRONG, {"identification.strong.STRONG": np.inf}),
    Rule("contenders", "of a strong effect up to three contenders are fitted in the model",
         STRONG, {"identification.strong.CONTENDERS": 1}),
    Rule("impossible", "an effect that is possible at one size only is excluded at another",
         f"{OUTSIDE}, off-sheet white, strong white, 4412/quiet/noiseless/097", {"identification.strong.find_impossible": _always(())}),
    Rule("sets", "after each addition the most probable set of as many effects takes the place of what is chosen",
         "pair white, pair red, pair elsewhere, outside white", {"identification.selection._choose_set": lambda f, chosen: chosen}),
    Rule("switching", "samples at which a switch's side is open, and the ends of late motion, are left out",
         "strong white, ten white, 4420/strong/white/078", {"estimation.fitted.leave_out_uncertain": lambda m, i, o: list(o)}),
    Rule("step-instant", "the instant of a step is refined to the sample, through the filter",
         "ten white, strong red, quiet jump", {"identification.steps._refine": lambda f, step, *a: step,
          "identification.steps._sharpen": lambda f, step, *a: step}),
    Rule("shared-noise", "voltages are whitened in their principal components",
         "ten voltages, quiet voltages, pair voltages", {"estimation.noise_estimate._find_principal_components": _always(None)}),
    Rule("loud", "a residual above its noise is unexplained",
         f"{OUTSIDE}, quiet sensors-1-mg, quiet clock-set", {"identification.comparison.exceeds_noise": _always(False)}),
    Rule("explains-nothing", "a model that explains no more than its parameters would of noise",
         "quiet shuffled, quiet pure-noise", {"identification.comparison.Explained.complaint": None}),
    Rule("filled-in", "values that are stuck, or were filled in between recorded ones, are left out",
         "quiet stuck, quiet coarse, quiet digits", {"screening.screen.leave_out_repeated": _first}),
    Rule("motion-noise", "the noise of motion sensors is smoothed",
         "quiet sensors-1-mg, quiet sensors-0.5-mg, quiet noisy-sensors", {"screening.screen.smooth_noisy_motion": lambda s: s.flight}),
    Rule("raised", "beside smoothed motion no density counts as less than that in the middle of the spectrum",
         "quiet sensors-1-mg, quiet sensors-0.5-mg, quiet noisy-sensors", {"estimation.spectrum.Spectrum.raise_floor": _first}),
    Rule("clock", "steps of the recorder's clock are found and undone",
         "quiet rounded-stamps, quiet uneven-stamps, quiet clock-set, quiet from-2-s, quiet from-10-s",
         {"screening.screen._correct_clock": lambda s: s.flight}),
    Rule("mistakes", "mistakes of units, signs, axes and order are tried",
         f"quiet clock-set, quiet codes, quiet stuck, quiet from-10-s, {OFF}", {"screening.screen.find_mistake": _always(None)}),
    Rule("timing-search", "a spin rate, a phase or a shift in time is searched for as a mistake",
         "quiet clock-set, quiet clock-50-ppm, quiet from-10-s, strong white", {"screening.timing.propose_times": lambda *a: []}),
    Rule("output-spikes", "spikes of the output are marked",
         "quiet spikes, quiet codes, quiet heavy-tails, quiet stuck", {"screening.screen._leave_out_spikes": lambda s, places: s.flight}),
    Rule("motion-spikes", "spikes of the motion record are marked and interpolated",
         "quiet codes, quiet stuck, quiet recorded-motion, quiet sensors-1-mg", {"screening.screen.leave_out_glitches": _first}),
    Rule("claims-ratio", "beside a remainder claims explain plainly more than generic terms do",
         f"{OUTSIDE}, off-sheet red, strong white, 4412/outside/4-Hz/018, 4412/outside/gaps/003", {"identification.claims.MORE": 0.0}),
    Rule("claims-beside", "claims beside a remainder at all",
         f"{OUTSIDE}, off-sheet red, strong white", {"identification.claims.MORE": np.inf}),
    Rule("claims-evidence", "the log evidence of claims is ahead of that of generic terms",
         f"{OUTSIDE}, five white, pair red", {"identification.verdict._measure_lead": _always(1e6)}),
    Rule("sheet-as-said", "effects beside a sheet as sure as it says compete with a sheet that is less sure",
         f"{WEAK}, {OFF}, 4412/pair/along-axes/008", {"identification.strong._with_priors_of_sheet": _always(None)}),
    Rule("needed", "which coefficients a strong effect needs is seen about the values of a fit",
         STRONG, {"identification.strong._test_about_values": _always({})}),
    Rule("settled", "columns of effects that are chosen together are each the best beside those of the others",
         "pair white, pair red, pair bump", {"identification.selection._settle_blocks": lambda f, blocks: blocks}),
    Rule("extrapolated", "ends that a model with derivatives does not fit are left out",
         "strong 4-Hz, ten 4-Hz, 4412/strong/4-Hz/002", {"estimation.fitted.leave_out_extrapolated": lambda m, p, o: list(o)}),
    Rule("better-kind", "an effect that only its name adds, and that explains more than its special case, is named",
         "outside white, outside ramp, 4412/outside/bump/023", {"identification.verdict._find_better_kind": _always(None)}),
    Rule("held-out", "held-out blocks do not speak against a claim",
         f"{OUTSIDE}, five white, quiet ramp, 4412/quiet/heavy-tails/064", {"identification.claims.weigh_held_out": _always(0.0)}),
    Rule("robust", "a claim is significant with the variance that its scores tell",
         f"{OUTSIDE}, quiet with-ax, quiet along-axes, quiet ramp, five along-axes, 4412/pair/elsewhere/016",
         {"identification.verdict._is_significant": _always(True)}),
    Rule("effective-number", "effects that are alike count as fewer tests",
         f"{WEAK}, quiet ramp, quiet along-axes",
         {"identification.selection.ProjectedProblem.effective_count": property(lambda f: float(max(f.count, 1)))}),
    Rule("carrier", "the noise's spectrum is resolved at one and two turns of the disc",
         "quiet bump, quiet line, ten bump", {"estimation.spectrum._list_humps": _always([()])}),
    Rule("random-walk", "a spectrum that rises to low frequencies is one of 1/f to 1/f^2 beside white noise",
         "quiet walk, ten walk, five red", {"estimation.spectrum.EXPONENTS": (1.0,)}),
)
# fmt: on


def without(rule: str, spec: Spec) -> dict[str, Any]:
    """The line of a flight with a rule switched off."""
    with ExitStack() as stack:
        for name, neutral in next(r for r in RULES if r.id == rule).neutral.items():
            stack.enter_context(patch(f"ragg_runtime.{name}", neutral))
        return fly(spec)


# Where a flight on which a rule acts differs without it
SAID = ("verdict", "found", "ranking", "unexplained", "error")


def row(rule: Rule, on: Sequence[Line], off: Sequence[Line]) -> dict[str, Any]:
    """What changes without a rule; lines of flights with it and without it."""
    pairs = [(score.outcome(a), score.outcome(b)) for a, b in zip(on, off, strict=True)]
    change = [score.WORTH[b] - score.WORTH[a] for a, b in pairs]
    moved = Counter(f"{a} to {b}" for a, b in pairs if a != b)
    time = [sum(x.get("cpu", 0.0) for x in lines) for lines in (on, off)]
    acts = sum(any(a.get(n) != b.get(n) for n in SAID) for a, b in zip(on, off, strict=True))
    return {
        "rule": rule.id,
        "sentence": rule.sentence,
        "kinds": rule.kinds,
        "acts": f"{acts} of {len(on)}",
        "worse": sum(c < 0 for c in change),
        "better": sum(c > 0 for c in change),
        "other": moved.total() - np.count_nonzero(change),
        "change": score.mean_change(pairs),
        "time": f"{time[0]:.0f} s to {time[1]:.0f} s",
        "moved": ", ".join(f"{n} {m}" for m, n in sorted(moved.items())),
        "commit": on[0]["commit"],
    }
