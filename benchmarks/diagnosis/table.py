"""The page docs/diagnosis.md, from the lines of the flights."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchmarks.diagnosis import plan, score
from benchmarks.diagnosis.score import OURS, Line, Peer, Share, of_kind, share

CAMPAIGNS = Path(__file__).with_name("campaigns.md")
"""What other campaigns measured, by hand; it stands at the end of the page."""

PEERS = ("stepwise BIC", "lasso (BIC)", "PySINDy (SSR)", "FROLS")


def page(lines: Sequence[Line], *, complete: bool, sample: int = 0) -> str:
    """The whole page, Markdown; deterministic in the lines, whatever their order."""
    lines = sorted(lines, key=lambda x: x["id"])
    note = "" if complete else f"\n**Incomplete: {len(lines)} flights.**\n"
    introduction = _INTRODUCTION + (_NOT_INDEPENDENT if sample == 0 else _sample(sample))
    sections = [introduction + note, _targets(lines), _peers(lines), _groups(lines), _calibration(lines)]
    sections += [_effects(lines), _outside(lines), _failures(lines), _conditions(lines, sample)]
    sections += [CAMPAIGNS.read_text("utf-8")] if sample == plan.PAGE else []
    return "\n".join(sections).rstrip() + "\n"


_INTRODUCTION = """# How well the diagnosis does

Written by `make bench-diagnosis` (`python -m benchmarks.diagnosis`); do not edit.

Flights of the independent numerical reference (it shares no equation with the derived models), diagnosed with
`ragg diagnose` as a user would. The strength of a hidden effect is the norm of its whitened signature
once all that the calibration absorbs is projected out: the significance, in standard deviations, that the best possible
test would find. It is measured on the effect-free flight of the same seed, in a random direction of the
effect's parameters (one accelerometer or all four); an effect that reaches it only beyond 30 plausible sizes
is untestable on that flight, and another one is drawn.
"""

_NOT_INDEPENDENT = """
**Not an independent sample.** A first run over these same flights gave 6 % false alarms, 94 % right at 10, 76 % at 5, both of two
in 40 of 40, 57 % unexplained of what is outside, and one search without end. The family rates of the tests, the spread of the noise at
low frequency and the terms of the remainder were then changed because of what it showed, and the flights flown again. The figures
below may therefore flatter; flights of other seeds (`--seed 1`) tell. The ridge of PySINDy was likewise chosen on two of
these flights.
"""


def _sample(sample: int) -> str:
    return (
        f"\n**A sample of its own** (`--seed {sample}`): none of its flights had been looked at when the code that is"
        " judged here was written.\n"
    )


def _percent(s: Share) -> str:
    low, high = s.interval()
    if not s.total:
        return "-"
    return (
        f"{s.hits} of {s.total} ({100 * s.value:.0f} %, 95 % interval {abs(100 * low):.0f}-{100 * high:.0f})"
    )


def _short(s: Share) -> str:
    return f"{100 * s.value:.0f} %" if s.total else "-"


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(r) + " |" for r in lines) + "\n"


def _targets(lines: Sequence[Line]) -> str:
    free, ten, five, two, out = (of_kind(lines, k, crashed=True) for k in plan.COUNTS)
    quiet = share(free, lambda x: not score.alarmed(x))
    alarms = Share(quiet.total - quiet.hits, quiet.total)
    hidden = of_kind(lines, "single-10", "single-5", "two")
    rows = [
        ["false alarms on effect-free flights", _percent(alarms), "at most 5 %"],
        ["right effect first, strength 10", _percent(share(ten, score.right_first)), "at least 95 %"],
        ["... and nothing else claimed", _percent(share(ten, score.right_alone)), ""],
        ["right effect first, strength 5", _percent(share(five, score.right_first)), "at least 80 %"],
        ["... and nothing else claimed", _percent(share(five, score.right_alone)), ""],
        ["both of two effects, strength 10 each", _percent(share(two, score.both)), "at least 85 %"],
        ["... and nothing else claimed", _percent(share(two, score.exactly_both)), ""],
        ["outside the catalogue: unexplained", _percent(share(out, score.unexplained)), "at least 90 %"],
    ]
    for which, name in ((0, "error after adding over the oracle's"), (1, "... on held-out time")):
        r = np.array(score.ratios(hidden, which))
        if len(r):
            over = int(np.sum(r > 1.02))
            text = f"median {np.median(r):.4f}, worst {np.max(r):.4f}, {over} of {len(r)} above 1.02"
            rows.append([name, text, "at most 1.02"])
    crashed = f"{len(score.crashes(lines))} of {len(lines)}"
    rows.append(["crashes", crashed, "none"])
    seconds = [x["seconds"] for x in lines if "seconds" in x]
    if seconds:
        text = f"median {np.median(seconds):.1f} s, longest {max(seconds):.1f} s"
        rows.append(
            [
                f"one diagnosis ({plan.DURATION:g} s at {plan.RATE:g} Hz; wall time, beside other work)",
                text,
                "",
            ]
        )
    return (
        f"## Against the targets ({len(lines)} flights)\n\n"
        + _table(["question", "measured", "target"], rows)
        + "\nRight means: the hidden effect ranks first, alone or in the group that the diagnosis says it cannot tell"
        "\napart, and is among what it would add. The oracle knows what is hidden, adds exactly that (a step at its true"
        "\ninstant) and calibrates on the same flight; the errors are those of `ragg compare`.\n"
    )


def _peers(lines: Sequence[Line]) -> str:
    free, ten, five = (of_kind(lines, k) for k in ("effect-free", "single-10", "single-5"))
    two, out = of_kind(lines, "two"), of_kind(lines, "outside")
    ten, five = [x for x in ten if score.is_column(x)], [x for x in five if score.is_column(x)]
    ours = [
        OURS,
        _short(share(free, score.alarmed)),
        *(_short(share(k, t)) for k in (ten, five) for t in (score.right_first, score.right_alone)),
        *(_short(share(two, t)) for t in (score.both, score.exactly_both)),
        _short(share(out, score.unexplained)),
        _mean([x["seconds"] for x in lines if "seconds" in x]),
    ]
    rows = [ours]
    for name in PEERS:
        p = Peer(name)
        rows.append(
            [
                name,
                _short(share(free, p.alarmed)),
                *(_short(share(k, t)) for k in (ten, five) for t in (p.right_first, p.right_alone)),
                *(_short(share(two, t)) for t in (p.both, p.exactly_both)),
                _short(share(out, p.claims_nothing)),
                _mean([x["peers"][name]["seconds"] for x in lines if "peers" in x]),
            ]
        )
    header = ["method", "false alarms", "right first at 10", "alone", "right first at 5", "alone"]
    header += ["both of two", "exactly both", "outside: names no effect", "s"]
    return (
        "## Beside what one would try instead\n\n"
        + _table(header, rows)
        + f"""
All methods see the same flights and the same candidate columns at the calibrated point ({_columns(lines)}, all rows),
among them the columns of gain-step at the instant that our scan found. For the others the base columns, and those of an unknown
gradient, are projected out by least squares beforehand: the calibration is done for them. They do not get the noise's
spectrum, which a user would not have either; white-noise BIC decides how many columns they take, none allowed. What no
method could tell from the hidden effect (a chi-square of less than 9 apart on the noise-free signature) counts as it.
Only effects that are columns are counted here ({len(ten)} and {len(five)} flights). None of them can say "unexplained":
naming no effect counts for them. Their seconds are those of the selection alone; ours include the calibration, the noise,
the derivation of the extended model and its nonlinear check.

- stepwise BIC: forward ordinary least squares.
- lasso: `sklearn.linear_model.LassoLarsIC(criterion="bic")`; effects ranked by coefficient.
- PySINDy: `SINDy(optimizer=SSR(alpha=10), feature_library=IdentityLibrary())` on the triangular factor of the columns (the same normal
  equations), its sparsity chosen by BIC. (`STLSQ` did worse: it begins with all columns at once, which are nearly collinear.)
- FROLS: `sysidentpy.model_structure_selection.FROLS`, degree 1, no lags, order by BIC.
"""
    )


def _columns(lines: Sequence[Line]) -> str:
    counts = [x["peer_columns"] for x in lines if "peer_columns" in x]
    if not counts:
        return "-"
    columns = [c for _, c in counts]
    return f"{min(columns)} to {max(columns)} columns, {counts[0][0]} rows"


def _mean(values: Sequence[float]) -> str:
    return f"{np.median(values):.2f}" if values else "-"


def _groups(lines: Sequence[Line]) -> str:
    rows = []
    for kind in ("single-10", "single-5"):
        right = [x for x in of_kind(lines, kind) if score.right_first(x)]
        sizes = Counter(score.group_size(x) for x in right)
        truly = Counter(1 + len(x["hidden"][0]["twins"]) for x in of_kind(lines, kind))
        rows.append([kind, _counted(sizes), _counted(truly)])
    return (
        "## Groups\n\n"
        + _table(
            ["flights", "size of the group named (flights)", "size of the group that no method can split"],
            rows,
        )
        + "\nThe second is computed from the noise-free signature: effects that explain it to within a chi-square of 9.\n"
    )


def _counted(c: Counter[int]) -> str:
    return ", ".join(f"{n} ({c[n]})" for n in sorted(c)) or "-"


def _calibration(lines: Sequence[Line]) -> str:
    free = of_kind(lines, "effect-free")
    if not free:
        return ""
    rows = []
    for name, p in (
        ("best effect of the catalogue", score.family_p),
        ("search of the remainder", score.remainder_p),
    ):
        values = np.array([p(x) for x in free])
        rows.append([name, *(f"{np.mean(values < limit):.3f}" for limit in (0.01, 0.05, 0.2, 0.5))])
    return (
        "## Are the p-values honest?\n\n"
        "Share of effect-free flights with a family-wise p-value below a level, which it should not exceed:\n\n"
        + _table(["test", "0.01", "0.05", "0.2", "0.5"], rows)
    )


def _effects(lines: Sequence[Line]) -> str:
    untestable: Counter[str] = Counter(
        e for x in lines for e in x.get("untestable", ()) if x["kind"].startswith("single")
    )
    kinds = ("single-10", "single-5", "two")
    found = score.by_effect(lines)
    rows = []
    for e in sorted({*found, *untestable}):
        cells = [found.get(e, {}).get(k) for k in kinds]
        rows.append(
            [f"`{e}`", *("-" if c is None else f"{c.hits} of {c.total}" for c in cells), str(untestable[e])]
        )
    return "## By effect\n\n" + _table(
        ["effect", "right first at 10", "right first at 5", "found among two", "untestable on (flights)"],
        rows,
    )


def _outside(lines: Sequence[Line]) -> str:
    rows = []
    for x in of_kind(lines, "outside"):
        terms = ", ".join(f"{h} {p} ({z:+.1f})" for h, p, z in x["terms"][:2])
        named = ", ".join(x["found"])
        verdict = x["verdict"] + (f": {named}" if named else "")
        mimic = f"{x['outside']['strength_with_mimics']:.0f}"
        rows.append([x["outside"]["name"], mimic, verdict, terms or "-"])
    return (
        "## Physics outside the catalogue\n\n"
        "A term of V_1 (of all four for the spin rate and Coriolis) with a strength of 10 in what neither the calibration nor all"
        "\ncatalogue effects together can absorb; the second column is its strength with what they can mimic.\n\n"
        "**Not all of them are strangers to the search.** Harmonics above the fourth, second derivatives, powers, moduli, signs and\n"
        "relaxations of the forces that turn with the disc, terms that come and go, and lines in the spectrum were written into the\n"
        "dictionary together with terms of this table that they find, or because one of them had been missed. Of these the table\n"
        "says that the search works, not what it would do with physics that nobody thought of. And three have become effects of the\n"
        "catalogue since they were written down (bias jump, spin rate off, d^2 f_i/dt^2): naming those counts as wrong nonetheless.\n\n"
        + _table(["term", "strength with mimics", "verdict", "strongest terms named (sigmas)"], rows)
    )


def _failures(lines: Sequence[Line]) -> str:
    rows = []
    for x in lines:
        if "crash" in x:
            rows.append([x["id"], "", "crash: " + x["crash"].strip().splitlines()[-1]])
        elif not _as_hoped(x):
            hidden = ", ".join(score.truths(x)) or (x["outside"] or {}).get("name", "none")
            names = ", ".join(x["found"]) or ", ".join(f"{h} {p}" for h, p, _ in x["terms"][:2])
            rows.append([x["id"], hidden, f"{x['verdict']} ({names})" if names else x["verdict"]])
    return (
        "## What went wrong\n\nTo see one: `python -m benchmarks.diagnosis --flight ID` (with the same `--seed`).\n\n"
        + _table(["flight", "hidden", "diagnosed"], rows)
    )


def _as_hoped(x: Line) -> bool:
    return {
        "effect-free": lambda: not score.alarmed(x),
        "single-10": lambda: score.right_alone(x),
        "single-5": lambda: score.right_alone(x),
        "two": lambda: score.exactly_both(x),
        "outside": lambda: score.unexplained(x),
    }[x["kind"]]()


def _conditions(lines: Sequence[Line], sample: int) -> str:
    known = {s.id: s for s in plan.specs(sample=sample)}
    flown = [known[x["id"]] for x in lines if x["id"] in known]

    def counted(of: str) -> str:
        c = Counter(str(getattr(s, of)) for s in flown)
        return ", ".join(f"{k} ({c[k]})" for k in sorted(c))

    gradients = Counter(" ".join(s.gradient) for s in flown)
    versions = Counter(x["source"] for x in lines)
    return f"""## The flights

- Instruments, drawn about their test sheets: {counted("trim")} (the paper's Table V, and its scale factors trimmed to 2e-4).
- Motion: spectra {counted("motion")}; `mixed` draws one for each component, `recorded` flies the motion channels of
  `examples/demo-flight.parquet` again. Scale of the turbulence {counted("turbulence")}; bursts (standard deviation of the logarithm of
  the intensity) {counted("bursts")}.
- Noise of the cross channel, Eo/sqrt(Hz): {counted("noise_Eo")}; 1/f below (Hz): {counted("red_corner")}.
- Gradient: {", ".join(f"{k} ({n})" for k, n in sorted(gradients.items()))}; varying is 20 Eo rms with periods of 1 to 10 minutes.
- White noise of the motion record, as the error of G_out that it causes over the noise: {counted("sensor_noise")}. Other errors of the
  motion record (delay, lever arm, misalignment, scale) are effects, and are hidden as such; in a third of the flights with two
  effects one of them is.
- Strength of effects that are no column: gain-step by its column from a random instant on; spin-rate-jitter by the expected score of the
  test of the variance; quantisation by the growth of the residual's variance (q^2/12) in sigmas of its estimate; saturation by the
  whitened change of G_out, but at least ten samples are clipped (which is far stronger: a single one may stand ten sigmas high).
- Versions of the sources (digest: flights): {", ".join(f"{k}: {n}" for k, n in sorted(versions.items()))}.
"""
