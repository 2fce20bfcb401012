"""A result as a list of sections (sentences, a table, data of plots), and how a terminal and HTML show it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import one_line
from ragg_runtime.wording import numbers

if TYPE_CHECKING:
    import jinja2


def make_environment(
    package: str, filters: Mapping[str, Callable[..., Any]] = MappingProxyType({}), *, html: bool = False
) -> jinja2.Environment:
    """For the templates in the folder ``templates`` of a package; in ``html`` what they show is escaped."""
    import jinja2  # slow to import, and most commands do without it

    env = jinja2.Environment(
        loader=jinja2.PackageLoader(package, "templates"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=html,
    )
    env.filters |= filters
    return env


Array = NDArray[np.float64]
T = TypeVar("T")
Role = Literal["residual", "envelope", "before", "noise"]


@dataclass(frozen=True)
class Table:
    """Rows of text: ``words`` leading columns are left-aligned, rows that begin with one of ``strong`` are bold.

    ``brief``: rows that a terminal shows unless it is asked for all (``None``: all); ``note`` is printed below.
    """

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    words: int = 1
    strong: frozenset[str] = frozenset()
    brief: int | None = None
    note: str = ""


def tabulate(items: Iterable[T], columns: Mapping[str, Callable[[T], str]], **options: Any) -> Table:
    """A table with a row for each item: the head of every column and what makes its cell."""
    return Table(tuple(columns), tuple(tuple(f(x) for f in columns.values()) for x in items), **options)


@dataclass(frozen=True)
class Curve:
    """A curve (N,): a line, steps (``x`` holds N + 1 edges), or a band from ``y`` to ``high``; ``role`` gives its colour."""

    name: str
    x: Array
    y: Array
    role: Role = "residual"
    kind: Literal["line", "steps", "band"] = "line"
    high: Array | None = None
    width: float = 1.2


@dataclass(frozen=True)
class Axes:
    """Curves over one abscissa; ``level``: one standard deviation of noise; ``marks``: abscissae with a text."""

    curves: tuple[Curve, ...]
    y_label: str
    title: str = ""
    ends: tuple[float, float] | None = None
    level: float = float("nan")
    signed: bool = True
    log: bool = False
    marks: tuple[tuple[float, str], ...] = ()
    share: float = 1.0


@dataclass(frozen=True)
class Curves:
    """A figure of axes below each other; ``key`` begins the ids of its elements."""

    key: str
    caption: str
    axes: tuple[Axes, ...]
    x_label: str
    height: float = 2.2


@dataclass(frozen=True)
class Bar:
    """A bar: its label and value, the level that noise alone would give, and another value that is marked (NaN: none)."""

    label: str
    value: float
    noise: float = float("nan")
    strong: bool = True
    dot: float = float("nan")


@dataclass(frozen=True)
class Bars:
    """A figure of lying bars; ``threshold`` is a dashed line with a text, ``dot`` says what is marked."""

    key: str
    caption: str
    bars: tuple[Bar, ...]
    axis: str
    log: bool = False
    threshold: tuple[float, str] | None = None
    dot: str = ""


@dataclass(frozen=True)
class Matrix:
    """A figure of a symmetric matrix (n, n) of correlations, with the names of its rows."""

    key: str
    caption: str
    names: tuple[str, ...]
    values: Array


Plot = Curves | Bars | Matrix


@dataclass(frozen=True)
class Section:
    """A part of a result. One with a ``state`` and without a title is the verdict, in the colour of that state.

    ``detail``: a terminal shows it on request alone, and a page folds it; ``summary`` then replaces it, in one line.
    """

    title: str = ""
    sentences: tuple[str, ...] = ()
    table: Table | None = None
    code: tuple[str, ...] = ()
    plots: tuple[Plot, ...] = ()
    detail: bool = False
    summary: str = ""
    state: str = ""


def render_text(sections: Sequence[Section], *, verbose: bool = False) -> str:
    """The sections for a terminal, in ASCII but for names; ``verbose``: with their details."""
    parts = []
    for s in sections:
        title = f"{_clean_line(s.title)}:"
        lines = [title] if s.title and not s.detail else []
        indent = "  " if s.title else ""
        if s.detail and not verbose:
            parts += [f"{_clean_line(s.summary)} (-v)"] if s.summary else []
            continue
        if s.detail:
            lines = [title]
        lines += [f"{indent}{_clean_line(text)}" for text in s.sentences]
        lines += [] if s.table is None else _render_table(s.table, indent, verbose)
        lines += [f"  {one_line(line)}" for line in s.code]
        if lines != [title]:
            parts.append("\n".join(lines))
    spaced = [
        p if k == 0 or ("\n" not in p and "\n" not in parts[k - 1]) else f"\n{p}" for k, p in enumerate(parts)
    ]
    return "\n".join(spaced)


def _clean_line(text: str) -> str:
    """A line in ASCII, but for names; these in one line, without what would steer a terminal."""
    return one_line(numbers.to_ascii(text))


def _render_table(t: Table, indent: str, verbose: bool) -> list[str]:
    rows = t.rows if verbose or t.brief is None else t.rows[: t.brief]
    cells = [[_clean_line(x) for x in row] for row in (t.heads, *rows)]
    wide = [max(len(row[k]) for row in cells) for k in range(len(t.heads))]
    lines = []
    for row in cells:
        padded = [
            f"{x:{w}}" if k < t.words else f"{x:>{w}}" for k, (x, w) in enumerate(zip(row, wide, strict=True))
        ]
        lines.append(f"{indent}{'  '.join(padded)}".rstrip())
    if not any(t.heads):
        lines = lines[1:]
    if len(rows) < len(t.rows):
        lines.append(f"{indent}and {len(t.rows) - len(rows)} more (-v)")
    return [*lines, *([f"{indent}{_clean_line(t.note)}"] if t.note else [])]


def render_html(sections: Sequence[Section], draw: Callable[[Plot], str] = lambda plot: "") -> str:
    """The sections as HTML without style, details folded; ``draw`` gives a plot as SVG."""
    drawn = [[(svg, p.caption) for p in s.plots if (svg := draw(p))] for s in sections]
    template = _make_environment().get_template("sections.html.j2")
    return template.render(sections=zip(sections, drawn, strict=True))


@cache
def _make_environment() -> jinja2.Environment:
    env = make_environment("ragg_runtime.wording", html=True)
    # texts come from files: no control characters, no marks that reverse the line
    env.finalize = lambda x: numbers.clean(x) if type(x) is str else x
    return env


_NOTEBOOK = (
    ".ragg td,.ragg th{padding:.15em .7em;text-align:left;white-space:nowrap}.ragg .n{text-align:right}"
    ".ragg .headline,.ragg .strong{font-weight:600}.ragg h2{font-size:1em;display:inline}.ragg p{margin:.2em 0}"
)


def render_notebook(sections: Sequence[Section]) -> str:
    """The sections as a fragment of HTML for a notebook."""
    return f'<div class="ragg"><style>{_NOTEBOOK}</style>{render_html(sections)}</div>'
