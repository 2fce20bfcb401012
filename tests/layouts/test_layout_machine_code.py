"""The C of other layouts against NumPy, and both against the same instrument at 50 digits."""

from __future__ import annotations

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model_dir import derive
from tests.generated import fifty_digits as fifty
from tests.layouts import sheets
from tests.layouts.test_layouts_physics import LAYOUTS, instrument

N = 300
LOST = 1e-4
"""Eo: rounding of voltages of 10 V, beside the 1e-9 of k_ggi."""


def drawn(chain_inputs: tuple[str, ...]) -> np.ndarray:
    rng = np.random.default_rng(2)
    size = {"a": 1.0, "omega": 1e-3, "omegadot": 1e-3, "Gamma": 1e-6, "d": 1.5, "d2": 0.1}
    return np.stack([rng.standard_normal(N) * size[n.split("_")[0]] for n in chain_inputs])


@pytest.mark.parametrize("name", LAYOUTS)
def test_c_agrees_with_numpy(name: str) -> None:
    i = instrument(name, sheets.FULL)
    model, _ = derive.derived((), (), i.form, i.layout)
    p = vector(model, i)
    x = drawn(model.chain.INPUTS)
    t, phi = np.arange(N) / 16.0, np.random.default_rng(3).uniform(-3, 3, N)
    c, n = model.compiled("c"), model.compiled("numpy")
    for k, o in enumerate(i.layout.outputs):
        gap = c.output(t, x, p, phi, which=k) - n.output(t, x, p, phi, which=k)
        assert (
            np.max(np.abs(gap)) / scale_factor(model, p, k) < 1e-3
        )  # rounding of volts of single accelerometers
        V, W = (e.voltages(t, x, p, phi, members=o.members) for e in (c, n))
        assert np.max(np.abs(V - W)) < 1e-14 * np.max(np.abs(W))
    for j in range(i.layout.size):
        C, D = (e.derivatives(j, t, x, p, phi) for e in (c, n))
        assert pytest.approx(D, rel=1e-11, abs=1e-11 * float(np.max(np.abs(D)))) == C
    with pytest.raises(UserError, match="no such accelerometer"):
        c.derivatives(i.layout.size, t, x, p, phi)


ANGLES = (0, 180, 90, 270)


@pytest.mark.parametrize("name", ["complements", "umbrella"])
def test_round_off_against_fifty_digits(name: str) -> None:
    """With 1 g in all directions. An output is a sum of voltages of some 10 V, of which an eotvos is 1e-11: so much is lost."""
    i = instrument(name)
    model, _ = derive.derived((), (), i.form, i.layout)
    p, x = vector(model, i), drawn(model.chain.INPUTS)[:, :12]
    x[:3] *= 9.8
    t, phi = np.arange(12) / 16.0, np.random.default_rng(3).uniform(-3, 3, 12)
    parameters = [
        dict(
            zip((n for n, _ in model.chain.PARAMETERS), fifty.exact(model.chain.values_of(j, p)), strict=True)
        )
        for j in range(i.layout.size)
    ]
    true = np.empty((i.layout.size, 12), dtype=object)
    for j, place in enumerate(i.layout.places):
        d = i.layout.discs[place.disc]
        axes = [fifty.exact(np.array(u)) for u in (*d.across, d.axis)]
        degrees = ANGLES[j % 4] + (45 if name == "complements" and j >= 4 else 0)
        for n in range(12):
            psi = fifty.real(float(phi[n])) + degrees * fifty.CONTEXT.pi / 180
            seen = fifty.in_axes(fifty.exact(x[:, n]), axes)
            true[j, n] = fifty.voltage(parameters[j], parameters[j]["radius"], psi, seen)
    worst = 0.0
    for k, o in enumerate(i.layout.outputs):
        expected = sum(s * true[j] for j, s in zip(o.members, o.signs, strict=True))
        for e in (model.compiled("c"), model.compiled("numpy")):
            found = e.output(t, x, p, phi, which=k)
            gap = [abs(float(fifty.real(float(g)) - v)) for g, v in zip(found, expected, strict=True)]
            worst = max(worst, max(gap) / scale_factor(model, p, k))
    assert worst < LOST


def test_discs_turn_as_the_sheet_says_where_no_angle_is_given() -> None:
    i = instrument("odd")
    model, _ = derive.derived((), (), i.form, i.layout)
    p = vector(model, i)
    t, x = np.arange(N) / 16.0, drawn(model.chain.INPUTS)
    for e in (model.compiled("c"), model.compiled("numpy")):
        given = e.output(t, x, p, 2 * np.pi * 0.3 * t, which=0)
        assert e.output(t, x, p, which=0) == pytest.approx(given, rel=1e-9)
        assert e.output(t, x, p, which=1) == pytest.approx(e.output(t, x, p, np.zeros(N), which=1), rel=1e-12)
