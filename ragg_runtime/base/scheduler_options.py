"""The options that name a Dask cluster: of every command that lets one work."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

_PEM = click.Path(path_type=Path)


def scheduler_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """``--scheduler``, ``--tls-ca``, ``--tls-cert`` and ``--tls-key``, in this order in the help."""
    for option in (
        click.option("--tls-key", type=_PEM, metavar="FILE", help="The key of your certificate (PEM)."),
        click.option("--tls-cert", type=_PEM, metavar="FILE", help="Your certificate for it (PEM)."),
        click.option(
            "--tls-ca", type=_PEM, metavar="FILE", help="Of a tls:// scheduler: who signed it (PEM)."
        ),
        click.option(
            "--scheduler",
            metavar="tcp://HOST:PORT",
            help="Let the workers of a Dask cluster do it. What answers there can run code here: trusted addresses only, "
            "tls://HOST:PORT beyond your own walls.",
        ),
    ):
        command = option(command)
    return command
