"""A number of the paper beside ours, with a verdict; and tables of them as Markdown and JSON."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Literal

from ragg_runtime.experiments.paper import Printed

Verdict = Literal["agrees", "open input", "unexplained"]
"""``open input``: the number hangs on something that the paper does not state, and the printed one is within
its reach. ``unexplained``: neither."""

Cell = str | float
Json = dict[str, object]


@dataclass(frozen=True)
class Row:
    """One printed number beside ours, in the printed unit (the mean of several runs, ``spread`` their least and
    greatest).

    ``reason`` is empty only where the numbers agree.
    """

    quantity: str
    printed: Printed
    ours: float
    spread: tuple[float, float] | None
    verdict: Verdict
    reason: str

    def as_json(self) -> Json:
        p = self.printed
        paper = {"where": p.where, "unit": p.unit, "paper": p.value, "paper_gives_order_only": p.order}
        own = {k: v for k, v in asdict(self).items() if k not in ("quantity", "printed")}
        return {"quantity": self.quantity, **paper, **own}

    def cells(self) -> tuple[Cell, ...]:
        """The row under :data:`COLUMNS`."""
        p = self.printed
        spread = "" if self.spread is None else " ... ".join(map(format_number, self.spread))
        paper = ("order of " if p.order else "") + p.text
        return self.quantity, paper, self.ours, spread, p.unit, self.verdict


def judge(
    quantity: str,
    printed: Printed,
    ours: float,
    *,
    spread: tuple[float, float] | None = None,
    reach: tuple[float, float] | None = None,
    open_input: str = "",
    unexplained: str = "",
) -> Row:
    """Compare, by the same rule for every number.

    ``spread``: least and greatest of several runs, a printed number between them agrees. ``reach``: the same over an
    input that the paper leaves open. ``open_input``, ``unexplained``: the reason to give in either case.
    """
    verdict: Verdict
    inside = spread is not None and spread[0] <= printed.value <= spread[1]
    if inside or printed.matches(ours):
        verdict, reason = "agrees", ""
    elif reach is not None and reach[0] <= printed.value <= reach[1]:
        verdict, reason = "open input", open_input
    else:
        verdict, reason = "unexplained", unexplained
    return Row(quantity=quantity, printed=printed, ours=ours, spread=spread, verdict=verdict, reason=reason)


@dataclass(frozen=True)
class Table:
    """Runs with something changed, which show what a number hangs on; ``finding`` says what they show."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    finding: str


@dataclass(frozen=True)
class Result:
    """An experiment: its title, settings, the printed numbers beside ours, and what they hang on."""

    title: str
    settings: Mapping[str, str]
    rows: tuple[Row, ...]
    tables: tuple[Table, ...]

    def as_json(self) -> Json:
        return {
            "title": self.title,
            "settings": dict(self.settings),
            "rows": [r.as_json() for r in self.rows],
            "checks": [asdict(t) for t in self.tables],
        }


COLUMNS = ("quantity", "paper", "ours", "runs from ... to", "unit", "verdict")


def format_number(value: float) -> str:
    """Three significant digits; the same text on any machine but for the last of them."""
    if value == 0:
        return "0"
    return f"{value:.3g}" if 1e-3 <= abs(value) < 1e4 else f"{value:.2e}"


def write_markdown(columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> str:
    """A Markdown table."""
    texts = ([c if isinstance(c, str) else format_number(c) for c in r] for r in rows)
    return "\n".join("| " + " | ".join(line) + " |" for line in (columns, ["---"] * len(columns), *texts))


_HEAD = """# The paper's experiments, repeated

Section III of
M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity Gradiometer*:
our numbers beside the printed ones (`python -m ragg_runtime.experiments`, as JSON with `--json`).

The numerical model of Eq. 49 to 53 stands for the instrument; the analytical (Eq. 17 to 19) and the
simplified model (Eq. 42 to 47) are the derived ones. The misprints of the printed equations cost too little to show here.

Of {rows} printed numbers, **{agrees} agree**, **{open} hang on an input that the paper does not state**, and
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
    counts = {k.split()[0]: verdicts[k] for k in ("agrees", "open input", "unexplained")}
    return "\n".join([_HEAD.format(rows=sum(verdicts.values()), **counts), *map(_section, results)])


def _section(r: Result) -> str:
    parts = [f"## {r.title}", "\n".join(f"- {name}: {value}" for name, value in r.settings.items())]
    parts.append(write_markdown(COLUMNS, [row.cells() for row in r.rows]))
    reasons: dict[str, list[str]] = {}  # each once, with the quantities that it is for
    for row in r.rows:
        if row.reason:
            reasons.setdefault(f"({row.verdict}) {row.reason}", []).append(row.quantity)
    parts += [f"- {'; '.join(quantities)}: {reason}" for reason, quantities in reasons.items()]
    for t in r.tables:
        parts += [f"### {t.title}", write_markdown(t.columns, t.rows), t.finding]
    return "\n\n".join(parts) + "\n"
