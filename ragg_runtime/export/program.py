"""A calibrated model as a C program that turns a CSV of motion into G_out."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.export.contents import Contents, is_gradient, unit_of
from ragg_runtime.export.online import online_values, table
from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SI_UNITS
from ragg_runtime.signals.derivative import WINDOW, weights

Array = NDArray[np.float64]

TOLERANCE_EO = 1e-6
"""Largest difference of C and Python, Eo, that `make check` allows."""

SPELLINGS: Mapping[str, str] = {
    "m/s^2": "m/s^2|m/s2|m/s**2|m s^-2",
    "rad/s": "rad/s|1/s|rad s^-1",
    "rad/s^2": "rad/s^2|rad/s2|rad/s**2|1/s^2|rad s^-2",
    "s^-2": "s^-2|1/s^2|1/s2|1/s**2|s**-2",
}
"""How people write an SI unit; other units are taken as they are written in the flight's documentation."""

NOTHING, ZERO = -1, -2
"""What stands for a column that is not there: it is needed; zero. Else the number of the column that it derives from."""


def c_program(c: Contents) -> dict[str, str]:
    """File name -> text of everything that `make` needs, with a test."""
    name = next(n.removesuffix(".c") for n in c.sources if n.endswith(".c"))
    makefile = _packaged("Makefile").replace("@MODEL@", name)
    return {
        "Makefile": makefile.replace("@TOLERANCE@", f"{TOLERANCE_EO * abs(c.scale_factor):.3g}"),
        "README.txt": _readme(c),
        **{n: _packaged(n) for n in ("main.c", "compare.c", "online.h", "online.c", "online_main.c")},
        "online_values.h": online_values(c),
        **{n: c.model.sources[n] for n in ("chain.c", "chain.h")},
        **c.sources,
        "values.h": _values(c, name),
        **example_files(c),
    }


def example_files(c: Contents) -> dict[str, str]:
    """A short motion as a CSV, and the model's answer to it."""
    motion, G = c.example()
    return {
        "test/motion.csv": table({f"{n} [{unit_of(n)}]": x for n, x in motion.items()}),
        "test/G_out.csv": table({"time": motion["time"], "G_out": G}),
    }


def _packaged(name: str) -> str:
    return resources.files("ragg_runtime.export").joinpath("c", name).read_text("utf-8")


def _readme(c: Contents) -> str:
    effects = ", ".join(e.id for e in c.model.effects) or "none"
    needed = ", ".join(f"{n} [{unit_of(n)}]" for n in c.columns() if not is_gradient(n))
    return textwrap.dedent(
        f"""\
        The instrument model {c.name} as a C program.
        Values: {c.origin}. Effects beyond the paper's instrument: {effects}.

        make                                          builds ragg_model
        make check                                    holds it against the answer that Python gave
        ./ragg_model < MOTION.csv > OUT.csv           G_out, V, of a record of motion
        ./ragg_model --values                         the parameters that are built in
        online.h                                      calibration and compensation sample by sample, no allocation

        Columns that MOTION.csv must have, in SI units: time [s], {needed}.
        omegadot_x, omegadot_y, omegadot_z are derived from omega where they are missing (runs of {WINDOW} rows or more).
        Gradients (Gamma_xx ... [s^-2]) are zero where they are missing; spin_angle [rad] replaces 2 pi f t.
        """
    )


def _values(c: Contents, name: str) -> str:
    """values.h: the model's columns, inputs and parameters as tables."""
    columns = ["time", "spin_angle", *c.columns()]
    absent = [_absent(n, columns) for n in columns]
    inputs = [f"{{{columns.index(x.column)}, {x.derivative}}}, /* {x.name} */" for x in c.inputs()]
    rows, names, si = [], [], []
    for v in c.values():
        for j, x in enumerate(v.values, 1):
            label = v.name if len(v.values) == 1 else f"{v.name}[{j}]"
            rows.append(f"{float(x):.17g}, /* {_comment(f'{label}, {v.unit}: {v.meaning}')} */")
            names.append(f'"{_text(label)}",')
            si.append(f'"{_text(v.unit)}",')
    table = [f'{{"{_text(n)}", "{_text(_accepted(n))}", {a}}},' for n, a in zip(columns, absent, strict=True)]
    half = WINDOW // 2
    slopes = [", ".join(f"{x:.17g}" for x in weights(WINDOW, k)) for k in range(half + 1)]
    return "\n".join(
        [
            f"/* The model {_comment(c.name)}: {_comment(c.origin)}. Everything is in SI units. */",
            "#ifndef RAGG_VALUES_H",
            "#define RAGG_VALUES_H",
            "",
            f'#include "{name}.h"',
            "",
            f"#define MODEL ragg_{name}_output",
            "",
            f"enum {{ COLUMNS = {len(columns)}, INPUTS = {len(inputs)}, PARAMETERS = {len(rows)}, WINDOW = {WINDOW} }};",
            "enum { TIME = 0, SPIN_ANGLE = 1 };",
            f"enum {{ NEEDED = {NOTHING}, ZERO = {ZERO} }};",
            "",
            "/* Name, accepted spellings of the unit, and what stands for a column that is not there. */",
            "static const struct { const char *name, *units; int absent; } COLUMN[COLUMNS] = {",
            *_indented(table),
            "};",
            "",
            "/* Which column each input of the model is, and how often it is differentiated by time. */",
            "static const struct { int column, derivative; } INPUT[INPUTS] = {",
            *_indented(inputs),
            "};",
            "",
            "static const double PARAMETER[PARAMETERS] = {",
            *_indented(rows),
            "};",
            "static const char *const PARAMETER_NAME[PARAMETERS] = {",
            *_indented(names),
            "};",
            "static const char *const PARAMETER_UNIT[PARAMETERS] = {",
            *_indented(si),
            "};",
            "",
            "/* Weights of a window of samples for the derivative, per sample, at its first, second ... middle sample. */",
            "static const double DERIVATIVE[WINDOW / 2 + 1][WINDOW] = {",
            *_indented([f"{{{row}}}," for row in slopes]),
            "};",
            "",
            "#endif",
            "",
        ]
    )


def _absent(column: str, columns: Sequence[str]) -> int:
    if column == "spin_angle" or is_gradient(column):
        return ZERO
    if column in ANGULAR_ACCELERATION:
        return columns.index(ANGULAR_RATE[ANGULAR_ACCELERATION.index(column)])
    return NOTHING


def _accepted(column: str) -> str:
    return SPELLINGS.get(SI_UNITS[column], SI_UNITS[column]) if column in SI_UNITS else "*"


def _indented(lines: Sequence[str]) -> list[str]:
    return [f"    {line}" for line in lines]


def _text(x: str) -> str:
    """Inside a C string: names may be those of a stranger's file."""
    return "".join(ch if ch.isascii() and ch.isprintable() and ch not in '"\\?' else "_" for ch in x)


def _comment(x: str) -> str:
    return (
        "".join(ch if ch.isprintable() and ch != "\\" else "_" for ch in x)
        .replace("*/", "* /")
        .replace("/*", "/ *")
    )
