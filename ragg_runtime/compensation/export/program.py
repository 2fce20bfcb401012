"""The forms in which a model is exported, the C program above all, and the folder that they are written into."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from derive.names import in_comment
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.compensation.export.contents import CODES, DISC, Contents, unit_of
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, GRADIENT
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.derivative import DEGREES, REACH, WINDOW, weights, wide_weights
from ragg_runtime.wording.sections import make_environment

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
    makefile = _packaged("Makefile").replace("@MODEL@", model).replace("@TOLERANCE@", f"{tolerance:.3g}")
    needed = [f"{n} [{unit_of(n)}]" for n in c.columns() if _is_needed(n)]
    return {
        "Makefile": makefile,
        "README.txt": _render("README.txt", c=c, outputs=outputs, needed=needed),
        **{n: _packaged(n) for n in PROGRAM},
        **c.sources,
        "values.h": write_values(c, model),
        **make_tests(c),
    }


def _packaged(name: str) -> str:
    return resources.files("ragg_runtime.compensation.export").joinpath("c", name).read_text("utf-8")


def _render(template: str, **values: object) -> str:
    filters = {"comment": in_comment, "digits": "{:.17g}".format}
    env = make_environment("ragg_runtime.compensation.export", filters)
    return env.get_template(f"{template}.j2").render(values)


def _is_needed(column: str) -> bool:
    """Whether a record must have a column: else it is zero, or derived."""
    return column not in ANGULAR_ACCELERATION and column not in GRADIENT


def write_values(c: Contents, name: str) -> str:
    """values.h of a model whose C is ``name``.c."""
    outputs, discs, motion = c.outputs(), c.discs(), c.columns()
    if {*motion} & {*ANGULAR_ACCELERATION}:  # three and three, one after the other
        whole = [*ANGULAR_RATE, *ANGULAR_ACCELERATION]
        motion = [*whole, *(n for n in motion if n not in whole)]
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
    slopes = {
        "short": [weights(WINDOW, k).tolist() for k in range(WINDOW // 2 + 1)],
        "long": wide_weights().tolist(),
        "spin": {"seconds": SPIN_WINDOW, "most": HALO, "degrees": DEGREES},
    }
    here = resources.files("ragg_runtime.compensation.export")
    return {
        **make_json(c),
        "chain.py": c.module,
        "derivative.json": f"{json.dumps(slopes)}\n",
        "ragg_model.py": here.joinpath("python", "ragg_model.py").read_text("utf-8"),
        **make_tests(c),
    }


def make_json(c: Contents) -> Files:
    """One document."""
    return {"model.json": json.dumps(c.document(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"}


def make_tests(c: Contents) -> Files:
    """Two short motions with the model's answers; the second without angular acceleration but with encoders."""
    found = {}
    for name, derived in (("motion", False), ("derived_motion", True)):
        motion, outputs = c.example(derived=derived)
        columns = {f"{n} [{unit_of(n)}]": x for n, x in motion.items()}
        found[f"test/{name}.csv"] = format_csv(columns | {f"{n} [V]": x for n, x in outputs.items()})
    return found


def format_csv(columns: Mapping[str, NDArray[np.float64]]) -> str:
    """Columns as CSV with 17 digits."""
    rows = zip(*columns.values(), strict=True)
    return "\n".join([",".join(columns), *(",".join(f"{x:.17g}" for x in row) for row in rows)]) + "\n"


FORMS: Mapping[str, Callable[[Contents], Files]] = MappingProxyType(
    {"c": make_c, "numpy": make_numpy, "json": make_json}
)
"""Form of an export -> its files."""

MARK = ".ragg-export"
"""The file by which a folder is known as that of an export; what an earlier one wrote is replaced file by file."""


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
