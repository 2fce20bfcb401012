"""A report: sections as one self-contained HTML document, with how to make it again. The same input gives the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

from ragg_runtime.base.errors import missing_package
from ragg_runtime.base.provenance import MISSING, versions
from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Plot, Section, escape, render_html

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
        return lambda plot: f"<p>no figure: {escape(missing.what)} ({escape(missing.remedy or '')})</p>"
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
    return numbers.clean(
        f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{escape(origin.title)}</title>
<style>
{_read_style()}</style>
</head>
<body>
<header>
<p class="kind">{escape(kind)}</p>
<h1>{escape(origin.title)}</h1>
{render_html([first], draw)}
</header>
<main>
{render_html(others, draw)}
</main>
{_footer(origin, facts)}
</body>
</html>
"""
    )


def _footer(origin: Origin, facts: Sequence[tuple[str, str]]) -> str:
    """The command that makes the report again, and what it depends on."""
    rows = [
        *facts,
        ("derived model", origin.digest),
        ("versions", ", ".join(f"{n} {v}" for n, v in versions().items() if v != MISSING)),
    ]
    listed = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in rows if value)
    files = "".join(
        f"<tr><td>{escape(name)}</td><td><code>{escape(sha)}</code></td></tr>" for name, sha in origin.sources
    )
    table = f'<div class="wide"><table><tbody>{files}</tbody></table></div>' if files else ""
    facts_ = f'<details><summary>Record, versions and digests</summary><dl class="facts">{listed}</dl>{table}</details>'
    return f"<footer><h2>How this was made</h2><pre>{escape(origin.command)}</pre>{facts_}</footer>"


@cache
def _read_style() -> str:
    return resources.files("ragg_runtime.report").joinpath("templates", "style.css").read_text("utf-8")
