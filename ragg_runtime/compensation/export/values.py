"""values.h: the columns, inputs, outputs and parameters of a model, as tables in C."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ragg_runtime.compensation.export.contents import DISC, Contents, is_gradient, unit_of
from ragg_runtime.flight.angular_acceleration import REACH, wide_weights
from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SI_UNITS
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.derivative import DEGREES, WINDOW, weights

SPELLINGS: Mapping[str, str] = {
    "m/s^2": "m/s^2|m/s2|m/s**2|m s^-2",
    "rad/s": "rad/s|1/s|rad s^-1",
    "rad/s^2": "rad/s^2|rad/s2|rad/s**2|1/s^2|rad s^-2",
    "s^-2": "s^-2|1/s^2|1/s2|1/s**2|s**-2",
}
"""How people write an SI unit; other units are taken as they are written in the flight's documentation."""


def values_header(c: Contents, name: str) -> str:
    """values.h of a model whose C is ``name``.c."""
    return "\n".join(
        [
            f"/* The model {comment(c.name)}: {comment(c.origin)}. Everything is in SI units. */",
            "#ifndef RAGG_VALUES_H",
            "#define RAGG_VALUES_H",
            "",
            f'#include "{name}.h"',
            "",
            "/* An output by the model. */",
            _model(name),
            "",
            *_columns(c),
            *_parameters(c),
            *_derivatives(),
            "#endif",
            "",
        ]
    )


def _model(name: str) -> str:
    head = "#define MODEL(which, n, t, in, p, angle, G) "
    if name == "folded":  # the paper's one output
        return head + "((void)(which), ragg_folded_output(n, t, in, p, angle, G))"
    return head + f"ragg_{name}_output(which, n, t, in, p, angle, G)"


def _columns(c: Contents) -> list[str]:
    """Columns of a record, discs, outputs, and which column each input is."""
    outputs, angles = c.outputs(), c.angles()
    motion = c.columns()
    if set(motion) & set(ANGULAR_ACCELERATION):  # three and three, one after the other
        whole = {*ANGULAR_RATE, *ANGULAR_ACCELERATION}
        motion = [*ANGULAR_RATE, *ANGULAR_ACCELERATION, *(n for n in motion if n not in whole)]
    columns = ["time", *angles, *motion, *(o.name for o in outputs)]
    omega, omegadot = (
        columns.index(names[0]) if names[0] in columns else -1
        for names in (ANGULAR_RATE, ANGULAR_ACCELERATION)
    )
    spins = {o.angle_column: o.spin for o in outputs}
    places = {n: k for k, n in enumerate(columns)} | {DISC: -1}
    count = {
        "COLUMNS": len(columns), "INPUTS": len(c.inputs()), "OUTPUTS": len(outputs), "DISCS": len(angles),
    }  # fmt: skip
    place = {
        "TIME": 0, "DISC_ANGLE": -1, "OMEGA": omega, "OMEGADOT": omegadot,
        "FIRST_OUTPUT": len(columns) - len(outputs),
    }  # fmt: skip
    needed = {*motion} - {*ANGULAR_ACCELERATION} - {n for n in motion if is_gradient(n)} | {"time"}
    volts = {o.name for o in outputs}
    given = (f'{{"{text(n)}", "{_accepted(n, volts)}", {int(n in needed)}}},' for n in columns)
    inputs = (f"{{{places[x.column]}, {x.derivative}}}, /* {x.name} */" for x in c.inputs())
    return [
        _enum(count),
        _enum(place),
        "",
        "/* Name, accepted spellings of the unit, and whether it must be there (else it is zero, or derived). */",
        *_table("const struct { const char *name, *units; int needed; } COLUMN[COLUMNS]", given),
        "/* Column of a disc's angle, and the parameter that is its rate. */",
        *_table(
            "const struct { int column, spin; } DISC[DISCS]",
            (f"{{{places[n]}, {spins[n]}}}," for n in angles),
        ),
        *_table(
            "const struct { const char *name, *ending; int disc; } OUTPUT[OUTPUTS]",
            (f'{{"{text(o.name)}", "{text(o.ending)}", {angles.index(o.angle_column)}}},' for o in outputs),
        ),
        "/* Which column each input of the model is (DISC_ANGLE: the disc's), and how often it is differentiated by time. */",
        *_table("const struct { int column, derivative; } INPUT[INPUTS]", inputs),
    ]


def _parameters(c: Contents) -> list[str]:
    rows, names, si = [], [], []
    for v in c.values():
        for j, x in enumerate(v.values, 1):
            label = v.name if len(v.values) == 1 else f"{v.name}[{j}]"
            rows.append(f"{float(x):.17g}, /* {comment(f'{label}, {v.unit}: {v.meaning}')} */")
            names.append(f'"{text(label)}",')
            si.append(f'"{text(v.unit)}",')
    return [
        _enum({"PARAMETERS": len(rows)}),
        *_table("const double PARAMETER[PARAMETERS]", rows),
        *_table("const char *const PARAMETER_NAME[PARAMETERS]", names),
        *_table("const char *const PARAMETER_UNIT[PARAMETERS]", si),
    ]


def _derivatives() -> list[str]:
    short = (weights(WINDOW, k) for k in range(WINDOW // 2 + 1))
    long = wide_weights()[: REACH + 1]
    return [
        "/* Weights of a window of samples for the derivative, per sample, at its first, second ... middle sample. */",
        _enum({"WINDOW": WINDOW, "REACH": REACH, "SPIN_MOST": HALO}),
        *_table(
            "const double DERIVATIVE[WINDOW / 2 + 1][WINDOW]",
            (f"{{{', '.join(f'{x:.17g}' for x in row)}}}," for row in short),
        ),
        "/* Of the longer window of the angular acceleration, up to its middle; the other half is its mirror, negative. */",
        *_table("const double WIDE[REACH + 1]", (f"{x:.17g}," for x in long)),
        "/* Half the stretch over which an encoder's angle is smoothed, s, and the degrees of polynomials to choose from. */",
        f"static const double SPIN_WINDOW = {SPIN_WINDOW};",
        _enum({"DEGREES": len(DEGREES), "LEAST_DEGREE": DEGREES[0], "MOST_DEGREE": DEGREES[-1]}),
        f"static const int DEGREE[DEGREES] = {{{', '.join(map(str, DEGREES))}}};",
        "",
    ]


def _table(head: str, rows: Iterable[str]) -> list[str]:
    return [f"static {head} = {{", *(f"    {r}" for r in rows), "};", ""]


def _enum(values: Mapping[str, int]) -> str:
    return f"enum {{ {', '.join(f'{n} = {k}' for n, k in values.items())} }};"


def _accepted(column: str, volts: set[str]) -> str:
    unit = "V" if column in volts else unit_of(column)
    return SPELLINGS.get(unit, unit) if column in SI_UNITS or unit in ("V", "rad") else "*"


def text(x: str) -> str:
    """Inside a C string: names may be those of a stranger's file."""
    return "".join(ch if ch.isascii() and ch.isprintable() and ch not in '"\\?' else "_" for ch in x)


def comment(x: str) -> str:
    """Inside a C comment."""
    return (
        "".join(ch if ch.isprintable() and ch != "\\" else "_" for ch in x)
        .replace("*/", "* /")
        .replace("/*", "/ *")
    )
