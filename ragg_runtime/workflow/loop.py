"""The steps of the loop, for the command line and for notebooks: load, compare, diagnose, add, remove.

>>> import ragg_runtime.workflow.loop as ragg                      # doctest: +SKIP
>>> m = ragg.load("my-model")
>>> flights = ragg.read_flights(m, ["flight.csv"])
>>> d = ragg.diagnose(m, flights)
>>> step = ragg.add(m, d.found[0], flights)
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.diagnosis import comparison as _compare
from ragg_runtime.diagnosis import diagnose as _diagnose
from ragg_runtime.diagnosis.comparison import Comparison
from ragg_runtime.diagnosis.ladder import climb
from ragg_runtime.diagnosis.next_motion import LIMITS
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.flight import Flight
from ragg_runtime.flight.record import distinct
from ragg_runtime.instrument.units import read_quantity
from ragg_runtime.model_dir import derive
from ragg_runtime.workflow.change import Added as Added
from ragg_runtime.workflow.change import add as add
from ragg_runtime.workflow.change import errors_of as errors_of
from ragg_runtime.workflow.change import remove as remove
from ragg_runtime.workflow.loaded import NO_FORM as NO_FORM
from ragg_runtime.workflow.loaded import Loaded as Loaded
from ragg_runtime.workflow.loaded import example as example
from ragg_runtime.workflow.loaded import load as load
from ragg_runtime.workflow.loaded import mapping_of as mapping_of
from ragg_runtime.workflow.loaded import new as new
from ragg_runtime.workflow.loaded import read_flights as read_flights

if TYPE_CHECKING:
    from ragg_runtime.survey.result import Survey
    from ragg_runtime.survey.run import Progress


def compare(m: Loaded, flights: Sequence[Flight], *, ladder: bool = False) -> Comparison:
    """How far the model is from the flights, and where it fails.

    With ``ladder`` also what each of its simplifications, order and kinematics, is worth on these flights.
    """
    distinct(flights)
    c = _compare.compare(m.model, m.instrument, flights)
    if not ladder:
        return c
    return replace(
        c, ladder=climb(m.instrument, flights, lambda form: derive.without_signatures(m.instrument, form))
    )


def diagnose(
    m: Loaded,
    flights: Sequence[Flight],
    limits: Mapping[str, float] = LIMITS,
    compared: Comparison | None = None,
) -> Diagnosis:
    """Which physical effect the model lacks; ``limits`` of a motion to fly next (see :func:`motion_limits`).

    ``compared`` is the comparison of the same model with the same flights, if there is one: then nothing is fitted again.
    """
    distinct(flights)
    extended = partial(derive.with_effects, m.instrument)
    if compared is not None:
        return _diagnose.diagnose_fitted(compared.fitted, flights, extended, limits)
    return _diagnose.diagnose(m.model, m.instrument, flights, extended, limits)


LIMIT_UNITS = {"a": "m/s^2", "omega": "rad/s", "jerk": "m/s^3", "alpha": "rad/s^2"}


def motion_limits(m: Loaded, texts: Sequence[str]) -> Mapping[str, float]:
    """Largest amplitudes of a motion to fly next, and of its rates of change, SI, from texts such as ``a=50mg``."""
    found = dict(LIMITS)
    for text in texts:
        name, _, size = text.partition("=")
        if name not in LIMIT_UNITS or not size:
            raise UserError(
                "the limit of a motion cannot be read",
                where="--limit",
                found=text,
                expected="a=50mg, omega=500deg/h, jerk=1m/s^3 or alpha=1deg/s^2",
            )
        q = read_quantity(size, f"--limit {name}", count=1)
        value = m.instrument.units.to_si(np.asarray(q.value), q.unit, LIMIT_UNITS[name], f"--limit {name}")
        if not float(value) > 0.0:
            raise UserError("the limit of a motion must be positive", where=f"--limit {name}", found=size)
        found[name] = float(value)
    return MappingProxyType(found)


def survey(
    m: Loaded,
    flights: Sequence[Path | str],
    *,
    jobs: int | None = None,
    scheduler: str | None = None,
    resume: Path | None = None,
    progress: Progress | None = None,
    mapping: Path | None = None,
) -> Survey:
    """Diagnose many flights, each by itself, on a pool of processes or a Dask cluster, and sum them up.

    The arguments are those of :func:`ragg_runtime.survey.run.survey`.
    """
    place = m.directory.path / "model.toml"
    how = mapping_of(m, mapping)
    from ragg_runtime.survey.run import survey as of_many  # slow to import, and only surveys need it

    return of_many(
        m.directory.text,
        place,
        flights,
        jobs=jobs,
        scheduler=scheduler,
        resume=resume,
        progress=progress,
        mapping=None if how is None else (read_text(how.path), str(how.path.resolve()), how.kept),
    )


def sources(m: Loaded, flights: Sequence[Flight]) -> list[tuple[str, str]]:
    """(name, sha256) of everything that a result depends on."""
    text = hashlib.sha256(m.directory.text.encode()).hexdigest()
    return [(f"{m.name}/model.toml", text), *((x.name, x.digest) for x in flights)]
