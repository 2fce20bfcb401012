"""``docs/experiments.md``, written from the results: no number in it is typed by hand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from ragg_runtime.experiments import paper
from ragg_runtime.experiments.dynamic import dynamic
from ragg_runtime.experiments.multifrequency import multifrequency
from ragg_runtime.experiments.result import COLUMNS, Result, Row, cells, markdown, reasons
from ragg_runtime.experiments.turbulence import turbulence

DEFAULT = Path("docs/experiments.md")

_HEAD = """# The paper's experiments, repeated

<!-- Written by ragg_runtime.experiments: do not edit; `python -m ragg_runtime.experiments docs` does. -->

Section III of
{citation}:
our numbers beside the printed ones. `ragg experiment multifrequency`, `dynamic` and `turbulence` give the
tables below, as JSON with `--json`, and the figures with `--figures`.

The numerical model of Eq. 49 to 53 stands for the instrument; the analytical (Eq. 17 to 19) and the
simplified model (Eq. 42 to 47) are the derived ones. The misprints of the printed equations
([errata](errata.md)) cost too little to show here.

Of {rows} printed numbers, **{agree} agree**, **{open} hang on an input that the paper does not state**, and
**{unexplained} are unexplained**.

- *agrees*: ours has the printed digits, or the printed order of magnitude, or the printed number lies between
  the least and the greatest of our runs.
- *open input*: it does not, but an input that the paper does not state moves our number over a range that
  holds the printed one. This is no proof that the paper had that input.
- *unexplained*: neither.

No parameter of the instrument or the models is adjusted to meet the paper. Two choices were made with the
printed numbers in view, because the paper leaves them open: the sign of a model error, numerical minus
model (the other sign would make every printed error of Section III.B differ in sign from ours), and the
sampling of the turbulence. On the latter rests the agreement of the four sigmas of the simplified model in
experiments 2 and 3 and of their two noise densities, {inferred} of the {agree}; the tables below say what
other samplings give.
"""


def page(results: Sequence[Result] | None = None) -> str:
    """The page; ``results`` are the three experiments at their defaults unless given."""
    found = (multifrequency(), dynamic(), turbulence()) if results is None else results
    verdicts = Counter(row.verdict for r in found for row in r.rows)
    head = _HEAD.format(
        citation=paper.CITATION,
        rows=sum(verdicts.values()),
        agree=verdicts["agrees"],
        open=verdicts["open input"],
        unexplained=verdicts["unexplained"],
        inferred=sum(_inferred(row) for r in found for row in r.rows),
    )
    return "\n".join([head, *(_section(r) for r in found)])


def _inferred(row: Row) -> bool:
    """Whether an agreement rests on the sampling that was inferred from Table VIII."""
    simplified = row.quantity.endswith("simplified") and any(n in row.quantity for n in ("sigma", "density"))
    return row.verdict == "agrees" and row.quantity.startswith("exp.") and simplified


def _section(r: Result) -> str:
    parts = [f"## {r.title}", "\n".join(f"- {name}: {value}" for name, value in r.settings.items())]
    parts.append(markdown(COLUMNS, [cells(row) for row in r.rows]))
    parts += [f"- {text}" for text in reasons(r.rows)]
    for t in r.tables:
        parts += [f"### {t.title}", markdown(t.columns, t.rows), t.finding]
    return "\n\n".join(parts) + "\n"
