"""What is exported of a model: its parameters, inputs and outputs, and a short motion with the model's answer to it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.instrument.instrument import DISC_UNITS, PARAMETER, Instrument
from ragg_runtime.instrument.units import units
from ragg_runtime.io import Flight
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SI_UNITS, is_disc_angle
from ragg_runtime.model.memory import list_late
from ragg_runtime.model.model import Model, name_values, scale_factor
from ragg_runtime.model.record import SPIN, record
from ragg_runtime.signals.derivative import differentiate_rate

Array = NDArray[np.float64]
Json = dict[str, Any]

ROWS, RATE = 400, 16.0
"""Samples and rate, Hz, of the motions that go with an export."""

DISC = "disc"
"""Stands for the column of an input that is the angle of the output's own disc."""

SIZES: Mapping[str, tuple[float, float]] = {
    "a": (0.1, 0.15),
    "omega": (5e-4, 7e-4),
    "Gamma": (1e-7, 5e-8),
    "temperature": (293.0, 2.0),
    "pressure": (9e4, 1e3),
    "B": (2e-5, 1e-5),
    "roll": (0.02, 0.05),
    "pitch": (-0.01, 0.05),
}
"""Mean and amplitude of the channels of an example, SI."""


CODES = (-999.0, -999.25, -999.9, -9999.0, -9999.9, -99999.0, -999999.0, -32768.0)
"""Numbers that an exported program takes for missing values in every column but time: usual ones that no quantity in SI units has."""


@dataclass(frozen=True)
class Contents:
    """A model with its values.

    ``p`` (size,) SI. ``sources``: the model in C, file name -> text; ``module``: its chain in NumPy. ``origin``: where
    the values come from; ``saved``: the calibration, if they come from one. ``null``: column -> numbers that stand for a missing
    value in it, by the mapping.
    """

    name: str
    model: Model
    instrument: Instrument
    p: Array
    sources: Mapping[str, str]
    module: str
    origin: str
    saved: Saved | None = None
    null: Mapping[str, Sequence[float]] = field(default_factory=dict)

    def outputs(self) -> list[Json]:
        """In the order of model.toml; accelerometers are counted from 0."""
        layout, discs = self.instrument.layout, self.discs()
        return [
            {
                "name": o.name,
                "unit": "V",
                "is": layout.formula(o, [layout.voltage_columns(j)[0] for j in o.members]),
                "accelerometers": list(o.members),
                "signs": list(o.signs),
                "spin_angle": layout.discs[o.disc].angle_column,
                "spin_frequency": float(self.p[discs[layout.discs[o.disc].angle_column]]),
                "scale_factor": {"value": scale_factor(self.model, self.p, k), "unit": "V/Eo"},
            }
            for k, o in enumerate(layout.outputs)
        ]

    def discs(self) -> dict[str, int]:
        """The columns of the discs' angles, and the places of their rates in the parameter vector."""
        layout = self.instrument.layout
        return {
            layout.discs[o.disc].angle_column: 1 if layout.like_paper else layout.size + o.members[0]
            for o in layout.outputs
        }

    def parameters(self) -> list[Json]:
        """The parameters in the order of the vector, SI."""
        known = units(self.instrument.g0)
        texts = {n: (q.si_unit, q.description) for n, q in PARAMETER.items()}
        texts |= {n: (unit, "of the disc") for n, unit in DISC_UNITS.items()}
        for e in self.model.effects:
            texts |= {q.symbol: (known.base_unit(q.unit), f"{e.id}: {q.meaning}") for q in e.parameters}
        values = name_values(self.model.chain, self.p)
        return [
            {"name": n, "unit": texts[n][0], "meaning": texts[n][1], "values": x.tolist()}
            for n, x in values.items()
        ]

    def inputs(self) -> list[Json]:
        """The series that the model reads, in order: a column of the flight, or a time derivative of one; of :data:`DISC` one a disc."""
        for e in self.model.effects:
            if e.memory is not None:
                raise UserError(
                    f"a model with the effect {e.id} cannot be exported",
                    where="model.toml, effects",
                    found="its output depends on the motion of many seconds before and after each sample",
                    expected="effects without memory (resonances, hysteresis, creep and heat have one)",
                    remedy=f"ragg remove the effect {e.id}, or use ragg compensate",
                )
        found = []
        for name in self.model.chain.INPUTS:
            match = None if name in SI_UNITS else re.fullmatch(r"d(?P<order>2?)_(?P<of>.+)", name)
            column, order = name, 0
            if name in SPIN:
                column, order = DISC, 1 + SPIN.index(name)
            elif match is not None:
                column, order = match["of"], int(match["order"] or 1)
            found.append({"name": name, "column": column, "derivative": order, "unit": unit_of(column)})
        return found

    def columns(self) -> list[str]:
        """The columns of a flight that the model reads, besides ``time`` and the disc angles."""
        return list(dict.fromkeys(x["column"] for x in self.inputs() if x["column"] != DISC))

    def limits(self) -> list[str]:
        """What is described less well than by Python, in words."""
        return [
            f"{q.symbol} delays the motion: a series of second order in it, accurate while it is far below the time scale of the "
            "motion (ragg itself interpolates the motion at the delayed instants)"
            for k, q in list_late(self.model)
            if self.p[k]
        ]

    def example(self, *, derived: bool = False) -> tuple[dict[str, Array], dict[str, Array]]:
        """Columns (name -> (N,), SI) of a lively motion, ``time`` first, and the outputs (N,), V, that the model makes of it.

        ``derived``: without angular acceleration, but with encoders.
        """
        t = np.arange(ROWS) / RATE
        rng = np.random.default_rng(0)
        columns: dict[str, Array] = {"time": t}
        for name in self.columns():
            if name in columns:
                continue
            mean, size = SIZES.get(name.partition("_")[0], (0.1, 1.0))
            f, angle = rng.uniform(0.05, 1.0), rng.uniform(0.0, 2 * np.pi)
            columns[name] = mean + size * np.sin(2 * np.pi * f * t + angle)
            if name in ANGULAR_RATE and (change := f"omegadot{name[5:]}") in self.columns():
                columns[change] = size * 2 * np.pi * f * np.cos(2 * np.pi * f * t + angle)
        if derived:
            columns = {n: x for n, x in columns.items() if n not in ANGULAR_ACCELERATION}
            for name, k in self.discs().items():
                turned = 2 * np.pi * float(self.p[k]) * t + 1e-3 * np.sin(0.7 * t)
                columns[name] = np.mod(turned, 2 * np.pi)
        return columns, self._answer(columns)

    def _answer(self, columns: Mapping[str, Array]) -> dict[str, Array]:
        """The outputs by the form that is exported."""
        wide = {n: x for n, x in columns.items() if n != "time"}
        for name, rate in zip(ANGULAR_ACCELERATION, ANGULAR_RATE, strict=True):
            if name not in wide and rate in wide:
                wide[name] = differentiate_rate(wide[rate], RATE)[0]
        x = Flight(time=columns["time"], channels=wide, outputs={})
        chain, found = replace(self.model.chain, sources={}), {}
        if "folded.c" not in self.sources:
            chain = replace(chain, folded=None)
        for k, o in enumerate(self.instrument.layout.outputs):
            r = record(x, self.instrument, k)
            found[o.name] = chain.output(r.time, r.inputs(chain), self.p, r.phi, which=k)
        return found

    def document(self) -> Json:
        """The model's description, its parameters with units, its inputs and outputs, and an example with its answer."""
        motion, answers = self.example()
        return {
            "model": self.name,
            "origin": self.origin,
            "derivation": self.model.digest,
            "angle_origin": self.instrument.angle_origin or "zero",
            "g0": {"value": self.instrument.g0, "unit": "m/s^2"},
            "effects": [
                {name: getattr(e, name) for name in ("id", "title", "physics", "equation", "source")}
                for e in self.model.effects
            ],
            "parameters": self.parameters(),
            "inputs": self.inputs(),
            "outputs": self.outputs(),
            "missing": {"": CODES, **self.null},
            "calibration": None if self.saved is None else self.saved.as_json(),
            "example": {
                "columns": {n: x.tolist() for n, x in motion.items()},
                **{n: x.tolist() for n, x in answers.items()},
            },
        }


def unit_of(column: str) -> str:
    """SI unit of a column, for one of no fixed meaning ``1``."""
    return SI_UNITS.get(column, "rad" if column == DISC or is_disc_angle(column) else "1")
