"""A report: sections as one self-contained HTML document, with how to make it again. The same input gives the same bytes."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

from ragg_runtime.base.errors import missing_package
from ragg_runtime.base.files import MISSING, versions
from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Plot, Section, make_environment, render_html

if TYPE_CHECKING:  # slow to import, and help does without it
    from ragg_runtime.workspace import Source


@dataclass(frozen=True)
class Origin:
    """Where a report comes from: command line, (name, sha256) of every file read, notes on the records, digest of the model."""

    title: str
    command: str
    sources: Sequence[tuple[str, str]]
    notes: Sequence[str] = ()
    digest: str = ""

    @staticmethod
    def of(source: Source, title: str | None = None) -> Origin:
        """Of a result; the title names model and flights unless given."""
        usual = f"{source.m.name} and {', '.join(x.name for x in source.flights)}"
        return Origin(
            title or usual, source.command, source.inputs, tuple(source.notes), source.m.model.digest
        )


def _find_renderer() -> Callable[[Plot], str]:
    """The function that draws a plot as SVG; without matplotlib it returns a line that names the extra."""
    try:
        from ragg_runtime.report.plots import draw_plot
    except ModuleNotFoundError as error:
        missing = missing_package(error)
        if missing is None:
            raise
        said = html.escape(f"no figure: {missing.what} ({missing.remedy})")
        return lambda plot: f"<p>{said}</p>"
    return draw_plot


def render_page(
    kind: str, sections: Sequence[Section], origin: Origin, facts: Sequence[tuple[str, str]] = ()
) -> str:
    """A whole HTML document of sections, the first of which is the verdict.

    Parameters
    ----------
    kind
        What the report is about, in two or three words.
    facts
        (name, value) of what was recorded and fitted, for the foot of the page.
    """
    if origin.notes:
        done = Section(
            title="What was done to the record", sentences=tuple(origin.notes), detail=len(origin.notes) > 3
        )
        sections = [*sections, done]
    first, *others = sections
    draw = _find_renderer()
    used = ", ".join(f"{n} {v}" for n, v in versions().items() if v != MISSING)
    page = make_environment("ragg_runtime.report", html=True).get_template("page.html.j2")
    return numbers.clean(
        page.render(
            kind=kind,
            origin=origin,
            style=_read_style(),
            first=render_html([first], draw),
            others=render_html(others, draw),
            facts=[*facts, ("derived model", origin.digest), ("versions", used)],
        )
    )


@cache
def _read_style() -> str:
    return resources.files("ragg_runtime.report").joinpath("templates", "style.css").read_text("utf-8")
