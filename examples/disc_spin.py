"""What the disc's own turning is worth: writes docs/disc-spin.md and its picture. Run: python examples/disc_spin.py."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from derive.emit.printers import to_latex
from derive.propagation import motion_numbers
from derive.symbols import symbol
from ragg_runtime.experiments.regular import regular_run
from ragg_runtime.experiments.turbulent import turbulent_run
from ragg_runtime.fit.score import Error, error
from ragg_runtime.instrument.edit_toml import model_text
from ragg_runtime.instrument.form import Form
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import output, scale_factor, vector
from ragg_runtime.model.model import packaged
from ragg_runtime.model.record import Record, record
from ragg_runtime.reference import Simulation
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

mpl.use("Agg")
import matplotlib.pyplot as plt

Array = NDArray[np.float64]
DOCS = Path(__file__).parents[1] / "docs"
SPIN = {"disc-spin": {"share": 1.0}}
SEEDS = (1, 2, 3, 4)

TERMS = {
    "centripetal, Omega^2": "steady spin",
    "Coriolis with omega_z, 2 Omega omega_z": "platform turns about the spin axis",
    "Coriolis with omega_x, omega_y": "platform turns about horizontal axes",
}


def of_terms(r: Record) -> Mapping[str, Array]:
    """Inputs of the paper's model (15, N) that make it feel each term.

    Any M is a rotation's [omegadot]x less a symmetric gradient; so the spin can be put into these.
    """
    names = packaged().chain.INPUTS
    x = r.inputs(packaged().chain)
    omega = {k: x[names.index(f"omega_{k}")] for k in "xyz"}
    spin = 2 * np.pi * r.spin_frequency
    changes: Mapping[str, Mapping[str, Array | float]] = {
        "centripetal, Omega^2": {"Gamma_xx": spin**2, "Gamma_yy": spin**2},
        "Coriolis with omega_z, 2 Omega omega_z": dict.fromkeys(
            ("Gamma_xx", "Gamma_yy"), 2 * spin * omega["z"]
        ),
        "Coriolis with omega_x, omega_y": {
            "Gamma_xz": -spin * omega["x"],
            "Gamma_yz": -spin * omega["y"],
            "omegadot_x": spin * omega["y"],
            "omegadot_y": -spin * omega["x"],
        },
    }
    found = {}
    for term, by in changes.items():
        with_term = x.copy()
        for name, change in by.items():
            with_term[names.index(name)] += change
        found[term] = with_term
    return found


class Calibration:
    """All that any calibration of the paper's model can take from a series: its 60 columns, no priors."""

    def __init__(self, r: Record, instrument: Instrument) -> None:
        model, p = packaged(), vector(packaged(), instrument)
        x = r.inputs(model.chain)
        signs = (1, 1, -1, -1)
        columns = [
            signs[j] * np.broadcast_to(c, r.time.shape)
            for j in range(4)
            for c in model.chain.derivatives(j, r.time, r.cos_phi, r.sin_phi, x, model.chain.values_of(j, p))
        ]
        stacked = np.stack([c / np.linalg.norm(c) for c in columns if np.linalg.norm(c) > 0], axis=1)
        u, s, _ = np.linalg.svd(stacked, full_matrices=False)
        self.basis = u[:, s > 1e-12 * s[0]]

    def leaves(self, y: Array) -> Array:
        once = y - self.basis @ (self.basis.T @ y)
        return np.asarray(once - self.basis @ (self.basis.T @ once))


def outputs(r: Record, instrument: Instrument) -> dict[str, Array]:
    """What each term adds to G_out, (N,) V."""
    chain, p = packaged().chain, vector(packaged(), instrument)

    def at(x: Array) -> Array:
        v = np.stack(
            [chain.accelerometer(j, r.time, r.cos_phi, r.sin_phi, x, chain.values_of(j, p)) for j in range(4)]
        )
        return np.asarray((v[0] + v[1]) - (v[2] + v[3]))

    plain = at(r.inputs(chain))
    return {term: at(x) - plain for term, x in of_terms(r).items()}


def plain_and_full(case: str) -> tuple[Simulation, Simulation]:
    """A record without and one with the spin in its kinematics, without noise."""
    if case == "dynamic":
        return regular_run(turns=64), regular_run(turns=64, effects=SPIN)
    if case.startswith("turbulence"):
        n = int(case[-1])
        return turbulent_run(n, 0), turbulent_run(n, 0, effects=SPIN)
    s = scenario(int(case.split()[-1]), noise_density=0.0)
    return s.simulate(), s.simulate(SPIN)


CASES = {
    "dynamic": "paper, III.B (Tables V, VI)",
    **{f"turbulence {n}": f"paper, III.C, turbulence {n} (Tables V, VII)" for n in (1, 2, 3)},
    **{f"flight {n}": f"typical flight {n} (trimmed, 30 min)" for n in SEEDS},
}


def _figures(e: Error) -> list[str]:
    return [f"{x:.3g}" for x in (e.rms_Eo, e.inline_Eo, e.cross_Eo)]


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [" | ".join(head), " | ".join("---" for _ in head), *(" | ".join(r) for r in rows)]
    return "\n".join(f"| {line} |" for line in lines)


def sizes() -> tuple[str, str, dict[str, tuple[Error, Error]]]:
    """Tables of the whole by case and of the terms in one flight; the terms' errors."""
    rows, terms, by_term = [], [], {}
    for case, title in CASES.items():
        without, with_spin = plain_and_full(case)
        r = record(without.flight(), without.instrument)
        k = scale_factor(packaged(), vector(packaged(), without.instrument))
        change = with_spin.G_out - without.G_out
        absorbed = Calibration(r, without.instrument)
        rows.append([title, *_figures(error(change, r, k)), *_figures(error(absorbed.leaves(change), r, k))])
        if case == f"flight {SEEDS[0]}":
            parts = outputs(r, without.instrument)
            left = change - sum(parts.values())
            terms.append(f"{float(np.max(np.abs(left)) / k):.1g}")
            for term, y in parts.items():
                by_term[term] = error(y, r, k), error(absorbed.leaves(y), r, k)
    head = [
        "record",
        "rms Eo",
        "inline",
        "cross",
        "rms, calibrated",
        "inline, calibrated",
        "cross, calibrated",
    ]
    parts_table = table(
        ["term", "when", *head[1:]],
        [[t, TERMS[t], *_figures(a), *_figures(b)] for t, (a, b) in by_term.items()],
    )
    note = f"(Derived, at the paper's order; their sum is the simulated whole to {terms[0]} Eo at its worst instant.)"
    return table(head, rows), f"{parts_table}\n\n{note}", by_term


def numbers() -> str:
    """What full kinematics add to T and S, derived."""
    paper, full = motion_numbers(), motion_numbers("full")
    rows = []
    for name, e in full.items():
        added = (e - paper[name]).expand()
        if added != 0:
            rows.append([f"${to_latex(symbol(name))}$", f"${to_latex(added)}$"])
    return table(["number", "gains"], rows)


def story(folder: Path, sheet: Instrument) -> tuple[str, list[tuple[Array, Array]]]:
    """A paper model on flights that feel the spin: the verdict, and the error before and after it is added."""
    rows, drawn = [], []
    for seed in SEEDS:
        flight = simulated(replace(sheet, form=Form(kinematics="full")), (), seed=seed)
        (folder / "sheet.toml").write_text(model_text(sheet))
        m = loop.new(folder / f"model-{seed}", folder / "sheet.toml")
        d = loop.diagnose(m, [flight])
        step = loop.add(m, "disc-spin", [flight])
        assert step.after is not None
        r = record(flight, sheet)
        k = scale_factor(packaged(), vector(packaged(), sheet))
        before = flight.outputs["G_out"] - output(packaged().chain, r, vector(packaged(), sheet))
        best = error(Calibration(r, sheet).leaves(before), r, k)
        (share,) = step.parameters
        rows.append(
            [
                str(seed),
                d.verdict,
                ", ".join(d.found) or f"first of the ranking: {d.ranking[0].effect}",
                *_figures(best)[:2],
                *_figures(step.after.calibrated)[:2],
                f"{step.after.noise_floor:.3g}",
                f"{share.value:.3f} ± {share.std:.3f}",
            ]
        )
        if seed == SEEDS[0]:
            from ragg_runtime.fit.score import channels

            after = step.after.residual[0]
            for e in (Calibration(r, sheet).leaves(before), after):
                t, inline, _ = channels(e, r, k, r.valid)
                drawn.append((t, inline))
    head = [
        "seed",
        "verdict",
        "named",
        "before: rms Eo",
        "inline",
        "after: rms Eo",
        "inline",
        "noise",
        "share",
    ]
    return table(head, rows), drawn


def draw(drawn: list[tuple[Array, Array]], by_term: Mapping[str, tuple[Error, Error]], path: Path) -> None:
    """The picture of the page."""
    fig, (top, bottom) = plt.subplots(2, 1, figsize=(8, 6), constrained_layout=True)
    for (t, inline), label, colour in zip(
        drawn, ("Eq. 9, calibrated", "disc-spin added"), ("C3", "C0"), strict=True
    ):
        top.plot(t / 60, inline, color=colour, lw=0.8, label=label)
    top.set(xlabel="time, min", ylabel="error of inline channel, Eo")
    top.legend(loc="upper right")
    places = np.arange(len(by_term))
    for k, (label, colour) in enumerate((("as it is", "0.6"), ("once calibrated", "C3"))):
        values = [e[k].rms_Eo for e in by_term.values()]
        bottom.barh(places + 0.2 - 0.4 * k, values, height=0.4, color=colour, label=label)
    bottom.set(xscale="log", xlabel="rms before demodulation, Eo")
    bottom.set_yticks(
        places, [t.replace("Omega", "Ω").replace("omega", "ω").replace("^2", "²") for t in by_term]
    )
    bottom.legend(loc="lower right")
    fig.savefig(path, dpi=110, metadata={"Software": ""})
    plt.close(fig)


PAGE = """# The disc turns, and Eq. 9 does not know it

<!-- Written by examples/disc_spin.py: do not edit; `python examples/disc_spin.py` writes it again. -->

Eq. 9 and 49 of the paper give the accelerometers the angular rate of the *platform*. But they ride on the disc, which
turns against it: their rate is $\\boldsymbol\\omega_{{im}} + \\dot\\phi\\,\\boldsymbol e_z$, and their angular acceleration
$\\dot{{\\boldsymbol\\omega}}_{{im}} + \\boldsymbol\\omega_{{im}} \\times \\dot\\phi\\,\\boldsymbol e_z + \\ddot\\phi\\,\\boldsymbol e_z$.
That is all of it: put into $f = a + M r$, it brings the Coriolis, centripetal and Euler terms that are missing. It was
found as any effect is: by holding a model against flights that know better.

Derived in `derive/stages.py` (`of_disc`), proved in `tests/derive/test_kinematics.py` against the second derivative of
where a point of the disc *is*, with exact rotations and fifty digits; the simulator has it from positions and rotations too.

## What it adds, term by term

Eq. 17 to 19 stay as they are. Of the motion numbers of Eq. 16 these gain, the others nothing:

{numbers}

A perfect instrument sees nothing of it: the steady terms are radial and axial, and its input axes are neither. The
Euler term is common to the four accelerometers and cancels in G_out but for their mismatch. What shows is what
misalignment ($\\vartheta_y$, $\\vartheta_z$) and second-order coefficients make of the rest.

## How large it is

Difference of two noise-free simulations, with and without the spin. *Calibrated*: what is left when all 60 parameters of
the paper's model may move as they like.

{sizes}

In flight {flight} by term:

{terms}

So: the centripetal force is by far the largest, and a calibration absorbs it whole: it is constant, and what
misalignment and second-order coefficients make of it looks like a null bias, a scale factor and two misalignments. The
Coriolis terms change with the platform's rate; of them no calibration takes much. They are what a paper model lacks.

## A paper model learns it

Flights of `ragg simulate` with `[model] kinematics = "full"` (30 min, 16 Hz, G_out alone, noise 2 Eo/√Hz, the instrument off its
sheet as usual) held against a model with `kinematics = "platform"`. *Before*: the best that any calibration of the
paper's model can do. *After*: `ragg add` with `disc-spin`, whose one parameter is 0 for Eq. 9 and 1 for nature.

{story}

![The inline channel before and after, and the three terms before and after calibration](disc-spin.png)

The share is no better known than the sheet's misalignment angles: Coriolis terms show times
$\\vartheta_y$ and $\\vartheta_z$ of single accelerometers, of which G_out tells but sums otherwise.

A model that is to know it from the start says so in model.toml:

    [model]
    kinematics = "full"
"""


def main() -> None:
    """Make everything and write it."""
    sheet = scenario(0).sheet
    whole, terms, by_term = sizes()
    with tempfile.TemporaryDirectory() as folder:
        told, drawn = story(Path(folder), sheet)
    draw(drawn, by_term, DOCS / "disc-spin.png")
    text = PAGE.format(numbers=numbers(), sizes=whole, terms=terms, story=told, flight=SEEDS[0])
    (DOCS / "disc-spin.md").write_text(text, "utf-8")


if __name__ == "__main__":
    main()
