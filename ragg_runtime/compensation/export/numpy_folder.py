"""A model as a folder that runs with NumPy alone."""

from __future__ import annotations

import json
from importlib import resources

from ragg_runtime.compensation.export.contents import Contents
from ragg_runtime.compensation.export.document import json_files
from ragg_runtime.compensation.export.program import example_files
from ragg_runtime.flight.angular_acceleration import wide_weights
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.derivative import DEGREES, WINDOW, weights


def numpy_files(c: Contents) -> dict[str, str]:
    """File name -> text."""
    short = [[float(x) for x in weights(WINDOW, k)] for k in range(WINDOW // 2 + 1)]
    slopes = {
        "short": short,
        "long": [float(x) for x in wide_weights()],
        "spin": {"seconds": SPIN_WINDOW, "most": HALO, "degrees": DEGREES},
    }
    program = (
        resources.files("ragg_runtime.compensation.export")
        .joinpath("python", "ragg_model.py")
        .read_text("utf-8")
    )
    return {
        **json_files(c),
        "chain.py": c.module,
        "derivative.json": json.dumps(slopes) + "\n",
        "ragg_model.py": program,
        **example_files(c),
    }
