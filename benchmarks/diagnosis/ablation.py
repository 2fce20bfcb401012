"""What each rule of the diagnosis is worth: the same 40 flights with it and without it.

A rule is switched off by putting something neutral in the place of a function or a constant of today's code. Flights: 20 of the kinds
that the rule was written for, and the same 20 of all kinds for every rule. With the rules on, each flight is flown once, and watched:
where a rule's function returns what the neutral one would, it does nothing on that flight, which then is not flown without it.
"""

from __future__ import annotations

import importlib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.diagnosis import plan, score
from benchmarks.diagnosis.fly import fly
from benchmarks.diagnosis.plan import Spec
from benchmarks.diagnosis.score import Row
from ragg_runtime.identification.uneven import Scatter

Array = NDArray[np.float64]
HALF = 20

Kinds = tuple[tuple[str, str], ...]

ALL: Kinds = (
    ("quiet", "white"),
    ("outside", "white"),
    ("five", "white"),
    ("ten", "red"),
    ("pair", "white"),
    ("strong", "red"),
    ("off-sheet", "white"),
    ("quiet", "elsewhere"),
    ("outside", "red"),
    ("ten", "elsewhere"),
)
"""Kinds of the flights that every rule is tried on."""

STRONG: Kinds = (("strong", "white"), ("strong", "red"), ("pair", "white"), ("pair", "red"))
WEAK: Kinds = (("ten", "white"), ("pair", "white"), ("five", "red"), ("outside", "white"))
OUTSIDE: Kinds = (("outside", "white"), ("outside", "red"))
OFF: Kinds = (("off-sheet", "white"), ("off-sheet", "red"))


def quiet(*names: str) -> Kinds:
    return tuple(("quiet", n) for n in names)


@dataclass(frozen=True)
class Patch:
    """A name of the runtime (``estimation.noise_estimate:_level``), and what takes its place.

    ``neutral`` is called with what the function is called with; if ``constant``, it is the value. ``acts``: whether what the function
    returned is not neutral (default: it differs from what ``neutral`` returns).
    """

    name: str
    neutral: Any
    constant: bool = False
    acts: Callable[[Any], bool] | None = None

    @property
    def place(self) -> tuple[Any, str]:
        module, _, path = self.name.partition(":")
        owner: Any = importlib.import_module(f"ragg_runtime.{module}")
        *outer, name = path.split(".")
        for n in outer:
            owner = getattr(owner, n)
        getattr(owner, name)
        return owner, name

    @property
    def there(self) -> bool:
        """Whether the code still has it."""
        try:
            return bool(self.place)
        except (ImportError, AttributeError):
            return False

    @contextmanager
    def put(self, make: Callable[[Any], Any]) -> Iterator[None]:
        """With what ``make`` makes of the original in its place."""
        owner, name = self.place
        original = owner.__dict__[name] if isinstance(owner, type) else getattr(owner, name)
        setattr(owner, name, make(original))
        try:
            yield
        finally:
            setattr(owner, name, original)

    def did(self, result: Any, args: Any, kwargs: Any) -> bool:
        """Whether what the function returned is not neutral."""
        if self.acts is not None:
            return self.acts(result)
        other = self.neutral(*args, **kwargs)
        try:
            return result is not other and not bool(result == other)
        except (ValueError, TypeError):  # arrays
            return True


@dataclass(frozen=True)
class Rule:
    """A rule: what it does in a sentence, kinds of flights it was written for, how to switch it off."""

    id: str
    sentence: str
    kinds: Kinds
    patches: tuple[Patch, ...]


def _first(*args: Any) -> Any:
    return args[0]


def _nothing(*args: Any, **kwargs: Any) -> None:
    return None


def _empty(*args: Any, **kwargs: Any) -> list[Any]:
    return []


def _true(*args: Any, **kwargs: Any) -> bool:
    return True


def _false(*args: Any, **kwargs: Any) -> bool:
    return False


def _significant(x: Any) -> bool:
    from ragg_runtime.identification import omnibus

    return x is not None and x[0] < np.log(omnibus.FAMILY)


def _level(*args: Any) -> Any:
    from ragg_runtime.estimation.noise import Level

    return Level()


# fmt: off
RULES: tuple[Rule, ...] = (
    Rule("line-rival", "a line beside a multiple of the spin rate in the place of an effect",
         (*quiet("near-line"), ("ten", "white"), ("quiet", "spin-off")),
         (Patch("identification.verdict:find_line_rival", lambda *a: (None, ()), acts=lambda r: r[0] is not None or bool(r[1])),)),
    Rule("jumps", "jumps of the output are fitted beside the columns before the noise is estimated",
         (*quiet("jump"), ("ten", "red"), ("five", "white")),
         (Patch("estimation.residual:_find_best_jump", _nothing),)),
    Rule("lines", "lines of the output are fitted beside the columns before the noise is estimated",
         (*quiet("line", "mains"), ("outside", "white")),
         (Patch("estimation.residual:find_lines", _empty),)),
    Rule("noise-level", "the noise's level follows time, motion or angle",
         (*quiet("ramp", "along-axes", "with-ax", "with-size", "cyclic"), ("ten", "along-axes"), ("ten", "ramp")),
         (Patch("estimation.noise_estimate:_level", _level, acts=lambda r: bool(r.parts)),)),
    Rule("uneven", "where the level changes, tests are tempered by the variance of their scores",
         (*quiet("red-along-axes", "size-and-temperature", "heavy-with-size", "amplifier"), ("ten", "along-axes"), ("five", "with-size")),
         (Patch("identification.selection:uneven.temper_test", _first, acts=lambda r: r.inflation > 1.0),
          Patch("identification.omnibus:Scores.measure_scatter",
                lambda self, places: Scatter(np.ones(len(places)), np.full(len(places), np.inf))),)),
    Rule("off-sheet", "priors are widened where the record requires it",
         (*OFF, ("ten", "elsewhere")),
         (Patch("estimation.fitted:widen_priors", _nothing),)),
    Rule("time-varying", "generic terms that come and go",
         (*OUTSIDE, ("quiet", "ramp")),
         (Patch("identification.omnibus:_find_varying", _nothing, acts=_significant),)),
    Rule("spectral-line", "a line in the spectrum of what is left",
         (*OUTSIDE, *quiet("line", "mains")),
         (Patch("identification.omnibus:_find_line", _nothing, acts=_significant),)),
    Rule("nonlinear-selection", "strong effects are derived into the model one after the other",
         STRONG,
         (Patch("identification.strong:STRONG", np.inf, constant=True, acts=_false),)),
    Rule("contenders", "of a strong effect up to three contenders are fitted in the model",
         STRONG,
         (Patch("identification.strong:CONTENDERS", 1, constant=True),)),
    Rule("impossible", "an effect that is possible at one size only is excluded at another",
         (*OUTSIDE, ("off-sheet", "white"), ("strong", "white")),
         (Patch("identification.strong:find_impossible", lambda *a: ()),)),
    Rule("swap", "after each addition a chosen effect may be swapped for a better one",
         (("pair", "white"), ("pair", "red"), ("pair", "elsewhere"), ("outside", "white")),
         (Patch("identification.selection:_swap", lambda f, chosen, blocks: blocks),)),
    Rule("switching", "samples at which a switch's side is open, and the ends of late motion, are left out",
         (("strong", "white"), ("ten", "white"), ("pair", "elsewhere")),
         (Patch("estimation.fitted:leave_out_uncertain", lambda m, i, o: list(o)),)),
    Rule("step-instant", "the instant of a step is refined to the sample, through the filter",
         (("ten", "white"), ("strong", "red"), *quiet("jump")),
         (Patch("identification.steps:_refine", lambda f, step, *a: step),
          Patch("identification.steps:_sharpen", lambda f, step, *a: step),)),
    Rule("shared-noise", "voltages are whitened in their principal components",
         (("ten", "voltages"), ("quiet", "voltages"), ("pair", "voltages")),
         (Patch("estimation.noise_estimate:_find_principal_components", _nothing),)),
    Rule("loud", "a residual above its noise is unexplained",
         (*OUTSIDE, *quiet("sensors-1-mg", "clock-set")),
         (Patch("identification.comparison:exceeds_noise", _false, acts=bool),)),
    Rule("explains-nothing", "a model that explains no more than its parameters would of noise",
         quiet("shuffled", "pure-noise"),
         (Patch("identification.comparison:Explained.complaint", None, constant=True),)),
    Rule("filled-in", "values that are stuck, or were filled in between recorded ones, are left out",
         quiet("stuck", "coarse", "digits"),
         (Patch("screening.screen:leave_out_repeated", _first),)),
    Rule("motion-noise", "the noise of motion sensors is smoothed",
         quiet("sensors-1-mg", "sensors-0.5-mg", "noisy-sensors"),
         (Patch("screening.screen:smooth_noisy_motion", lambda model, instrument, flight, place: flight),)),
    Rule("raised", "beside smoothed motion no density counts as less than that in the middle of the spectrum",
         quiet("sensors-1-mg", "sensors-0.5-mg", "noisy-sensors"),
         (Patch("estimation.spectrum:Spectrum.raise_floor", lambda self: self),)),
    Rule("clock", "steps of the recorder's clock are found and undone",
         quiet("rounded-stamps", "uneven-stamps", "clock-set", "from-2-s", "from-10-s"),
         (Patch("screening.screen:_with_right_clock", lambda model, instrument, s: s.flight),)),
    Rule("mistakes", "mistakes of units, signs, axes and order are tried",
         (*quiet("clock-set", "codes", "stuck", "from-10-s"), *OFF),
         (Patch("screening.screen:find_mistake", _nothing),)),
    Rule("timing-search", "a spin rate, a phase or a shift in time is searched for as a mistake",
         (*quiet("clock-set", "clock-50-ppm", "from-10-s"), ("strong", "white")),
         (Patch("screening.timing:propose_times", _empty),)),
    Rule("output-spikes", "spikes of the output are marked",
         quiet("spikes", "codes", "heavy-tails", "stuck"),
         (Patch("screening.screen:_without_output_spikes", lambda model, instrument, s, flight: flight),)),
    Rule("motion-spikes", "spikes of the motion record are marked and interpolated",
         quiet("codes", "stuck", "recorded-motion", "sensors-1-mg"),
         (Patch("screening.screen:leave_out_glitches", _first),)),
    Rule("claims-ratio", "beside a remainder claims explain plainly more than generic terms do",
         (*OUTSIDE, ("off-sheet", "red"), ("strong", "white")),
         (Patch("identification.claims:MORE", 0.0, constant=True),)),
    Rule("claims-beside", "claims beside a remainder at all",
         (*OUTSIDE, ("off-sheet", "red"), ("strong", "white")),
         (Patch("identification.claims:MORE", np.inf, constant=True),)),
    Rule("claims-evidence", "the log evidence of claims is ahead of that of generic terms",
         (*OUTSIDE, ("five", "white"), ("pair", "red")),
         (Patch("identification.verdict:GenericTerms._measure_lead", lambda *a: 1e6, acts=lambda r: r < 10.0),)),
    Rule("strong-term", "the model is fitted again beside a strong generic term, in the place of several effects",
         (*OUTSIDE, ("pair", "white"), ("strong", "white")),
         (Patch("identification.verdict:GenericTerms._weigh_strong_term", lambda *a: -np.inf, acts=np.isfinite),)),
    Rule("sheet-as-said", "effects beside a sheet as sure as it says compete with a sheet that is less sure",
         (*WEAK, *OFF, *quiet("white", "red")),
         (Patch("identification.strong:_with_priors_of_sheet", _nothing, acts=lambda r: r is not None),)),
    Rule("needed", "which coefficients a strong effect needs is seen about the values of a fit",
         (*STRONG,),
         (Patch("identification.strong:_test_about_values", lambda f: {}),)),
    Rule("settled", "columns of effects that are chosen together are each the best beside those of the others",
         (("pair", "white"), ("pair", "red"), ("pair", "bump")),
         (Patch("identification.selection:_settle_blocks", lambda f, blocks: blocks),)),
    Rule("extrapolated", "ends that a model with derivatives does not fit are left out",
         (("strong", "4-Hz"), ("ten", "4-Hz")),
         (Patch("estimation.fitted:leave_out_extrapolated", lambda model, p, observations: list(observations)),)),
    Rule("one-kind", "special cases of one effect are not claimed together",
         (*OUTSIDE, ("ten", "white"), ("pair", "white")),
         (Patch("identification.verdict:_find_common_kind", _nothing, acts=lambda r: r is not None),)),
    Rule("better-kind", "an effect that only its name adds, and that explains more than its special case, is named",
         (("outside", "white"), ("outside", "ramp")),
         (Patch("identification.verdict:_find_better_kind", _nothing, acts=lambda r: r is not None),)),
    Rule("held-out", "held-out blocks do not speak against a claim",
         (*OUTSIDE, ("five", "white"), ("quiet", "ramp")),
         (Patch("identification.claims:weigh_held_out", lambda x, e: 0.0, acts=lambda r: r < -4.5),)),
    Rule("robust", "a claim is significant with the variance that its scores tell",
         (*OUTSIDE, *quiet("with-ax", "along-axes", "ramp"), ("five", "along-axes")),
         (Patch("identification.verdict:_is_significant", _true, acts=lambda r: not r),)),
    Rule("spread", "beside a remainder generic terms have Gaussian coefficients of one fitted variance",
         (*OUTSIDE, ("off-sheet", "red"), ("strong", "white")),
         (Patch("identification.claims:measure_spread", lambda left: 1.0),)),
    Rule("second-order", "what an effect explains is what it explains to first order, but for some per cent",
         (*STRONG, *OUTSIDE),
         (Patch("identification.search:SECOND_ORDER", np.inf, constant=True),)),
    Rule("effective-number", "effects that are alike count as fewer tests",
         (*WEAK, *quiet("ramp", "along-axes")),
         (Patch("identification.selection:ProjectedProblem.effective_count", property(lambda f: float(max(f.count, 1))), constant=True),)),
    Rule("carrier", "the noise's spectrum is resolved at one and two turns of the disc",
         (*quiet("bump", "line"), ("ten", "bump")),
         (Patch("estimation.spectrum:_list_humps", lambda spin: [()], constant=True),)),
    Rule("random-walk", "a spectrum that rises to low frequencies is one of 1/f to 1/f^2 beside white noise",
         (*quiet("walk"), ("ten", "walk"), ("five", "red")),
         (Patch("estimation.spectrum:EXPONENTS", (1.0,), constant=True),)),
)
# fmt: on


def flights(rule: Rule) -> list[Spec]:
    """The 40 flights of a rule."""
    own = [replace(s, index=s.index + 100) for s in plan.ablation(rule.kinds, HALF)]
    return [*own, *plan.ablation(ALL, HALF)]


@contextmanager
def watching(acted: set[str]) -> Iterator[None]:
    """With all rules on; those that do anything are put into ``acted``."""

    def watched(rule: Rule, p: Patch, original: Any) -> Callable[..., Any]:
        def call(*a: Any, **k: Any) -> Any:
            result = original(*a, **k)
            if rule.id not in acted and p.did(result, a, k):
                acted.add(rule.id)
            return result

        return call

    with ExitStack() as stack:
        for rule, p in ((r, p) for r in RULES for p in r.patches):
            if p.constant:
                acted.add(rule.id)
            else:
                stack.enter_context(p.put(partial(watched, rule, p)))
        yield


def watched(spec: Spec) -> dict[str, Any]:
    """The line of a flight with all rules on, and which of them did anything."""
    acted: set[str] = set()
    with watching(acted):
        found = fly(spec)
    return found | {"acted": sorted(acted)}


def without(rule: str, spec: Spec) -> dict[str, Any]:
    """The line of a flight with a rule switched off."""
    with ExitStack() as stack:
        for p in next(r for r in RULES if r.id == rule).patches:
            stack.enter_context(p.put(lambda original, p=p: p.neutral))  # type: ignore[misc]
        return fly(spec)


def acts(rule: Rule, line: Mapping[str, Any]) -> bool:
    return rule.id in line["acted"]


def row(rule: Rule, specs: Sequence[Spec], lines: Mapping[str, Any]) -> Row:
    """What changes without a rule."""
    on = [lines[f"/{s.id}"] for s in specs]
    off = [lines[f"{rule.id}/{s.id}"] if acts(rule, x) else x for s, x in zip(specs, on, strict=True)]
    outcomes = [(score.outcome(a), score.outcome(b)) for a, b in zip(on, off, strict=True)]
    change = np.array([score.WORTH[b] - score.WORTH[a] for a, b in outcomes])
    moved = Counter(f"{a} to {b}" for a, b in outcomes if a != b)
    flown = [(a, b) for a, b in zip(on, off, strict=True) if a is not b]
    time = [sum(pair[side].get("cpu", 0.0) for pair in flown) for side in (0, 1)]
    return {
        "rule": rule.id,
        "sentence": rule.sentence,
        "kinds": ", ".join(f"{k} {r}" for k, r in rule.kinds),
        "acts": f"{len(flown)} of {len(on)}",
        "worse": str(int(np.sum(change < 0))),
        "better": str(int(np.sum(change > 0))),
        "other": str(moved.total() - int(np.sum(change != 0))),
        "change": score.mean_change(outcomes),
        "time": f"{time[0]:.0f} s to {time[1]:.0f} s",
        "moved": ", ".join(f"{n} {m}" for m, n in sorted(moved.items())),
        "commit": str(on[0]["commit"]),
    }
