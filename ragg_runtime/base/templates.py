"""Texts from templates: pages, programs, Markdown. The same values give the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import jinja2

Filters = Mapping[str, Callable[..., Any]]


def make_environment(
    package: str, filters: Filters = MappingProxyType({}), *, html: bool = False
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
