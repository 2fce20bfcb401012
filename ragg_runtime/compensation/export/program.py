"""A calibrated model as a C program that turns a CSV of motion into its outputs."""

from __future__ import annotations

import textwrap
from importlib import resources

from ragg_runtime.compensation.export.contents import Contents, is_gradient, unit_of
from ragg_runtime.compensation.export.online import online_values, table
from ragg_runtime.compensation.export.values import values_header
from ragg_runtime.flight.record import ANGULAR_ACCELERATION

TOLERANCE_EO = 1e-6
"""Largest difference of C and Python, Eo, that `make check` allows."""

PROGRAM = ("main.c", "record.c", "record.h", "slopes.c", "slopes.h", "fail.c", "fail.h", "compare.c")
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
