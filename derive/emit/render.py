"""The jinja environment of all emitters: templates in a package's own folder, filters that print expressions."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cache

import jinja2

from derive.emit.printers import to_c, to_fused_c, to_latex, to_numpy, to_wide_c
from derive.names import in_comment
from derive.propagation import COEFFICIENT_PARAMETERS
from derive.symbols import ACCELEROMETER, QUARTER_TURNS, SIGNS
from derive.tape import Program


@cache
def environment(package: str) -> jinja2.Environment:
    """For the templates in the folder ``templates`` of a package."""
    env = jinja2.Environment(
        loader=jinja2.PackageLoader(package, "templates"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # the output is source code, not markup
        optimized=False,  # most are rendered once: that takes longer than it spares
    )
    env.filters |= {"np": to_numpy, "c": to_c, "fused": to_fused_c, "wide": to_wide_c}
    env.filters |= {"tex": to_latex, "comment": in_comment}
    env.globals |= {
        "quarter_turns": QUARTER_TURNS,
        "signs": SIGNS,
        "per_accelerometer": [p.name for p in ACCELEROMETER],
        "coefficient_parameters": COEFFICIENT_PARAMETERS,
        "program_inputs": _program_inputs,
        "trig": _trig,
    }
    return env


def render_page(package: str, template: str, values: Mapping[str, object]) -> str:
    """A page of Markdown from a template in the folder ``templates`` of a package."""
    return environment(package).get_template(template).render(values).rstrip() + "\n"


def number(x: float | Fraction, digits: int = 3) -> str:
    """Significant digits; 4e6, not 4e+06."""
    mantissa, e, exponent = f"{float(x):.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _trig(n: int, phase: str) -> str:
    return "1" if n == 0 else f"{phase}{n}"


def _program_inputs(program: Program, among: list[str]) -> list[str]:
    read = {s.name for s in program.inputs}
    return [n for n in among if n in read]
