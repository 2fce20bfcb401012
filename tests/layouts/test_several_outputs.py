"""The tensor of three discs, the noise of two complements: against what was simulated."""

from __future__ import annotations

import numpy as np
import pytest

from derive.effects import catalogue
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification import several_outputs
from ragg_runtime.identification.strong import Stage
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model import derive
from ragg_runtime.reference import EffectValues
from ragg_runtime.signals.tensor import tensor
from tests.layouts import sheets
from tests.layouts.flown import flown_by

TURN = np.linalg.qr(np.random.default_rng(0).standard_normal((3, 3)))[0]
TRUE = TURN @ np.diag([900.0, -300.0, -600.0]) @ TURN.T
"""Some gradient without trace, Eo."""


def channels(axes: list[tuple[np.ndarray, np.ndarray]], gradient: np.ndarray) -> np.ndarray:
    found = []
    for a, b in axes:
        found += [a @ gradient @ a - b @ gradient @ b, a @ gradient @ b]
    return np.array(found)[:, None]


def random_axes(count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    rng = np.random.default_rng(count)
    frames = [np.linalg.qr(rng.standard_normal((3, 3)))[0] for _ in range(count)]
    return [(q[:, 0], q[:, 1]) for q in frames]


@pytest.mark.parametrize("count", [3, 4])
def test_tensor_of_discs_in_any_direction(count: int) -> None:
    axes = random_axes(count)
    found = tensor(axes, channels(axes, TRUE), np.ones(2 * count))
    assert found.gamma[:, 0] == pytest.approx(TRUE[np.triu_indices(3)], abs=1e-9)
    assert found.closure.shape == (2 * count - 5, 1)
    assert np.max(np.abs(found.closure)) < 1e-9


def test_axes_at_right_angles_close_in_the_sum_of_inlines() -> None:
    x, y, z = np.eye(3)
    axes = [(y, z), (z, x), (x, y)]
    wrong = channels(axes, TRUE)
    wrong[[0, 2, 4]] += 1.0
    found = tensor(axes, wrong, np.ones(6))
    assert abs(found.closure[0, 0]) == pytest.approx(np.sqrt(3.0))
    assert found.gamma[:, 0] == pytest.approx(TRUE[np.triu_indices(3)])


def test_two_discs_are_refused() -> None:
    axes = random_axes(2)
    with pytest.raises(UserError, match="do not determine"):
        tensor(axes, channels(axes, TRUE), np.ones(4))


def flown(discs: list[str], count: int, duration: float = 600.0) -> several_outputs.Together:
    sheet = parse_instrument(sheets.sheet(discs, count, sheets.FULL))
    model, _ = derive.derived((), (), sheet.form, sheet.layout)
    (found,) = several_outputs.compare_outputs(
        fit(model, sheet, observe_flights([flown_by(sheet, duration)], sheet))
    )
    return found


def test_three_discs_see_the_tensor_and_close() -> None:
    found = flown(sheets.umbrella(), 12)
    t = found.tensor
    assert t is not None
    true = np.stack(
        [
            found.fitted.observations[0].record.channels[f"Gamma_{c}"]
            for c in ("xx", "xy", "xz", "yy", "yz", "zz")
        ]
    )
    here = np.searchsorted(found.fitted.observations[0].record.time, found.common)
    off = (t.gamma - true[:, here] / 1e-9) / t.std[:, None]
    assert np.sqrt(np.mean(off**2)) < 1.5  # the calibration takes its own share
    assert 0.7 < t.quality < 1.4
    assert not found.differences()


def test_complements_tell_their_noise() -> None:
    found = flown(sheets.complements(), 8)
    assert found.tensor is None
    (told,) = found.differences()
    assert told["outputs"] == ["G_out_A", "G_out_B"]
    for channel, usual in (("inline", 2.0), ("cross", 1.0)):
        noise = float(str(told[f"{channel}_Eo"]))
        assert noise == pytest.approx(
            usual * 2.0 * np.sqrt(0.2), rel=0.25
        )  # 2 Eo/sqrt(Hz) of the cross channel
        assert noise == pytest.approx(float(str(told[f"expected_{channel}_Eo"])), rel=0.25)


STEPS = ("bias-step", "gain-step")
AT = 71.3


@pytest.mark.parametrize(
    ("hidden", "values"),
    [
        (None, {}),
        ("bias-step", {"dK0": [0, 0, 0, 0, 0, 4e-9, 0, 0]}),
        ("gain-step", {"dK1": [0, 0, 2e-8, 0, 0, 0, 0, 0]}),
    ],
)
def test_a_step_is_found_in_several_outputs(hidden: str | None, values: dict[str, list[float]]) -> None:
    sheet = parse_instrument(sheets.sheet(sheets.complements(), 8, sheets.FULL))
    candidates = tuple(e for e in catalogue() if e.id in STEPS)
    model, _ = derive.derived((), candidates, sheet.form, sheet.layout)
    effects: EffectValues = {} if hidden is None else {hidden: {**values, "t_step": AT}}
    flight = flown_by(sheet, 120.0, effects)
    stage = Stage.of(fit(model, sheet, observe_flights([flight], sheet)))
    assert stage.choice.chosen == (() if hidden is None else (hidden,))
    if hidden is None:
        return
    assert stage.instants[hidden] == pytest.approx(AT, abs=0.25)  # of some tens of sigma
    (given,) = values.values()
    own = [n for n, _ in stage.field.candidates[hidden]]
    found, covariance = stage.fitted.coefficients(own)
    scale = np.array([c.scale for _, c in stage.field.candidates[hidden]])
    size, spread = found[-len(own) :] * scale, scale[:, None] * covariance[-len(own) :, -len(own) :] * scale
    off = np.ravel(given) - size
    assert off @ np.linalg.solve(spread, off) < 30.0  # chi-square of at most eight
