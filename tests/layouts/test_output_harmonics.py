"""What the paper's error-propagation combinations become where accelerometers are anywhere."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp

from derive.layout import PAPER as FOUR
from derive.output_harmonics import LayoutHarmonics, layout_harmonics
from derive.propagation import COEFFICIENTS, amplitude_name, collect
from derive.stages import PAPER, Order
from derive.symbols import symbol
from ragg_runtime.instrument.layout import gain
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model import derive
from ragg_runtime.model.evaluate import vector
from tests.layouts import sheets
from tests.layouts.test_layouts_physics import instrument


@pytest.mark.parametrize("order", [PAPER, Order(rotation=2)], ids=["paper", "rotations squared"])
def test_of_four_quarter_turns_they_are_equations_17_to_19(order: Order) -> None:
    """Term by term, as exact polynomials: by the numbers of a place, and as it was derived for the paper."""
    h = layout_harmonics("", order, "platform", FOUR)
    (o,) = h.outputs
    paper = {symbol("k_VI") * symbol("K1"): symbol("k1"), symbol("radius") + symbol("dR"): symbol("R")}
    place = {symbol(n): e.subs(paper) for n, e in h.place}
    for n in range(h.highest + 1):
        for phase in "cs" if n else "c":
            found = o.amplitude(h.generic, n, phase)
            polynomials = {
                k: COEFFICIENTS.from_expr(sp.expand(e.xreplace(place)).subs(paper)) for k, e in found.items()
            }
            terms = collect(order).amplitudes[amplitude_name(n, phase)]
            assert {k: p for k, p in polynomials.items() if p} == {
                (t.motion, t.combination): t.coefficient for t in terms
            }


def harmonics(name: str) -> LayoutHarmonics:
    i = instrument(name)
    return layout_harmonics("", PAPER, "platform", derive._placed(i.layout))


def test_combinations_of_other_layouts() -> None:
    (o,) = harmonics("two").outputs
    assert [(k.name, k.weights) for k in o.combinations] == [("C0", (1.0, 1.0)), ("C1", (1.0, -1.0))]
    assert o.weighed == {(n, "c"): (f"C{n % 2}", 1) for n in range(5)}

    first, turned = harmonics("complements").outputs
    assert {k.name for k in first.combinations} == {"D12", "D34", "D1234", "Sigma"}
    # an eighth of a turn on, cross and inline change places, and D12 and D34 mix
    assert turned.weighed[2, "s"] == ("Sigma", 1)
    assert (2, "c") not in turned.weighed
    half = {k.name: k.weights for k in turned.combinations}["C1"]
    assert half == pytest.approx(np.array([1.0, -1.0, 1.0, -1.0]) * np.sqrt(0.5), rel=1e-16)


def test_the_gradient_has_the_gain_that_the_demodulator_takes() -> None:
    i = parse_instrument(sheets.sheet(sheets.complements(), 8, size=0.0))
    code: dict[str, Any] = {}
    exec(derive.harmonics_of(i)["harmonics.py"], code)
    model, _ = derive.derived((), (), i.form, i.layout)
    k1 = i.accelerometers["k_VI"] * i.accelerometers["K1"]
    for which, o in enumerate(i.layout.outputs):
        both = code["combined"](vector(model, i), which)
        c, s = (both.get((2, phase, code["MOTION"].index("T_2")), 0.0) for phase in "cs")
        assert complex(c, -s) == pytest.approx(gain(o, k1, np.full(8, 0.1)), rel=1e-12)
