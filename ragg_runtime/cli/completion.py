"""What the shell completes: ids of effects, those of the catalogue and a model's own. How to switch it on: ``docs/how-to``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem


def catalogued(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Effects of the catalogue, each with its title where the shell shows it."""
    from ragg_runtime.workflow.catalogue import effects

    found = [(str(e["id"]), str(e["title"])) for e in effects()]
    return [CompletionItem(e, help=title) for e, title in found if e.startswith(incomplete)]


def addable(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The catalogue's, and those that the model lists, without those that it has with values."""
    listed = _listed(ctx.params.get("model_dir"))
    own = [e for e, has_values in listed.items() if not has_values and e.startswith(incomplete)]
    others = [x for x in catalogued(ctx, param, incomplete) if x.value not in listed]
    return [*(CompletionItem(e, help="listed in model.toml") for e in own), *others]


def present(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Effects that the model lists."""
    return [CompletionItem(e) for e in _listed(ctx.params.get("model_dir")) if e.startswith(incomplete)]


def _listed(model_dir: Any) -> dict[str, bool]:
    """Effects of a model.toml -> whether they have values; nothing of one that cannot be read: completion never fails."""
    import tomllib

    from ragg_runtime.base.errors import UserError
    from ragg_runtime.base.files import read_text

    try:
        entries = tomllib.loads(read_text(Path(model_dir) / "model.toml")).get("effects", [])
        rows = [{"id": e} if isinstance(e, str) else dict(e) for e in entries]
        return {str(r["id"]): any(isinstance(v, dict) and "value" in v for v in r.values()) for r in rows}
    except (OSError, ValueError, KeyError, TypeError, UserError):
        return {}
