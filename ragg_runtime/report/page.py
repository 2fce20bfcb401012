"""A page: templates with autoescape on, the style sheet inside, and how to make the report again."""

from __future__ import annotations

import base64
import hashlib
import platform
import re
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
    """Where a report comes from: command line, (name, sha256) of every file read, and notes on the records."""

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
            style=Markup(_file("style.css")),
            script=Markup(_file("live.js")),
            allowed=_digest(_file("live.js")),
            contents=Markup(CONTENTS),
            **context,
        )
    )
    return numbers.clean(_with_contents(text))


CONTENTS = "<!-- contents -->"
"""Where the table of contents stands; names of strangers are escaped, so that none can read like this."""


def _with_contents(text: str) -> str:
    """The page with its headings numbered for links, and the list of them."""
    found: list[str] = []

    def anchored(heading: re.Match[str]) -> str:
        found.append(f'<li><a href="#section-{len(found) + 1}">{heading[1]}</a></li>')
        return f'<h2 id="section-{len(found)}">{heading[1]}</h2>'

    text = re.sub(r"<h2>(.*?)</h2>", anchored, text, flags=re.DOTALL)
    return text.replace(CONTENTS, "\n".join(found), 1)


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


@cache
def _file(name: str) -> str:
    return resources.files("ragg_runtime.report").joinpath("templates", name).read_text("utf-8")


def _digest(script: str) -> str:
    """How a policy names the one script that may run: whatever else came into the page would not."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
