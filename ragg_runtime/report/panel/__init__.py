"""Panels at the end of a report: one file each, found by its name, in the order of the names.

A file has ``REPORTS`` (``compare``, ``diagnose``, ``add``) and ``panel(shown)``, which gives a :class:`Panel` or ``None``.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.fit.fitted import Fitted

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Shown:
    """What a report is about.

    Attributes
    ----------
    fitted
        The flights with the model as it was fitted last: of a diagnosis with what was found, of ``add`` with the effect.
    residual
        (N,) V of every flight, what that model leaves.
    before
        The same before the effect was added.
    diagnosis
        Of a report of ``diagnose``.
    """

    fitted: Fitted
    residual: Sequence[Array]
    before: Sequence[Array] | None = None
    diagnosis: Diagnosis | None = None


@dataclass(frozen=True)
class Panel:
    """A section of a page: heading, sentences, lines to be copied, and figures (``report.page.figure``)."""

    title: str
    text: Sequence[str] = ()
    code: Sequence[str] = ()
    figures: Sequence[Mapping[str, Any]] = ()


class PanelFile(Protocol):
    """A module of this folder."""

    @property
    def REPORTS(self) -> Sequence[str]:
        """The reports that have this panel."""

    def panel(self, shown: Shown) -> Panel | None:
        """The panel; ``None`` where there is nothing to show. The same input gives the same bytes."""


@cache
def files() -> tuple[PanelFile, ...]:
    """The modules of this folder."""
    names = sorted(m.name for m in pkgutil.iter_modules(__path__))
    return tuple(cast(PanelFile, importlib.import_module(f"{__name__}.{n}")) for n in names)


def panels_of(report: str, shown: Shown) -> list[Panel]:
    """The panels of a report, in the order of their files."""
    found = (f.panel(shown) for f in files() if report in f.REPORTS)
    return [p for p in found if p is not None]
