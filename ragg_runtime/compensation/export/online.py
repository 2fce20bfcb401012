"""The online filter in C: what is built into it, and a test vector with Python's answer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.export.contents import Contents, Out
from ragg_runtime.compensation.export.values import comment, text
from ragg_runtime.fit.columns import base_columns, own_columns
from ragg_runtime.fit.square_root import of_some
from ragg_runtime.model.evaluate import vector

Array = NDArray[np.float64]


def online_values(c: Contents) -> str:
    """online_values.h: the point about which the model is linearised, what is fitted, what is known of it.

    Outputs of fewer parameters than others have some that nothing depends on.
    """
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
