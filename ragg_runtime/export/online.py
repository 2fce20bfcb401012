"""The online filter in C: what is built into it, and a test vector with Python's answer."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.export.contents import Contents
from ragg_runtime.fit.columns import base_columns
from ragg_runtime.model.evaluate import scale_factor, vector

Array = NDArray[np.float64]


def online_values(c: Contents) -> str:
    """online_values.h: the point about which the model is linearised, what is fitted, what is known of it."""
    columns = base_columns(c.model, c.instrument)
    rows = {name: k for k, (name, _) in enumerate(c.chain.ROWS)}
    nominal = vector(c.model, c.instrument)
    fitted = []
    for q, place in columns:
        j = -1 if q.accelerometer is None else q.accelerometer - 1
        sheet = float((nominal[place] - c.p[place]) / q.scale)
        fitted.append(f"{{{rows[q.name]}, {j}, {place}, {q.scale:.17g}, {sheet:.17g}}}, /* {q.label} */")
    start = (
        [] if c.information is None else [float(x) for k, row in enumerate(c.information) for x in row[k:]]
    )
    return "\n".join(
        [
            "/* What the online filter begins with. SI units; scales are errors of the sheet. */",
            "#ifndef RAGG_ONLINE_VALUES_H",
            "#define RAGG_ONLINE_VALUES_H",
            "",
            f"enum {{ ONLINE_INPUTS = {len(c.chain.INPUTS)}, ONLINE_PARAMETERS = {len(c.p)}, "
            f"FITTED_PARAMETERS = {len(fitted)}, START_AT_SHEET = {int(not start)} }};",
            "",
            "#ifdef RAGG_CHAIN_H /* for online.c alone */",
            f"static const double SCALE_FACTOR = {scale_factor(c.model, c.p):.17g}; /* V/Eo */",
            "static const double POINT[ONLINE_PARAMETERS] = {",
            *(f"    {float(x):.17g}," for x in c.p),
            "};",
            "",
            "/* Row of the chain's derivatives, accelerometer (-1: all), place, scale, and the sheet's value from the point on. */",
            "static const struct { int row, accelerometer, place; double scale, sheet; } FITTED[FITTED_PARAMETERS] = {",
            *(f"    {row}" for row in fitted),
            "};",
            "",
            "/* Square root of the information of the calibration, row after row of the upper triangle. */",
            f"static const double START[{max(1, len(start))}] = {{",
            *([f"    {x:.17g}," for x in start] or ["    0.0"]),
            "};",
            "#endif",
            "",
            "#endif",
            "",
        ]
    )


def table(columns: Mapping[str, Array]) -> str:
    """Columns as CSV with 17 digits."""
    rows = zip(*columns.values(), strict=True)
    return "\n".join([",".join(columns), *(",".join(f"{x:.17g}" for x in row) for row in rows)]) + "\n"
