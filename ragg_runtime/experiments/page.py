"""A number of the paper beside ours, with a verdict; and tables of them as Markdown and JSON."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

from ragg_runtime.experiments.paper import Printed

Cell = str | float
Range = tuple[float, float]


@dataclass(frozen=True)
class PrintedEntry:
    """One printed number beside ours, in the printed unit (the mean of several runs, ``spread`` their least and greatest).

    ``verdict``: ``agrees``; ``open input``: the number hangs on something that the paper does not state, and the printed one is
    within its reach; ``unexplained``: neither. ``reason`` is empty only where the numbers agree.
    """

    quantity: str
    printed: Printed
    ours: float
    spread: Range | None
    verdict: str
    reason: str

    def as_json(self) -> dict[str, object]:
        p, own = self.printed, asdict(self)
        paper = {"where": p.where, "unit": p.unit, "paper": p.value, "paper_gives_order_only": p.order}
        return (
            {"quantity": self.quantity} | paper | {k: own[k] for k in ("ours", "spread", "verdict", "reason")}
        )


def judge(
    quantity: str,
    printed: Printed,
    ours: float,
    *,
    spread: Range | None = None,
    reach: Range | None = None,
    open_input: str = "",
    unexplained: str = "",
) -> PrintedEntry:
    """Compare, by the same rule for every number.

    ``spread``: least and greatest of several runs, a printed number between them agrees. ``reach``: the same over an
    input that the paper leaves open. ``open_input``, ``unexplained``: the reason to give in either case.
    """
    inside, within = (r is not None and r[0] <= printed.value <= r[1] for r in (spread, reach))
    if inside or printed.matches(ours):
        return PrintedEntry(quantity, printed, ours, spread, "agrees", "")
    verdict, reason = ("open input", open_input) if within else ("unexplained", unexplained)
    return PrintedEntry(quantity, printed, ours, spread, verdict, reason)


@dataclass(frozen=True)
class Experiment:
    """An experiment: its title, settings, and the printed numbers beside ours."""

    title: str
    settings: Mapping[str, str]
    rows: tuple[PrintedEntry, ...]

    def as_json(self) -> dict[str, object]:
        rows = [r.as_json() for r in self.rows]
        return {"title": self.title, "settings": dict(self.settings), "rows": rows}


def _format(value: Cell) -> str:
    """Three significant digits; the same text on any machine but for the last of them."""
    if isinstance(value, str):
        return value
    if value == 0:
        return "0"
    return f"{value:.3g}" if 1e-3 <= abs(value) < 1e4 else f"{value:.2e}"


def _write_table(columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> str:
    lines = (columns, ["---"] * len(columns), *(map(_format, r) for r in rows))
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


_HEAD = """# The paper's experiments, repeated

See which printed numbers can be reproduced: Section III of
M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity Gradiometer*:
our numbers and the printed ones (`python -m ragg_runtime.experiments`, as JSON with `--json`).

The numerical model of Eq. 49 to 53 represents the instrument; the analytical (Eq. 17 to 19) and the
simplified model (Eq. 42 to 47) are the derived ones. The misprints of the equations are too small to matter here.

Of {rows} printed numbers, **{agrees} agree**, **{open} depend on an input that the paper does not state**, and
**{unexplained} are unexplained**.

- *agrees*: ours has the printed digits, or the printed order of magnitude, or the printed number lies between
  the least and the greatest of our runs.
- *open input*: it does not, but an input that the paper does not state moves our number over a range that
  contains the printed one. This is no proof that the paper had that input.
- *unexplained*: neither applies.

No parameter of the instrument or the models is adjusted to fit the paper. Two choices were made with the
printed numbers in view, because the paper leaves them open: the sign of a model error, numerical minus
model (the other would make every printed error of Section III.B differ in sign from ours), and the
sampling of the turbulence, which determines the simplified model's sigmas in experiments 2 and 3.
"""


def write_page(experiments: Sequence[Experiment]) -> str:
    """The page of some experiments."""
    verdicts = Counter(row.verdict for e in experiments for row in e.rows)
    counts = {k.split()[0]: verdicts[k] for k in ("agrees", "open input", "unexplained")}
    return "\n".join([_HEAD.format(rows=sum(verdicts.values()), **counts), *map(_write_section, experiments)])


def _write_section(e: Experiment) -> str:
    rows, reasons = [], dict[str, list[str]]()  # each reason once, with the quantities that it is for
    for r in e.rows:
        spread = "" if r.spread is None else " ... ".join(map(_format, r.spread))
        paper = ("order of " if r.printed.order else "") + r.printed.text
        rows.append((r.quantity, paper, r.ours, spread, r.printed.unit, r.verdict))
        if r.reason:
            reasons.setdefault(f"({r.verdict}) {r.reason}", []).append(r.quantity)
    heads = ("quantity", "paper", "ours", "runs from ... to", "unit", "verdict")
    parts = [f"## {e.title}", "\n".join(f"- {name}: {value}" for name, value in e.settings.items())]
    parts += [_write_table(heads, rows)]
    parts += [f"- {'; '.join(quantities)}: {reason}" for reason, quantities in reasons.items()]
    return "\n\n".join(parts) + "\n"
