"""Whether two flights hold the same record: what is counted twice as evidence accuses, and is none."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import ANGULAR_RATE, SPECIFIC_FORCE, Flight


def content(flight: Flight) -> str:
    """Digest of motion and output in single precision: the same for any format that holds their digits."""
    columns = {**{n: flight.channels[n] for n in (*SPECIFIC_FORCE, *ANGULAR_RATE)}, **flight.outputs}
    digest = hashlib.sha256()
    for name in sorted(columns):
        with np.errstate(over="ignore"):
            digest.update(name.encode() + np.asarray(columns[name], dtype="<f4").tobytes())
    return digest.hexdigest()


def distinct(flights: Sequence[Flight]) -> None:
    """UserError if two of the flights are the same record."""
    if len(flights) < 2:
        return
    known: dict[str, Flight] = {}
    for x in flights:
        first = known.setdefault(content(x), x)
        if first is not x:
            raise UserError(
                same_record(str(first.path or first.name)),
                where=x.path or x.name,
                remedy="give each record once",
            )


def same_record(name: str) -> str:
    """In words."""
    return f"the same record as {name}: as evidence it would count twice"
