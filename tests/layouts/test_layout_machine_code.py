"""The C of other layouts against NumPy, and both against the same instrument at 50 digits."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.symbols import MOTION
from ragg_runtime.instrument import layout as layouts
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model import derive
from ragg_runtime.model.model import make_vector, scale_factor
from tests.generated import fifty_digits as fifty
from tests.layouts import sheets
from tests.layouts.test_layouts_physics import instrument

Array = NDArray[np.float64]

N = 4
GATES = {"vertical": 1e-6, "oblique": 3e-6, "umbrella": 1e-6, "odd": 1e-4}
"""Eo, as of the paper's layout (tests/generated) where the places balance: elsewhere half a unit in the last place of a recorded force is
worth 5e-5 Eo."""

SEEN = (*(c.name for c in MOTION), "d_spin_angle", "d2_spin_angle")
"""Channels, in the order in which the 50 digits take them."""


def drawn(chain_inputs: tuple[str, ...]) -> np.ndarray:
    rng = np.random.default_rng(2)
    size = {"a": 1.0, "omega": 1e-3, "omegadot": 1e-3, "Gamma": 1e-6, "d": 1.5, "d2": 0.1}
    return np.stack([rng.standard_normal(N) * size[n.split("_")[0]] for n in chain_inputs])


def true_outputs(i: Instrument, chain: Any, p: Array, phi: Array, x: Array) -> NDArray[np.object_]:
    """(outputs, N) at 50 digits: the channels as they are, the places as the sheet writes them."""
    turns = layouts.constants(i.layout)
    exact = i.form.preset == "exact"
    found = np.empty((len(i.layout.outputs), len(phi)), dtype=object)
    for k, o in enumerate(i.layout.outputs):
        d = i.layout.discs[o.disc]
        axes = [fifty.exact(np.array(u)) for u in (*d.across, d.axis)]
        for n in range(len(phi)):
            seen = fifty.in_axes(fifty.exact(x[:15, n]), axes)
            spin = fifty.exact(x[15:, n]) if i.form.kinematics == "full" else [fifty.real(0)] * 2
            found[k, n] = fifty.real(0)
            for j, sign in zip(o.members, o.signs, strict=True):
                place = i.layout.places[j]
                q = dict(
                    zip((n for n, _ in chain.PARAMETERS), fifty.exact(chain.values_of(j, p)), strict=True)
                )
                turn = [[turns.get(f"turn_{a}{b}_j", UPRIGHT[a][b])[j] for b in range(3)] for a in range(3)]
                at = fifty.Place(
                    height=fifty.real(place.height),
                    turn=[fifty.exact(np.array(row)) for row in turn],
                    spin=(spin[0], spin[1]),
                    exact=exact,
                )
                degrees = fifty.real(round(np.degrees(place.angle), 6))
                psi = fifty.real(float(phi[n])) + degrees * fifty.CONTEXT.pi / 180
                found[k, n] += sign * fifty.voltage(q, q["radius"], psi, seen, at)
    return found


UPRIGHT = [[np.full(12, float(a == b)) for b in range(3)] for a in range(3)]


@pytest.mark.parametrize(
    ("name", "head"), [*((n, sheets.EXACT) for n in ("vertical", "oblique", "odd")), ("umbrella", "")]
)
def test_round_off_against_fifty_digits(name: str, head: str) -> None:
    """With 1 g in all directions."""
    i = instrument(name, head)
    model, _ = derive.derived((), (), i.form, i.layout)
    order = [model.chain.INPUTS.index(n) for n in SEEN if n in model.chain.INPUTS]
    p, x = make_vector(model, i), drawn(model.chain.INPUTS)
    x[:3] *= 9.8
    t, phi = np.arange(N) / 16.0, np.random.default_rng(3).uniform(-3, 3, N)
    true = true_outputs(i, model.chain.module, p, phi, x[order])
    for k in range(len(i.layout.outputs)):
        for chain in (model.chain, replace(model.chain, sources={})):
            found = chain.output(t, x, p, phi, which=k)
            gap = [abs(float(fifty.real(float(g)) - v)) for g, v in zip(found, true[k], strict=True)]
            assert max(gap) / scale_factor(model, p, k) < GATES[name]
