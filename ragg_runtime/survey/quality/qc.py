"""Quality control of a survey: everything that can be said of its lines without a model of the instrument."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.flight.mapping import Mapped
from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.by_line import LineFigures, figures_of, names
from ragg_runtime.survey.quality.crossovers import Crossing, Misfits, Repeat, crossings, misfits, repeats
from ragg_runtime.survey.quality.discs import Discs, discs_of
from ragg_runtime.survey.quality.galileo_lines import as_galileo
from ragg_runtime.survey.quality.limits import GIVEN, Limit, limits_with
from ragg_runtime.survey.quality.lines import Read, is_gradient, read_lines
from ragg_runtime.survey.quality.track import tracks
from ragg_runtime.survey.quality.trends import Day, Dependence, days, dependences, rectification


@dataclass(frozen=True, eq=False)
class Quality:
    """The result of ``qc``.

    Attributes
    ----------
    read
        The lines, and those that could not be used.
    discs
        How the channels belong together.
    lines
        Figures of every line, in the order in which they were flown.
    limits
        Name -> limit, as used.
    crossings, differences, misfits
        Where lines cross; channel -> (crossings,) differences there, levelled; what they amount to.
    repeats
        Lines that were flown again.
    dependences, days
        On heading, altitude, temperature, turbulence, vertical acceleration squared; from day to day.
    galileo
        Gaps, crossovers and repeats as galileoQC computes them.
    """

    read: Read
    discs: Discs
    lines: tuple[LineFigures, ...]
    limits: Mapping[str, Limit]
    crossings: tuple[Crossing, ...]
    differences: Mapping[str, Array]
    misfits: tuple[Misfits, ...]
    repeats: tuple[Repeat, ...]
    dependences: tuple[Dependence, ...]
    days: tuple[Day, ...]
    galileo: Mapping[str, Any]

    def names(self, of: str) -> list[str]:
        """Names of ``densities``, ``noise``, ``levels`` or ``figures`` that any line has."""
        return self._names[of]

    @cached_property
    def _names(self) -> Mapping[str, list[str]]:  # once: every line's row of a table asks
        return {of: names(self.lines, of) for of in ("densities", "noise", "levels", "figures")}

    @cached_property
    def lacking(self) -> int:
        """Lines too much of which is missing: without a figure that another line has, or without noise."""
        return sum(
            any(x.name not in f.figures for x in self.used) or bool(np.isnan(list(f.noise.values())).any())
            for f in self.lines
        )

    @property
    def failed(self) -> Mapping[str, int]:
        """Name of a limit -> lines that exceed it."""
        return Counter(n for f in self.lines for n in f.failed)

    @cached_property
    def used(self) -> list[Limit]:
        """Limits of which the record gives the figure."""
        there = self.names("figures")
        return [x for x in self.limits.values() if x.name in there]

    def median(self, of: str, name: str) -> float:
        """The median over the lines of ``densities``, ``noise`` or ``figures``."""
        values = [getattr(f, of).get(name, np.nan) for f in self.lines]
        return float(np.nanmedian(values)) if np.isfinite(values).any() else float("nan")

    def as_json(self) -> dict[str, Any]:
        return {
            "discs": {"names": list(self.discs.names), "arrangement": self.discs.arrangement},
            "lines": [f.as_json() for f in self.lines],
            "refused": [{"line": n, "message": m} for n, m in self.read.refused],
            "limits": [asdict(x) | {"failed": self.failed.get(x.name, 0)} for x in self.used],
            "crossovers": [_plain(asdict(m)) for m in self.misfits],
            "crossings": len(self.crossings),
            "repeats": [_plain(asdict(r)) for r in self.repeats],
            "dependences": [_plain(asdict(d)) for d in self.dependences],
            "days": [_plain(asdict(d)) for d in self.days],
            "galileo": dict(self.galileo),
            "notes": list(self.read.notes),
        }


def qc(
    paths: Sequence[Path],
    mapping: Mapped | None = None,
    *,
    arrangement: str | None = None,
    limits: Sequence[str] = (),
) -> Quality:
    """Quality control of the lines in some files.

    Parameters
    ----------
    paths
        Files of demodulated channels, of any format; each may hold many lines.
    mapping
        What their columns are.
    arrangement
        ``single``, ``complements`` or ``orthogonal``: see :class:`~ragg_runtime.survey.quality.discs.Discs`.
    limits
        Texts ``NAME=NUMBER`` in the place of :data:`~ragg_runtime.survey.quality.limits.LIMITS`.
    """
    known = limits_with(limits)
    read = read_lines(paths, mapping)
    discs = discs_of(read.lines, arrangement)
    flown = tracks(read.lines)
    found = tuple(figures_of(x, discs, t, known) for x, t in zip(read.lines, flown, strict=True))
    every = dict.fromkeys(n for x in read.lines for n in x.channels)
    compared = [n for n in every if n == "altitude" or is_gradient(n)]
    idle = [n for n in known if known[n].source == GIVEN and n not in names(found, "figures")]
    notes = [f"--limit {n}: these channels give no such figure" for n in idle]
    where = crossings(flown)
    fits, differences = misfits(read.lines, where, compared)
    again = repeats(read.lines, flown, compared)
    return Quality(
        read=replace(read, notes=(*read.notes, *notes)),
        discs=discs,
        lines=found,
        limits=known,
        crossings=tuple(where),
        differences=differences,
        misfits=tuple(fits),
        repeats=tuple(again),
        dependences=(*dependences(found), *rectification(found, discs)),
        days=tuple(days(found)),
        galileo=as_galileo(read.lines, flown, again, compared),
    )


def _plain(values: dict[str, Any]) -> dict[str, Any]:
    """Without what JSON does not know."""
    result: dict[str, Any] = {}
    for n, v in values.items():
        if isinstance(v, Mapping):
            result[n] = _plain(dict(v))
        elif isinstance(v, float) and not np.isfinite(v):
            result[n] = None
        else:
            result[n] = v
    return result
