"""How the discs of a simulated flight turn: as ``--spin`` says, or as the flown record's encoders did."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.reference.turning import Turning

Array = NDArray[np.float64]

FORM = "[DISC:]HZ[,RAD@HZ[@RAD]]..."
"""A steady rate (negative: backwards, 0: none) and swings: amplitude, frequency, phase at the beginning."""


def turning_of(given: Sequence[str], layout: Layout, motion: Flight | None = None) -> dict[str, Turning]:
    """Name of a disc -> how it turns; of others their sheet's rate holds.

    ``given`` are texts of the form FORM, for the disc named or for all; they go before the angles that ``motion`` has.
    """
    found = {} if motion is None else _recorded(motion, layout)
    for text in given:
        name, colon, profile = text.rpartition(":")
        known = [d.name for d in layout.discs]
        if colon and name not in known:
            raise UserError(
                f"the instrument has no disc {name!r}",
                where="--spin",
                expected=", ".join(known) or "no name: the instrument has one disc",
            )
        found |= dict.fromkeys([name] if colon else known, _profile(profile, text))
    return found


def _recorded(motion: Flight, layout: Layout) -> dict[str, Turning]:
    columns: Mapping[str, Array] = motion.channels
    time = motion.time - motion.time[0]
    return {
        d.name: Turning.of_record(time, columns[d.angle_column])
        for d in layout.discs
        if d.angle_column in columns
    }


def _profile(profile: str, text: str) -> Turning:
    steady, *swings = profile.split(",")
    try:
        frequency = float(steady)
        parts = [tuple(float(x) for x in s.split("@")) for s in swings]
    except ValueError:
        raise _misread(text) from None
    numbers = [frequency, *(x for s in parts for x in s)]
    if any(len(s) not in (2, 3) or s[1] <= 0 for s in parts) or not np.all(np.isfinite(numbers)):
        raise _misread(text)
    return Turning(
        frequency=frequency, swings=tuple((s[0], s[1], s[2] if len(s) == 3 else 0.0) for s in parts)
    )


def _misread(text: str) -> UserError:
    return UserError(
        "the turning of a disc is not understood",
        where="--spin",
        found=repr(text),
        expected=FORM,
        remedy="0.25,0.4@0.05 swings by 0.4 rad every 20 s about 0.25 Hz; 0 stands still",
    )
