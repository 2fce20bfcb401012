"""A number of the paper beside ours, with a verdict; and tables of them as Markdown and JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Literal

Verdict = Literal["agrees", "open input", "unexplained"]
"""``open input``: the number hangs on something that the paper does not state, and the printed one is within
its reach. ``unexplained``: neither."""

Cell = str | float
Json = dict[str, object]


@dataclass(frozen=True)
class Printed:
    """A number as the paper prints it: its digits, ``unit`` (empty for a pure number), section or table; ``order``: of
    magnitude only.
    """

    text: str
    unit: str
    where: str
    order: bool = False

    @property
    def value(self) -> float:
        """The number."""
        return float(self.text)

    def matches(self, ours: float) -> bool:
        """Whether ``ours`` has the printed digits, or the printed order of magnitude (a third of it up to ten times)."""
        if self.order:
            return math.copysign(1, ours) == math.copysign(1, self.value) and (
                -0.5 <= math.log10(abs(ours / self.value)) < 1
            )
        mantissa, _, exponent = self.text.partition("e")
        decimals = len(mantissa.partition(".")[2])
        return abs(ours - self.value) <= 0.5000001 * 10.0 ** (int(exponent or 0) - decimals)


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
        """The row as JSON."""
        return {
            "quantity": self.quantity,
            "where": self.printed.where,
            "unit": self.printed.unit,
            "paper": self.printed.value,
            "paper_gives_order_only": self.printed.order,
            "ours": self.ours,
            "spread": None if self.spread is None else list(self.spread),
            "verdict": self.verdict,
            "reason": self.reason,
        }


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


def cells(row: Row) -> tuple[Cell, ...]:
    """A row under ``COLUMNS``."""
    p = row.printed
    spread = "" if row.spread is None else f"{number(row.spread[0])} ... {number(row.spread[1])}"
    return (
        row.quantity, ("order of " if p.order else "") + p.text, row.ours, spread, p.unit, row.verdict,
    )  # fmt: skip


def reasons(rows: Sequence[Row]) -> list[str]:
    """Every reason once, with the quantities that it is for."""
    named: dict[str, list[str]] = {}
    for r in rows:
        if r.reason:
            named.setdefault(f"({r.verdict}) {r.reason}", []).append(r.quantity)
    return [f"{'; '.join(quantities)}: {reason}" for reason, quantities in named.items()]


def number(value: float) -> str:
    """Three significant digits; the same text on any machine but for the last of them."""
    if value == 0:
        return "0"
    return f"{value:.3g}" if 1e-3 <= abs(value) < 1e4 else f"{value:.2e}"


def _text(cell: Cell) -> str:
    return cell if isinstance(cell, str) else number(cell)


def markdown(columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> str:
    """A Markdown table."""
    lines = [list(columns), ["---"] * len(columns), *([_text(c) for c in r] for r in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
