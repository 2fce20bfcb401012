"""A page: templates with autoescape on, the style sheet inside, and how to make the report again."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import metadata, resources
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from ragg_runtime.wording import numbers

LIBRARIES = ("numpy", "scipy", "sympy", "matplotlib", "jinja2")
"""What a report's numbers and looks depend on."""


@dataclass(frozen=True)
class Origin:
    """Where a report comes from: its title, the command line, (name, sha256) of every file it read, and what
    was done to the records or looks odd in them.
    """

    title: str
    command: str
    sources: Sequence[tuple[str, str]]
    notes: Sequence[str] = ()


@cache
def _environment() -> Environment:
    made = Environment(
        loader=PackageLoader("ragg_runtime.report"),
        autoescape=True,  # names of files, channels and effects come from strangers
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.filters["number"] = numbers.number
    made.filters["unit"] = numbers.unit
    return made


def render(template: str, origin: Origin, context: Mapping[str, Any]) -> str:
    """A whole HTML document, self-contained, in characters that UTF-8 can write."""
    text = (
        _environment()
        .get_template(template)
        .render(
            title=origin.title,
            command=origin.command,
            sources=list(origin.sources),
            notes=list(origin.notes),
            versions=versions(),
            style=Markup(_style()),
            **context,
        )
    )
    return numbers.clean(text)


def figure(drawn: str, caption: str) -> dict[str, Any]:
    """A figure for a template; ``drawn`` is SVG made here, and so not escaped again."""
    return {"svg": Markup(drawn), "caption": caption}


def figures(found: Sequence[Mapping[str, str]]) -> list[dict[str, Any]]:
    return [figure(x["svg"], x["caption"]) for x in found]


def versions() -> list[tuple[str, str]]:
    """(name, version) of Python, this package and the libraries that a report depends on."""
    found = [("Python", platform.python_version())]
    for name in ("ragg", *LIBRARIES):
        try:
            found.append((name, metadata.version(name)))
        except metadata.PackageNotFoundError:
            continue
    return found


def _style() -> str:
    return resources.files("ragg_runtime.report").joinpath("templates", "style.css").read_text("utf-8")
