"""Are the promises of a motion to fly next kept? Each is flown in the reference, beside the flight that asked for it.

python -m benchmarks.promises [--cases N] [--first SEED] [--design multisine|sinusoid] [--json FILE]

A case: a random instrument and flight of ten minutes, one effect hidden in it, of 10 to 300 sigma, in one accelerometer or in all.
Its rivals are the three effects that imitate it best there. For these a motion is designed from the flight alone, the only thing
that the design sees; then it is flown, without turbulence, by the same true instrument with the same effect. *Flown* is what the
reference's own effect (with less without it, noise left out), whitened with the noise that the fit of both flights estimates, has
beyond the model's parameters and the rival's on both flights: the mean significance, in sigma, with which the rival is ruled out.
A case counts by its promises of 3 sigma and more. The promise is kept if the median of flown to promised is 0.8 to 1.25.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted, about, fit
from ragg_runtime.estimation.observation import Observation, observations_of
from ragg_runtime.estimation.regressors import EFFECT_PRIOR, Point, grouped, residual_of
from ragg_runtime.identification import motion_design, next_motion
from ragg_runtime.identification.selection import Field, field_of, testable_effects
from ragg_runtime.io import Flight
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.effects import CATALOGUE, EffectValues
from ragg_runtime.reference.motion import Motion, Sinusoids
from ragg_runtime.reference.scenario import Scenario, scenario

Array = NDArray[np.float64]
Sinusoid = tuple[str, float, float, float]
Promise = tuple[str, str, float, float]
"""Effect, rival, separation now and promised."""

FIRST, CASES = 7001, 50
STRENGTHS = (10.0, 30.0, 100.0, 300.0)
LARGEST = 30.0
"""Plausible sizes beyond which no effect is hidden."""

RIVALS = 3
LEAST = 3.0
"""Sigma from which a promise counts."""

NEVER = ("disc-spin", "second-order-misalignment", "arm-length")
"""Nature knows them at one size alone, or the simulator has them always."""


def case(
    seed: int, designs: Mapping[str, Callable[..., Iterator[tuple[Sequence[Sinusoid], Sequence[Promise]]]]]
):
    """The lines of one case: a promise each, with what was flown."""
    rng = np.random.default_rng([seed, 1])
    s = scenario(
        seed,
        duration=600.0,
        trim="matched" if seed % 2 else "table-v",
        noise_density=float(rng.choice([1e-9, 2e-9, 5e-9])),
        red_corner=float(rng.choice([0.02, 0.1])),
    )
    hidden = drawn(s, rng)
    if hidden is None:
        return
    effect, values, strength = hidden
    f = fitted(s, s.simulate({effect: values}).flight())
    field = field_of(f, testable_effects(f))
    pairs = [(effect, r) for r in rivals(field, effect)]
    for name, make in designs.items():
        for sinusoids, promises in make(f, field, pairs):
            shown = flown(s, sinusoids, {effect: values})
            for e, r, now, then in promises:
                if e == effect:
                    yield {
                        "seed": seed,
                        "design": name,
                        "effect": e,
                        "rival": r,
                        "strength": strength,
                        "now": now,
                        "promised": then,
                        "flown": shown(r),
                    }


def drawn(s: Scenario, rng: np.random.Generator) -> tuple[str, dict[str, list[float] | float], float] | None:
    """An effect, its parameters, SI, and its strength, sigma, beyond what a calibration takes for it."""
    f = fitted(s, s.simulate().flight())
    field = field_of(f, [e for e in testable_effects(f) if e not in NEVER])
    for _ in range(60):
        effect = str(rng.choice(sorted(field.candidates)))
        strength = float(rng.choice(STRENGTHS))
        own = [(n, c) for n, c in field.candidates[effect] if c.name.split(".")[1] in CATALOGUE[effect]]
        names = sorted({c.name for _, c in own})
        name = str(rng.choice(names)) if names else ""
        own = [(n, c) for n, c in own if c.name == name]
        if len(own) > 1 and rng.random() < 0.5:
            own = [own[int(rng.integers(len(own)))]]
        if not own:
            continue
        w = np.abs(rng.standard_normal(len(own)))
        size = strength / float(np.linalg.norm(field.P[:, [n for n, _ in own]] @ w))
        if not np.max(w) * size * EFFECT_PRIOR < LARGEST:
            continue
        values: dict[str, list[float] | float] = {}
        for x, (_, c) in zip(w * size, own, strict=True):
            if c.accelerometer is None:
                values[name.split(".")[1]] = float(x * c.scale)
            else:
                four = values.setdefault(name.split(".")[1], [0.0] * 4)
                assert isinstance(four, list)
                four[c.accelerometer - 1] = float(x * c.scale)
        return effect, values, strength
    return None


def fitted(s: Scenario, *flights: Flight) -> Fitted:
    return fit(packaged(), s.sheet, observations_of(flights, s.sheet))


def rivals(field: Field, effect: str) -> list[str]:
    """Those that imitate an effect best."""
    tests = field.tests()
    others = sorted((-t.chi2, e) for e, t in tests.items() if e != effect and t.rank)
    return [e for _, e in others[:RIVALS]]


def flown(s: Scenario, sinusoids: Sequence[Sinusoid], effects: EffectValues) -> Callable[[str], float]:
    """Fly sinusoids about the mean of a flight; of a rival, how many sigma it is ruled out by both flights."""
    t = np.arange(int(s.duration * s.rate)) / s.rate
    parts = {}
    for group in ("a", "omega"):
        for k, signal in zip("xyz", getattr(s.motion, group), strict=True):
            own = [x for x in sinusoids if x[0] == f"{group}_{k}"]
            parts[f"{group}_{k}"] = Sinusoids(
                float(np.mean(signal.value(t))), [x[2] for x in own], [x[1] for x in own], [x[3] for x in own]
            )
    x, y, z, wx, wy, wz = (parts[n] for n in next_motion.AXES)
    other = replace(s, motion=Motion((x, y, z), (wx, wy, wz)), seed=s.seed + 100_000)
    runs = [(w.simulate(effects), w.simulate()) for w in (s, other)]
    both = fitted(s, *(a.flight() for a, _ in runs))
    at = Point(both.model, both.instrument, both.calibration.p, False)
    clean: list[Observation] = []
    for k, (with_it, without) in enumerate(runs):
        a, b = (
            observations_of([replace(q.flight(), outputs=dict(q.outputs_noise_free))], s.sheet)[0]
            for q in (with_it, without)
        )
        rest = residual_of(at, b)
        clean.append(replace(a, series=tuple(np.atleast_2d(a.data - rest)), flight=k))
    signal = about(both.model, both.instrument, clean, both.calibration)
    n = both.n_base
    columns = grouped(both.candidates)

    def shown(rival: str) -> float:
        picked = [*range(n), *(n + k for k, _ in columns[rival]), -1]
        rows = signal.data[:, picked]
        prior = np.eye(n, rows.shape[1])
        return float(abs(np.linalg.qr(np.vstack([rows, prior]), mode="r")[-1, -1]))

    return shown


def multisine(f: Fitted, field: Field, pairs: Sequence[tuple[str, str]]):
    made = motion_design.design(f, pairs, next_motion.LIMITS, duration=600.0, band=(0.0, 2.0))
    if made is not None:
        yield made.sinusoids, [(x.effect, x.rival, x.now, x.then) for x in made.separations]


def sinusoid(f: Fitted, field: Field, pairs: Sequence[tuple[str, str]]):
    for p in next_motion.proposals(f, field, pairs):
        s = p.separation
        yield [p.sinusoid], [(s.effect, s.rival, s.now, s.then)]


DESIGNS = {"multisine": multisine, "sinusoid": sinusoid}


def summary(lines: Sequence[Mapping[str, float | str]]) -> Iterator[str]:
    """A line a design: how many promises, and the median and quartiles of flown to promised."""
    for name in DESIGNS:
        own = [x for x in lines if x["design"] == name]
        some = [x for x in own if float(x["promised"]) >= LEAST]
        if not some:
            continue
        by_case: dict[float, list[float]] = {}
        for x in some:
            by_case.setdefault(float(x["seed"]), []).append(float(x["flown"]) / float(x["promised"]))
        ratios = np.array([np.median(v) for v in by_case.values()])
        low, middle, high = np.quantile(ratios, [0.25, 0.5, 0.75])
        within = np.mean((ratios > 0.5) & (ratios < 2.0))
        silent = [float(x["flown"]) for x in own if float(x["promised"]) < LEAST]
        yield (
            f"{name}: {len(ratios)} cases, {len(some)} promises, flown / promised {middle:.2f} ({low:.2f} to {high:.2f}),"
            f" {100 * within:.0f} % within a factor of two; of {len(silent)} below {LEAST:g} sigma"
            f" {sum(x > 2 * LEAST for x in silent)} show more than {2 * LEAST:g}"
        )


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.promises")
    parser.add_argument("--cases", type=int, default=CASES)
    parser.add_argument("--first", type=int, default=FIRST)
    parser.add_argument("--design", choices=list(DESIGNS), action="append")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    designs = {n: DESIGNS[n] for n in options.design or DESIGNS}
    lines = []
    for seed in range(options.first, options.first + options.cases):
        begin = time.process_time()
        for x in case(seed, designs):
            lines.append(x)
            print(" ".join(f"{v:.4g}" if isinstance(v, float) else str(v) for v in x.values()), flush=True)
        print(f"  {seed}: {time.process_time() - begin:.1f} s", file=sys.stderr)
    if options.json is not None:
        options.json.write_text(json.dumps(lines, indent=0), "utf-8")
    print("\n".join(summary(lines)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
