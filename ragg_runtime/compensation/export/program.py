"""A calibrated model as a C program: motion in, outputs out, and the filter that works sample by sample."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.export.contents import DISC, Contents, Out, is_gradient, unit_of
from ragg_runtime.estimation.least_squares import of_some
from ragg_runtime.estimation.regressors import base_columns, own_columns
from ragg_runtime.io.angular_acceleration import REACH, wide_weights
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SI_UNITS
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.derivative import DEGREES, WINDOW, weights

TOLERANCE_EO = 1e-6
"""Largest difference of C and Python, Eo, that `make check` allows."""

PROGRAM = ("main.c", "record.c", "record.h", "compare.c")
ONLINE = ("online.h", "online.c", "online_main.c")


def c_program(c: Contents) -> dict[str, str]:
    """File name -> text of everything that `make` needs, with a test."""
    name = next(n.removesuffix(".c") for n in c.sources if n.endswith(".c"))
    online = any(o.sees for o in c.outputs())
    makefile = _packaged("Makefile").replace("@MODEL@", name)
    scale = min(abs(o.scale_factor) for o in c.outputs())
    makefile = makefile.replace("@PROGRAMS@", "ragg_model ragg_online" if online else "ragg_model")
    return {
        "Makefile": makefile.replace("@TOLERANCE@", f"{TOLERANCE_EO * scale:.3g}"),
        "README.txt": _readme(c, online),
        **{n: _packaged(n) for n in (*PROGRAM, *(ONLINE if online else ()))},
        **({"online_values.h": online_values(c)} if online else {}),
        **{n: c.model.sources[n] for n in ("chain.c", "chain.h")},
        **c.sources,
        "values.h": values_header(c, name),
        **example_files(c),
    }


def example_files(c: Contents) -> dict[str, str]:
    """Two short motions as CSV, the second without angular acceleration but with encoders, and the model's answers."""
    found = {}
    for prefix, derived in (("", False), ("derived_", True)):
        motion, outputs = c.example(derived=derived)
        found[f"test/{prefix}motion.csv"] = table({f"{n} [{unit_of(n)}]": x for n, x in motion.items()})
        found[f"test/{prefix}G_out.csv"] = table({"time": motion["time"], **outputs})
    return found


def _packaged(name: str) -> str:
    return resources.files("ragg_runtime.compensation.export").joinpath("c", name).read_text("utf-8")


def _readme(c: Contents, online: bool) -> str:
    effects = ", ".join(e.id for e in c.model.effects) or "none"
    spare = {n for n in c.columns() if is_gradient(n) or n in ANGULAR_ACCELERATION}
    needed = ", ".join(f"{n} [{unit_of(n)}]" for n in c.columns() if n not in spare)
    outputs = ", ".join(f"{o.name} = {o.formula}" for o in c.outputs())
    text = textwrap.dedent(
        f"""\
        The instrument model {c.name} as a C program.
        Values: {c.origin}. Effects beyond the paper's instrument: {effects}.
        Outputs, V: {outputs}.

        make                                          builds ragg_model
        make check                                    holds it against the answers that Python gave
        ./ragg_model < MOTION.csv > OUT.csv           the outputs of a record of motion
        ./ragg_model --values                         the parameters that are built in

        Columns that MOTION.csv must have, in SI units: time [s], {needed}.
        omegadot_x, omegadot_y, omegadot_z [rad/s^2]: where they are missing they are derived from omega as Python does it
        (even steps; runs shorter than 25 samples have none).
        Gradients (Gamma_xx ... [s^-2]) are zero where they are missing; {", ".join(c.angles())} [rad] replaces 2 pi f t.
        """
    )
    text += "".join(f"{limit}.\n" for limit in c.limits())
    if not online:
        return text
    return text + textwrap.dedent(
        """\

        ./ragg_online NOISE_V WALK_EO FORGET_S < FLIGHT.csv > OUT.csv
            calibrates and compensates sample by sample: the same columns and the recorded outputs in V.
        online.h                                      the same for a program of your own, without allocation
        """
    )


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
        "FIRST_OUTPUT": len(columns) - len(outputs), "FROM_FIRST": int(c.instrument.angle_origin == "first-sample"),
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


Array = NDArray[np.float64]


def online_values(c: Contents) -> str:
    """online_values.h: the point about which the model is linearised, what is fitted, what is known of it."""
    outputs = [(k, o) for k, o in enumerate(c.outputs()) if o.sees]
    fitted = [_fitted(c, k) for k, _ in outputs]
    most = max(len(rows) for rows in fitted)
    return "\n".join(
        [
            "/* What the online filter begins with. SI units; scales are errors of the sheet. */",
            "#ifndef RAGG_ONLINE_VALUES_H",
            "#define RAGG_ONLINE_VALUES_H",
            "",
            f"enum {{ ONLINE_INPUTS = {len(c.chain.INPUTS)}, ONLINE_PARAMETERS = {len(c.p)}, ONLINE_OUTPUTS = {len(outputs)}, "
            f"FITTED_PARAMETERS = {most}, START_AT_SHEET = {int(c.information is None)} }};",
            "",
            *_outputs(outputs),
            "#ifdef RAGG_CHAIN_H /* for online.c alone */",
            *_members(c, [o for _, o in outputs]),
            "static const double POINT[ONLINE_PARAMETERS] = {",
            *(f"    {float(x):.17g}," for x in c.p),
            "};",
            "",
            "/* Row of the derivatives, member (-1: all), place, scale (0: none of this output), the sheet's value from POINT on. */",
            "static const struct { int row, member, place; double scale, sheet; }",
            "    FITTED[ONLINE_OUTPUTS][FITTED_PARAMETERS] = {",
            *(line for rows in fitted for line in _block([*rows, *[_NONE] * (most - len(rows))])),
            "};",
            "",
            "/* Square root of the information of the calibration, row after row of the upper triangle. */",
            f"static const double START[ONLINE_OUTPUTS][{most * (most + 1) // 2}] = {{",
            *(
                line
                for k, _ in outputs
                for line in _block([f"{x:.17g}," for x in _padded(_start(c, k), most)])
            ),
            "};",
            "#endif",
            "",
            "#endif",
            "",
        ]
    )


_NONE = "{0, -1, 0, 0.0, 0.0},"


def _outputs(outputs: Sequence[tuple[int, Out]]) -> list[str]:
    rows = (
        f'{{"{text(o.name)}", "{text(o.ending)}", {k}, {len(o.members)}, {o.scale_factor:.17g}, {o.phase:.17g}}},'
        for k, o in outputs
    )
    return [
        "/* Name and ending of an output that sees a gradient, its number in the model, how many accelerometers it has,",
        " * scale factor, V/Eo, and phase, rad: k (inline/2 sin(2 phi + phase) - cross cos(2 phi + phase)). */",
        "static const struct { const char *name, *ending; int which, members; double scale_factor, phase; }",
        "    ONLINE_OUTPUT[ONLINE_OUTPUTS] = {",
        *(f"    {x}" for x in rows),
        "};",
        "",
    ]


def _members(c: Contents, outputs: Sequence[Out]) -> list[str]:
    most = max(len(o.members) for o in outputs)
    spans = [(min(o.members), max(o.members) + 1 - min(o.members)) for o in outputs]
    pairs = ([f"{{{j}, {s}.0}}" for j, s in zip(o.members, o.signs, strict=True)] for o in outputs)
    return [
        "/* Accelerometers of an output and their signs. */",
        f"static const struct {{ int j; double sign; }} MEMBER[ONLINE_OUTPUTS][{most}] = {{",
        *(f"    {{{', '.join(x)}}}," for x in pairs),
        "};",
        "/* The accelerometers that it is among. */",
        f"enum {{ ACCELEROMETERS = {max(count for _, count in spans)} }};",
        "static const struct { int first, count; } SPAN[ONLINE_OUTPUTS] = {",
        *(f"    {{{first}, {count}}}," for first, count in spans),
        "};",
        "/* Parameter that is the rate of its disc. */",
        f"static const int SPIN[ONLINE_OUTPUTS] = {{{', '.join(str(o.spin) for o in outputs)}}};",
        "",
    ]


def _fitted(c: Contents, place: int) -> list[str]:
    """Initialisers of what an output's filter fits."""
    columns = base_columns(c.model, c.instrument)
    rows = {name: k for k, (name, _) in enumerate(c.chain.ROWS)}
    nominal = vector(c.model, c.instrument)
    members = c.outputs()[place].members
    found = []
    for k in own_columns([q for q, _ in columns], c.instrument, place):
        q, at = columns[k]
        j = -1 if q.accelerometer is None else members.index(q.accelerometer - 1)
        sheet = float((nominal[at] - c.p[at]) / q.scale)
        found.append(f"{{{rows[q.name]}, {j}, {at}, {q.scale:.17g}, {sheet:.17g}}}, /* {comment(q.label)} */")
    return found


def _start(c: Contents, place: int) -> Array:
    """(n, n): root of what is known of an output's parameters at the beginning."""
    own = own_columns([q for q, _ in base_columns(c.model, c.instrument)], c.instrument, place)
    return np.eye(len(own)) if c.information is None else of_some(c.information, own)


def _padded(root: Array, size: int) -> list[float]:
    """The upper triangle, row after row, with further parameters of unit information."""
    whole = np.eye(size)
    whole[: len(root), : len(root)] = root
    return [float(x) for k, row in enumerate(whole) for x in row[k:]]


def _block(lines: Sequence[str]) -> list[str]:
    return ["    {", *(f"        {x}" for x in lines), "    },"]


def table(columns: Mapping[str, Array]) -> str:
    """Columns as CSV with 17 digits."""
    rows = zip(*columns.values(), strict=True)
    return "\n".join([",".join(columns), *(",".join(f"{x:.17g}" for x in row) for row in rows)]) + "\n"
