"""Export of a calibrated model as a C program, NumPy or JSON, each with a short motion and the model's outputs for it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from derive.names import in_comment
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.compensation.calibrate import Saved
from ragg_runtime.instrument.instrument import DISC_UNITS, PARAMETER, Instrument
from ragg_runtime.instrument.units import units
from ragg_runtime.io import Flight
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, GRADIENT, SI_UNITS, is_disc_angle
from ragg_runtime.model.memory import list_late
from ragg_runtime.model.model import Model, name_values, scale_factor
from ragg_runtime.model.record import HALO, SPIN, SPIN_WINDOW, record
from ragg_runtime.signals.derivative import DEGREES, REACH, WINDOW, differentiate_rate, weights, wide_weights
from ragg_runtime.wording.sections import make_environment

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
        u = units(self.instrument.g0)
        texts = {n: (q.si_unit, q.description) for n, q in PARAMETER.items()}
        texts |= {n: (unit, "of the disc") for n, unit in DISC_UNITS.items()}
        for e in self.model.effects:
            texts |= {q.symbol: (u.base_unit(q.unit), f"{e.id}: {q.meaning}") for q in e.parameters}
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
        inputs = []
        for name in self.model.chain.INPUTS:
            match = None if name in SI_UNITS else re.fullmatch(r"d(?P<order>2?)_(?P<of>.+)", name)
            column, order = name, 0
            if name in SPIN:
                column, order = DISC, 1 + SPIN.index(name)
            elif match is not None:
                column, order = match["of"], int(match["order"] or 1)
            inputs.append({"name": name, "column": column, "derivative": order, "unit": unit_of(column)})
        return inputs

    def columns(self) -> list[str]:
        """The columns of a flight that the model reads, besides ``time`` and the disc angles."""
        return list(dict.fromkeys(x["column"] for x in self.inputs() if x["column"] != DISC))

    def limits(self) -> list[str]:
        """Limits of the exported program against Python, in sentences."""
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
        return columns, self._compute_outputs(columns)

    def _compute_outputs(self, columns: Mapping[str, Array]) -> dict[str, Array]:
        """The outputs by the form that is exported."""
        wide = {n: x for n, x in columns.items() if n != "time"}
        for name, rate in zip(ANGULAR_ACCELERATION, ANGULAR_RATE, strict=True):
            if name not in wide and rate in wide:
                wide[name] = differentiate_rate(wide[rate], RATE)[0]
        x = Flight(time=columns["time"], channels=wide, outputs={})
        chain, outputs = replace(self.model.chain, sources={}), {}
        if "folded.c" not in self.sources:
            chain = replace(chain, folded=None)
        for k, o in enumerate(self.instrument.layout.outputs):
            r = record(x, self.instrument, k)
            outputs[o.name] = chain.output(r.time, r.inputs(chain), self.p, r.phi, which=k)
        return outputs

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


# --- The forms of an export, and the folder that they are written into ---

TOLERANCE_EO = 1e-6
"""Largest difference of C and Python, Eo, that `make check` allows."""

PROGRAM = ("main.c", "derivative.h")

SPELLINGS: Mapping[str, str] = {
    "m/s^2": "m/s^2|m/s2|m/s**2|m s^-2",
    "rad/s": "rad/s|1/s|rad s^-1",
    "rad/s^2": "rad/s^2|rad/s2|rad/s**2|1/s^2|rad s^-2",
    "s^-2": "s^-2|1/s^2|1/s2|1/s**2|s**-2",
    "1": "1|m|s|kg|A|K|V|T|Pa|Hz|N|J|W|C|ohm|rad|m/s|m/s^2|rad/s|rad/s^2|1/s|1/s^2|T/s|K/s|Pa/s",
}
"""How people write an SI unit; of channels of no fixed meaning, the units that an effect is likely to need."""


Files = Mapping[str, str]
"""File name -> text."""


def make_c(c: Contents) -> Files:
    """A C program with its tests."""
    model = next(n.removesuffix(".c") for n in c.sources if n.endswith(".c"))
    outputs = c.outputs()
    tolerance = TOLERANCE_EO * min(abs(o["scale_factor"]["value"]) for o in outputs)
    makefile = _read_packaged("Makefile").replace("@MODEL@", model).replace("@TOLERANCE@", f"{tolerance:.3g}")
    needed = [f"{n} [{unit_of(n)}]" for n in c.columns() if _is_needed(n)]
    return {
        "Makefile": makefile,
        "README.txt": _render("README.txt", c=c, outputs=outputs, needed=needed),
        **{n: _read_packaged(n) for n in PROGRAM},
        **c.sources,
        "values.h": write_values(c, model),
        **make_tests(c),
    }


def _read_packaged(name: str) -> str:
    return resources.files(__name__).joinpath("c", name).read_text("utf-8")


def _render(template: str, **values: object) -> str:
    filters = {"comment": in_comment, "digits": "{:.17g}".format}
    env = make_environment(__name__, filters)
    return env.get_template(f"{template}.j2").render(values)


def _is_needed(column: str) -> bool:
    """Whether a record must have a column: else it is zero, or derived."""
    return column not in ANGULAR_ACCELERATION and column not in GRADIENT


def write_values(c: Contents, name: str) -> str:
    """values.h of a model whose C is ``name``.c."""
    outputs, discs, motion = c.outputs(), c.discs(), c.columns()
    if {*motion} & {*ANGULAR_ACCELERATION}:  # three and three, one after the other
        angular = [*ANGULAR_RATE, *ANGULAR_ACCELERATION]
        motion = [*angular, *(n for n in motion if n not in angular)]
    columns = ["time", *discs, *motion, *(o["name"] for o in outputs)]
    parameters = [
        (x, v["name"] if len(v["values"]) == 1 else f"{v['name']}[{j}]", v["unit"], v["meaning"])
        for v in c.parameters()
        for j, x in enumerate(v["values"], 1)
    ]
    return _render(
        "values.h",
        c=c,
        name=name,
        outputs=outputs,
        discs=discs,
        columns=columns,
        place={n: k for k, n in enumerate(columns)} | {DISC: -1},
        needed={"time", *filter(_is_needed, motion)},
        codes=[(-1, x) for x in CODES]
        + [(columns.index(n), x) for n in c.null if n in columns for x in c.null[n]],
        units={n: SPELLINGS.get(unit_of(n), unit_of(n)) for n in columns} | {o["name"]: "V" for o in outputs},
        inputs=c.inputs(),
        from_first=c.instrument.angle_origin == "first-sample",
        parameters=parameters,
        short=[weights(WINDOW, k).tolist() for k in range(WINDOW // 2 + 1)],
        wide=wide_weights()[: REACH + 1].tolist(),
        spin_window=SPIN_WINDOW,
        spin_most=HALO,
        degrees=DEGREES,
    )


def make_numpy(c: Contents) -> Files:
    """A folder that needs only NumPy."""
    short = [weights(WINDOW, k).tolist() for k in range(WINDOW // 2 + 1)]
    slopes = {"short": short, "long": wide_weights().tolist()}
    package = resources.files(__name__)
    return {
        **make_json(c),
        "chain.py": c.module,
        "derivative.json": f"{json.dumps(slopes)}\n",
        "ragg_model.py": package.joinpath("python", "ragg_model.py").read_text("utf-8"),
        **make_tests(c),
    }


def make_json(c: Contents) -> Files:
    """One document."""
    return {"model.json": json.dumps(c.document(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"}


def make_tests(c: Contents) -> Files:
    """Two short motions with the model's answers; the second without angular acceleration but with encoders."""
    files = {}
    for name, derived in (("motion", False), ("derived_motion", True)):
        motion, outputs = c.example(derived=derived)
        header = [*(f"{n} [{unit_of(n)}]" for n in motion), *(f"{n} [V]" for n in outputs)]
        rows = zip(*motion.values(), *outputs.values(), strict=True)
        lines = [",".join(header), *(",".join(f"{x:.17g}" for x in row) for row in rows)]
        files[f"test/{name}.csv"] = "\n".join(lines) + "\n"
    return files


FORMS: Mapping[str, Callable[[Contents], Files]] = {"c": make_c, "numpy": make_numpy, "json": make_json}
"""Form of an export -> its files."""

MARK = ".ragg-export"
"""The file that marks a folder as an export, which a later export may replace file by file."""


def write_export(c: Contents, folder: Path, form: str) -> list[Path]:
    """Write what is exported into a folder; the files. UserError if the folder holds anything else."""
    if form not in FORMS:
        raise UserError("unknown form of export", found=repr(form), expected=", ".join(FORMS))
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARK).is_file():
        raise UserError(
            "the folder is not empty and was not made by an export",
            where=folder,
            remedy="name another folder, or empty this one",
        )
    files = FORMS[form](c)
    for name, text in {MARK: "\n".join(sorted(files)) + "\n", **files}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        write_text(folder / name, text)
    return [folder / name for name in (MARK, *files)]
