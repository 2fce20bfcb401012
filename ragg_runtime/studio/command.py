"""``ragg studio``: the loop in a browser."""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from pathlib import Path

import click

from ragg_runtime.base.errors import UserError

NEEDED = ("starlette", "uvicorn", "latex2mathml")
"""What the extra ``studio`` brings."""


@click.command()
@click.argument("model_dir", metavar="[MODEL]", type=click.Path(path_type=Path), required=False)
@click.argument("flights", metavar="[FLIGHT...]", type=click.Path(path_type=Path), nargs=-1)
@click.option(
    "--port", type=click.IntRange(0, 65535), default=0, help="Port on 127.0.0.1 (default: a free one)."
)
@click.option("--no-browser", is_flag=True, help="Only print the address.")
def studio(model_dir: Path | None, flights: Sequence[Path], port: int, no_browser: bool) -> None:
    """Work in a browser: compare, diagnose, add, apply.

    Prints the address and serves until interrupted, to this machine only. Files are read and written below the
    folders of MODEL and FLIGHT (without them: the working directory) and nowhere else.
    """
    absent = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if absent:
        raise UserError(
            "the studio needs packages that are not installed",
            found=f"no {', '.join(absent)}",
            remedy="pip install 'ragg[studio]'",
        )
    from ragg_runtime.studio.serve import serve

    serve(model_dir, flights, port, click.echo, browser=not no_browser)
