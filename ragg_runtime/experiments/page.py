"""The results as a page of Markdown: no number in it is typed by hand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ragg_runtime.experiments import paper
from ragg_runtime.experiments.result import COLUMNS, Result, cells, markdown, reasons

_HEAD = """# The paper's experiments, repeated

Section III of
{citation}:
our numbers beside the printed ones (`python -m ragg_runtime.experiments`, as JSON with `--json`).

The numerical model of Eq. 49 to 53 stands for the instrument; the analytical (Eq. 17 to 19) and the
simplified model (Eq. 42 to 47) are the derived ones. The misprints of the printed equations cost too little to show here.

Of {rows} printed numbers, **{agree} agree**, **{open} hang on an input that the paper does not state**, and
**{unexplained} are unexplained**.

- *agrees*: ours has the printed digits, or the printed order of magnitude, or the printed number lies between
  the least and the greatest of our runs.
- *open input*: it does not, but an input that the paper does not state moves our number over a range that
  holds the printed one. This is no proof that the paper had that input.
- *unexplained*: neither.

No parameter of the instrument or the models is adjusted to meet the paper. Two choices were made with the
printed numbers in view, because the paper leaves them open: the sign of a model error, numerical minus
model (the other would make every printed error of Section III.B differ in sign from ours), and the
sampling of the turbulence, on which the simplified model's sigmas in experiments 2 and 3 rest.
"""


def page(results: Sequence[Result]) -> str:
    """The page of some experiments."""
    verdicts = Counter(row.verdict for r in results for row in r.rows)
    head = _HEAD.format(
        citation=paper.CITATION,
        rows=sum(verdicts.values()),
        agree=verdicts["agrees"],
        open=verdicts["open input"],
        unexplained=verdicts["unexplained"],
    )
    return "\n".join([head, *(_section(r) for r in results)])


def _section(r: Result) -> str:
    parts = [f"## {r.title}", "\n".join(f"- {name}: {value}" for name, value in r.settings.items())]
    parts.append(markdown(COLUMNS, [cells(row) for row in r.rows]))
    parts += [f"- {text}" for text in reasons(r.rows)]
    for t in r.tables:
        parts += [f"### {t.title}", markdown(t.columns, t.rows), t.finding]
    return "\n\n".join(parts) + "\n"
