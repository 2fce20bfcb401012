"""The forms in which a model is exported, the C program above all, and the folder that they are written into."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib import resources
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.compensation.export.contents import DISC, Contents, ExportedOutput, unit_of
from ragg_runtime.estimation.least_squares import marginalise
from ragg_runtime.estimation.regressors import list_base_columns, own_columns
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, GRADIENT
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.angular_acceleration import REACH, wide_weights
from ragg_runtime.signals.derivative import DEGREES, WINDOW, weights

TOLERANCE_EO = 1e-6
"""Largest difference of C and Python, Eo, that `make check` allows."""

PROGRAM = ("main.c", "record.c", "record.h", "derivative.h")
ONLINE = ("online.h", "online.c", "online_main.c")

SPELLINGS: Mapping[str, str] = {
    "m/s^2": "m/s^2|m/s2|m/s**2|m s^-2",
    "rad/s": "rad/s|1/s|rad s^-1",
    "rad/s^2": "rad/s^2|rad/s2|rad/s**2|1/s^2|rad s^-2",
    "s^-2": "s^-2|1/s^2|1/s2|1/s**2|s**-2",
    "1": "1|m|s|kg|A|K|V|T|Pa|Hz|N|J|W|C|ohm|rad|m/s|m/s^2|rad/s|rad/s^2|1/s|1/s^2|T/s|K/s|Pa/s",
}
"""How people write an SI unit; of channels of no fixed meaning, the units that an effect is likely to need."""


def make_program(c: Contents) -> dict[str, str]:
    """File name -> text of everything that `make` needs."""
    model = next(n.removesuffix(".c") for n in c.sources if n.endswith(".c"))
    online = any(o.sees for o in c.outputs())
    tolerance = TOLERANCE_EO * min(abs(o.scale_factor) for o in c.outputs())
    makefile = _packaged("Makefile").replace("@MODEL@", model).replace("@TOLERANCE@", f"{tolerance:.3g}")
    return {
        "Makefile": makefile.replace("@PROGRAMS@", "ragg_model ragg_online" if online else "ragg_model"),
        "README.txt": _readme(c, online),
        **{n: _packaged(n) for n in (*PROGRAM, *(ONLINE if online else ()))},
        **({"online_values.h": write_online_values(c)} if online else {}),
        **{n: c.model.sources[n] for n in ("chain.c", "chain.h")},
        **c.sources,
        "values.h": write_values(c, model),
    }


def _packaged(name: str) -> str:
    return resources.files("ragg_runtime.compensation.export").joinpath("c", name).read_text("utf-8")


def _readme(c: Contents, online: bool) -> str:
    effects = ", ".join(e.id for e in c.model.effects) or "none"
    needed = ", ".join(f"{n} [{unit_of(n)}]" for n in c.columns() if _needed(n))
    text = textwrap.dedent(
        f"""\
        The instrument model {c.name} as a C program.
        Values: {c.origin}. Effects beyond the paper's instrument: {effects}.
        Outputs, V: {", ".join(f"{o.name} = {o.formula}" for o in c.outputs())}.

        make                                          builds ragg_model
        make check                                    compares it with the results of Python
        ./ragg_model < MOTION.csv > OUT.csv           the outputs of a record of motion
        ./ragg_model --values                         the parameters that are built in

        Columns that MOTION.csv must have, in SI units: time [s], {needed}.
        omegadot_x, omegadot_y, omegadot_z [rad/s^2]: if missing, they are derived from omega as in Python
        (even steps; runs shorter than 25 samples have none).
        Gradients (Gamma_xx ... [s^-2]) are zero if missing; {", ".join(c.angles())} [rad] replaces 2 pi f t.
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


def _needed(column: str) -> bool:
    """Whether a record must have a column: else it is zero, or derived."""
    return column not in ANGULAR_ACCELERATION and column not in GRADIENT


# --- values.h ------------------------------------------------------------------------------------------


def write_values(c: Contents, name: str) -> str:
    """values.h of a model whose C is ``name``.c."""
    call = f"ragg_{name}_output(which, n, t, in, p, angle, G)"
    if name == "folded":  # the paper's one output
        call = "((void)(which), ragg_folded_output(n, t, in, p, angle, G))"
    return "\n".join(
        [
            f"/* The model {_comment(c.name)}: {_comment(c.origin)}. Everything is in SI units. */",
            "#ifndef RAGG_VALUES_H",
            "#define RAGG_VALUES_H",
            "",
            f'#include "{name}.h"',
            "",
            "/* An output by the model. */",
            f"#define MODEL(which, n, t, in, p, angle, G) {call}",
            "",
            *_columns(c),
            *_parameters(c),
            *_derivatives(),
            "#endif",
            "",
        ]
    )


def _columns(c: Contents) -> list[str]:
    """Columns of a record, discs, outputs, and which column each input is."""
    outputs, angles, motion = c.outputs(), c.angles(), c.columns()
    if {*motion} & {*ANGULAR_ACCELERATION}:  # three and three, one after the other
        whole = [*ANGULAR_RATE, *ANGULAR_ACCELERATION]
        motion = [*whole, *(n for n in motion if n not in whole)]
    columns = ["time", *angles, *motion, *(o.name for o in outputs)]
    place = {n: k for k, n in enumerate(columns)} | {DISC: -1}
    needed = {"time", *filter(_needed, motion)}
    units = {n: SPELLINGS.get(unit_of(n), unit_of(n)) for n in columns} | {o.name: "V" for o in outputs}
    return [
        _enum(COLUMNS=len(columns), INPUTS=len(c.inputs()), OUTPUTS=len(outputs), DISCS=len(angles)),
        _enum(
            TIME=0,
            DISC_ANGLE=-1,
            OMEGA=place.get(ANGULAR_RATE[0], -1),
            OMEGADOT=place.get(ANGULAR_ACCELERATION[0], -1),
            FIRST_OUTPUT=len(columns) - len(outputs),
            FROM_FIRST=int(c.instrument.angle_origin == "first-sample"),
        ),
        "",
        "/* Name, accepted spellings of the unit, and whether it must be there (else it is zero, or derived). */",
        *_table(
            "const struct { const char *name, *units; int needed; } COLUMN[COLUMNS]",
            (f'{{"{_text(n)}", "{units[n]}", {int(n in needed)}}},' for n in columns),
        ),
        "/* Column of a disc's angle, and the parameter that is its rate. */",
        *_table(
            "const struct { int column, spin; } DISC[DISCS]",
            (f"{{{place[n]}, {next(o.spin for o in outputs if o.angle_column == n)}}}," for n in angles),
        ),
        *_table(
            "const struct { const char *name, *ending; int disc; } OUTPUT[OUTPUTS]",
            (f'{{"{_text(o.name)}", "{_text(o.ending)}", {angles.index(o.angle_column)}}},' for o in outputs),
        ),
        "/* Which column each input of the model is (DISC_ANGLE: the disc's), and how often it is differentiated by time. */",
        *_table(
            "const struct { int column, derivative; } INPUT[INPUTS]",
            (f"{{{place[x['column']]}, {x['derivative']}}}, /* {x['name']} */" for x in c.inputs()),
        ),
    ]


def _parameters(c: Contents) -> list[str]:
    rows = [
        (x, v["name"] if len(v["values"]) == 1 else f"{v['name']}[{j}]", v["unit"], v["meaning"])
        for v in c.parameters()
        for j, x in enumerate(v["values"], 1)
    ]
    return [
        _enum(PARAMETERS=len(rows)),
        *_table(
            "const double PARAMETER[PARAMETERS]",
            (f"{x:.17g}, /* {_comment(f'{name}, {unit}: {meaning}')} */" for x, name, unit, meaning in rows),
        ),
        *_table("const char *const PARAMETER_NAME[PARAMETERS]", (f'"{_text(r[1])}",' for r in rows)),
        *_table("const char *const PARAMETER_UNIT[PARAMETERS]", (f'"{_text(r[2])}",' for r in rows)),
    ]


def _derivatives() -> list[str]:
    short = (weights(WINDOW, k) for k in range(WINDOW // 2 + 1))
    return [
        "/* Weights of a window of samples for the derivative, per sample, at its first, second ... middle sample. */",
        _enum(WINDOW=WINDOW, REACH=REACH, SPIN_MOST=HALO),
        *_table(
            "const double DERIVATIVE[WINDOW / 2 + 1][WINDOW]",
            (f"{{{', '.join(f'{x:.17g}' for x in row)}}}," for row in short),
        ),
        "/* Of the longer window of the angular acceleration, up to its middle; the other half is its mirror, negative. */",
        *_table("const double WIDE[REACH + 1]", (f"{x:.17g}," for x in wide_weights()[: REACH + 1])),
        "/* Half the stretch over which an encoder's angle is smoothed, s, and the degrees of polynomials to choose from. */",
        f"static const double SPIN_WINDOW = {SPIN_WINDOW};",
        _enum(DEGREES=len(DEGREES), LEAST_DEGREE=DEGREES[0], MOST_DEGREE=DEGREES[-1]),
        f"static const int DEGREE[DEGREES] = {{{', '.join(map(str, DEGREES))}}};",
        "",
    ]


def _table(head: str, rows: Iterable[str]) -> list[str]:
    return [f"static {head} = {{", *(f"    {r}" for r in rows), "};", ""]


def _enum(**values: int) -> str:
    return f"enum {{ {', '.join(f'{n} = {k}' for n, k in values.items())} }};"


def _text(x: str) -> str:
    """Inside a C string: names come from files and may hold anything."""
    return "".join(ch if ch.isascii() and ch.isprintable() and ch not in '"\\?' else "_" for ch in x)


def _comment(x: str) -> str:
    """Inside a C comment."""
    plain = "".join(ch if ch.isprintable() and ch != "\\" else "_" for ch in x)
    return plain.replace("*/", "* /").replace("/*", "/ *")


# --- online_values.h -----------------------------------------------------------------------------------


def write_online_values(c: Contents) -> str:
    """online_values.h: the point about which the model is linearised, what is fitted, what is known of it."""
    outputs = [(k, o) for k, o in enumerate(c.outputs()) if o.sees]
    fitted = [_fitted(c, k, o) for k, o in outputs]
    most = max(map(len, fitted))
    spans = [(min(o.members), max(o.members) + 1 - min(o.members)) for _, o in outputs]
    return "\n".join(
        [
            "/* What the online filter begins with. SI units; scales are errors of the sheet. */",
            "#ifndef RAGG_ONLINE_VALUES_H",
            "#define RAGG_ONLINE_VALUES_H",
            "",
            _enum(
                ONLINE_INPUTS=len(c.model.chain.INPUTS),
                ONLINE_PARAMETERS=len(c.p),
                ONLINE_OUTPUTS=len(outputs),
                FITTED_PARAMETERS=most,
            ),
            "",
            "/* Name and ending of an output that sees a gradient, its number in the model, how many accelerometers it has,",
            " * scale factor, V/Eo, and phase, rad: k (inline/2 sin(2 phi + phase) - cross cos(2 phi + phase)). */",
            *_table(
                "const struct { const char *name, *ending; int which, members; double scale_factor, phase; }\n"
                "    ONLINE_OUTPUT[ONLINE_OUTPUTS]",
                (
                    f'{{"{_text(o.name)}", "{_text(o.ending)}", {k}, {len(o.members)}, {o.scale_factor:.17g}, {o.phase:.17g}}},'
                    for k, o in outputs
                ),
            ),
            "#ifdef RAGG_CHAIN_H /* for online.c alone */",
            "/* Accelerometers of an output and their signs, and those that it is among; the parameter that is the rate of its disc. */",
            *_table(
                f"const struct {{ int j; double sign; }} MEMBER[ONLINE_OUTPUTS][{max(len(o.members) for _, o in outputs)}]",
                (
                    f"{{{', '.join(f'{{{j}, {s}.0}}' for j, s in zip(o.members, o.signs, strict=True))}}},"
                    for _, o in outputs
                ),
            ),
            _enum(ACCELEROMETERS=max(count for _, count in spans)),
            *_table(
                "const struct { int first, count; } SPAN[ONLINE_OUTPUTS]",
                (f"{{{first}, {count}}}," for first, count in spans),
            ),
            f"static const int SPIN[ONLINE_OUTPUTS] = {{{', '.join(str(o.spin) for _, o in outputs)}}};",
            "",
            *_table("const double POINT[ONLINE_PARAMETERS]", (f"{x:.17g}," for x in c.p)),
            "/* Row of the derivatives, member (-1: all), place, scale (0: none of this output), the sheet's value from POINT on. */",
            *_table(
                "const struct { int row, member, place; double scale, sheet; }\n"
                "    FITTED[ONLINE_OUTPUTS][FITTED_PARAMETERS]",
                _blocks([*rows, *["{0, -1, 0, 0.0, 0.0},"] * (most - len(rows))] for rows in fitted),
            ),
            "/* Square root of the information of the calibration, row after row of the upper triangle. */",
            *_table(
                f"const double START[ONLINE_OUTPUTS][{most * (most + 1) // 2}]",
                _blocks(_start(c, k, most) for k, _ in outputs),
            ),
            "#endif",
            "",
            "#endif",
            "",
        ]
    )


def _fitted(c: Contents, place: int, o: ExportedOutput) -> list[str]:
    """Initialisers of what an output's filter fits."""
    columns = list_base_columns(c.model, c.instrument)
    rows = {name: k for k, (name, _) in enumerate(c.model.chain.ROWS)}
    nominal = vector(c.model, c.instrument)
    found = []
    for k in own_columns([q for q, _ in columns], c.instrument, place):
        q, at = columns[k]
        j = -1 if q.accelerometer is None else o.members.index(q.accelerometer - 1)
        sheet = float((nominal[at] - c.p[at]) / q.scale)
        found.append(
            f"{{{rows[q.name]}, {j}, {at}, {q.scale:.17g}, {sheet:.17g}}}, /* {_comment(q.label)} */"
        )
    return found


def _start(c: Contents, place: int, size: int) -> list[str]:
    """Root of what is known of an output's parameters at the beginning, further ones of unit information."""
    own = own_columns([q for q, _ in list_base_columns(c.model, c.instrument)], c.instrument, place)
    whole = np.eye(size)
    if c.saved is not None:
        whole[: len(own), : len(own)] = marginalise(c.saved.information, own)
    return [f"{x:.17g}," for x in whole[np.triu_indices(size)]]


def _blocks(each: Iterable[Sequence[str]]) -> list[str]:
    return [line for lines in each for line in ("{", *(f"    {x}" for x in lines), "},")]


# --- all forms ---------------------------------------------------------------------------------------


Files = Mapping[str, str]
"""File name -> text."""


def make_c(c: Contents) -> Files:
    """A C program with its tests."""
    return {**make_program(c), **make_tests(c)}


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
        "derivative.json": json.dumps(slopes) + "\n",
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
    if folder.exists() and not folder.is_dir():
        raise UserError("the export needs a folder", where=folder, found="a file", remedy="name another one")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARK).is_file():
        raise UserError(
            "the folder is not empty and was not made by an export",
            where=folder,
            remedy="name another folder, or empty this one",
        )
    files = FORMS[form](c)
    written = []
    for name, text in {MARK: "\n".join(sorted(files)) + "\n", **files}.items():
        place = folder / name
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UserError("the folder cannot be made", where=place.parent, found=error.strerror) from None
        write_text(place, text)
        written.append(place)
    return written
