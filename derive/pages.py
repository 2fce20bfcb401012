"""Documentation pages of the effects, written from the effects themselves when the site is built (docs/conf.py)."""

from __future__ import annotations

from derive.effect import Effect
from derive.effects import catalogue
from derive.emit.render import environment


def effects() -> dict[str, str]:
    """``effects/<id>.md`` of every effect, and their index."""
    found = {f"effects/{e.id}.md": _page(e) for e in catalogue()}
    found["effects.md"] = _rendered("effects.md.j2", effects=catalogue())
    return found


def _page(e: Effect) -> str:
    return _rendered("effect.md.j2", e=e)


def _rendered(template: str, **values: object) -> str:
    return environment("derive.emit").get_template(template).render(**values)
