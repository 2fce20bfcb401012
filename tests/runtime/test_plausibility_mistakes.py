"""Likely mistakes: named where they are, never where the record is right, whatever effect is hidden in it."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from scipy import signal

from ragg_runtime.base.errors import UserError
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.screening import examined, identify, likely_mistake, other_demodulator, timing
from ragg_runtime.screening.quick_fit import explain, shrunken
from ragg_runtime.screening.subsample import picker
from ragg_runtime.signals.demodulate import demodulate

G0 = 9.8
MODEL = model.packaged()


def flown(
    seed: int, effects: dict[str, Any] | None = None, voltages: bool = False, **options: Any
) -> tuple[Scenario, Flight]:
    record_gradient = options.pop("record_gradient", True)
    s = scenario(seed, duration=300.0, **options)
    return s, s.simulate(effects or {}, record_gradient=record_gradient).flight(voltages=voltages)


def scaled(x: Flight, stem: str, factor: float) -> Flight:
    return dataclasses.replace(
        x, channels={n: factor * v if n.rsplit("_", 1)[0] == stem else v for n, v in x.channels.items()}
    )


@pytest.mark.parametrize("trim", ["matched", "table-v"])
@pytest.mark.parametrize("seed", range(8))
def test_a_good_flight_is_left_alone(trim: str, seed: int) -> None:
    for options in (
        {},
        {"voltages": True},
        {"record_gradient": False, "gradient_rms": 20e-9},
        {"red_corner": 0.05},
        {"perturbation": 10.0},
    ):
        s, x = flown(100 + seed, trim=trim, **options)
        found = examined(MODEL, s.sheet, x)
        assert found.notes == ()
        assert found.valid.all()


HIDDEN: dict[str, dict[str, Any]] = {
    "thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]},
    "cubic-input": {"K_iii": [4e-6 / G0**2, 0, 0, 0]},
    "bias-drift": {"dK0_dt": [2e-8 * G0, 0, 0, 0]},
    "gain-step": {"dK1": [0, 2e-6, 0, 0], "t_step": 150.0},
    "imu-lever-arm": {"l_x": 3e-2, "l_y": -2e-2},
    "imu-misalignment": {"e_x": 3e-3, "e_y": -3e-3, "e_z": 3e-3},
    "gyro-scale": {"s_x": 1e-2, "s_y": -1e-2},
    "time-offset": {"delta_t": 1e-2},
    "spin-phase-offset": {"phi_0": 1e-2},
    "spin-axis-tilt": {"alpha_x": 1e-3},
    "encoder-harmonic": {"c_1": 1e-3},
    "spin-rate-jitter": {"sigma_phi": 1e-5},
    "quantisation": {"q": 5e-3},
}


@pytest.mark.parametrize("effect", sorted(HIDDEN))
@pytest.mark.parametrize(("trim", "voltages"), [("matched", False), ("table-v", True)])
def test_a_hidden_effect_is_no_mistake(effect: str, trim: str, voltages: bool) -> None:
    s, x = flown(7, {effect: HIDDEN[effect]}, voltages, trim=trim)
    found = examined(MODEL, s.sheet, x)
    assert found.notes == ()
    assert found.valid.all()


@pytest.mark.parametrize("trim", ["matched", "table-v"])
@pytest.mark.parametrize("voltages", [False, True])
def test_the_mistake_is_named_on_any_instrument_without_a_known_gradient(trim: str, voltages: bool) -> None:
    s, x = flown(9, None, voltages, trim=trim, record_gradient=False)
    c = x.channels
    for wrong, words in (
        (scaled(x, "a", 1 / G0), "a_x, a_y, a_z are in g, not in m/s^2"),
        (dataclasses.replace(x, outputs={n: 1e3 * v for n, v in x.outputs.items()}), "in mV, not in V"),
        (
            dataclasses.replace(x, channels={**c, "a_x": c["a_z"], "a_z": c["a_x"]}),
            "a_x and a_z are exchanged",
        ),
    ):
        with pytest.raises(UserError, match="likely mistake") as caught:
            examined(MODEL, s.sheet, wrong)
        assert words in str(caught.value)


def demodulated(s: Scenario, x: Flight, low_pass: Any = None) -> Flight:
    """Inline and cross alone; through our low-pass, or another one."""
    phi, k = 2 * np.pi * 0.25 * x.time, scale_factor(MODEL, vector(MODEL, s.sheet)) * 1e9
    channels = {n: np.full(len(x), np.nan) for n in ("inline", "cross")}
    if low_pass is None:
        d = demodulate(x.outputs["G_out"], phi, x.rate, k)
        channels["inline"][d.valid], channels["cross"][d.valid] = d.inline, d.cross
    else:
        channels["inline"] = low_pass(4 * x.outputs["G_out"] * np.sin(2 * phi)) / k
        channels["cross"] = low_pass(-2 * x.outputs["G_out"] * np.cos(2 * phi)) / k
    return dataclasses.replace(x, outputs=channels)


DEFINITIONS = {
    (1.0, -1.0): "the sign of cross is reversed",
    (0.5, 1.0): "inline is half of Gamma_xx - Gamma_yy",
    (-1.0, 2.0): "the sign of inline is reversed; cross is twice Gamma_xy",
}


def test_channels_that_are_defined_otherwise_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    # of all mistakes these alone, and none of time: each is tried on 3,000 rows
    monkeypatch.setattr(identify, "mistakes", lambda *_, **__: identify._definitions())
    monkeypatch.setattr(identify, "searches", lambda *_: [])
    s, x = flown(13, gradient_rms=20e-9)
    good = demodulated(s, x)
    assert likely_mistake(MODEL, s.sheet, picker(good, s.sheet)) is None
    for (inline, cross), words in DEFINITIONS.items():
        o = {"inline": inline * good.outputs["inline"], "cross": cross * good.outputs["cross"]}
        found = likely_mistake(MODEL, s.sheet, picker(dataclasses.replace(good, outputs=o), s.sheet))
        assert found is not None
        assert (found.what, found.others) == (words, ())
        assert found.factor > 100.0


def test_another_demodulator_is_named_with_its_order_and_corner(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(identify, "mistakes", lambda *_, **__: iter(()))
    monkeypatch.setattr(identify, "searches", lambda *_: [])
    own = [m for m in other_demodulator.FAMILIES if m(0.1).order == 3 and not m(0.1).delay]
    monkeypatch.setattr(other_demodulator, "FAMILIES", own)
    monkeypatch.setattr(other_demodulator, "LATE_TRIED", 0)
    monkeypatch.setattr(other_demodulator, "THINNED", ())
    s, x = flown(14)
    sections = signal.butter(3, 0.15, fs=x.rate, output="sos")
    wrong = demodulated(s, x, lambda z: signal.sosfilt(sections, z))
    found = likely_mistake(MODEL, s.sheet, picker(wrong, s.sheet))
    assert found is not None
    assert found.what.endswith("such as a causal Butterworth low-pass of order 3 at 0.15 Hz")
    assert 'kind = "causal", cutoff = "0.15 Hz", order = 3;' in found.remedy
    assert found.factor > 1000.0
    monkeypatch.setattr(other_demodulator, "LATE_TRIED", 1)
    late = demodulated(s, x, lambda z: np.roll(signal.sosfilt(sections, z), 8))
    made = other_demodulator.best(MODEL, s.sheet, picker(late, s.sheet))
    assert made is not None
    assert (made.how.order, made.how.cutoff, made.how.delay) == pytest.approx((3, 0.15, 0.5), rel=1e-3)


def test_outputs_that_are_recorded_more_seldom_than_the_motion() -> None:
    """Channels may be; an output before demodulation must keep up with the disc."""
    s, x = flown(15, voltages=False)
    seldom = np.arange(len(x)) % 16 == 0
    good = demodulated(s, x)
    thinned = {n: np.where(seldom, v, np.nan) for n, v in good.outputs.items()}
    assert examined(MODEL, s.sheet, dataclasses.replace(good, outputs=thinned)).notes == ()
    for every, enough in ((8, True), (16, False)):
        G = np.where(np.arange(len(x)) % every == 0, x.outputs["G_out"], np.nan)
        slow = dataclasses.replace(x, outputs={"G_out": G})
        if enough:
            examined(MODEL, s.sheet, slow)
            continue
        with pytest.raises(UserError, match="the output is sampled too slowly for the disc"):
            examined(MODEL, s.sheet, slow)


@pytest.mark.parametrize("error", [-0.03, -0.01, 0.004, 0.02])
def test_the_spin_rate_is_measured(error: float) -> None:
    s, x = flown(10)
    sheet = dataclasses.replace(s.sheet, spin_frequency=0.25 * (1 + error))
    found = likely_mistake(MODEL, sheet, picker(x, sheet))
    assert found is not None
    rate = float(found.what.split()[4])
    assert rate == pytest.approx(0.25, rel=1e-6)


@pytest.mark.parametrize(
    ("measured", "shown"), [(0.2500000158, "0.250000016"), (0.250012503, "0.2500125"), (0.25, "0.25")]
)
def test_a_spin_rate_that_differs_is_never_told_as_the_models_own(measured: float, shown: str) -> None:
    text = timing._in_digits(measured, 0.25, 300.0)
    assert text == shown
    assert (float(text) == 0.25) == (measured == 0.25)


@pytest.mark.parametrize("samples", [1, -3, 40, -200])
def test_the_shift_of_the_motion_is_measured(samples: int) -> None:
    s, x = flown(11)
    moved = {n: np.roll(v, samples) if n[:2] in ("a_", "om") else v for n, v in x.channels.items()}
    wrong = dataclasses.replace(x, channels=moved)
    found = likely_mistake(MODEL, s.sheet, picker(wrong, s.sheet))
    assert found is not None
    assert found.timing
    assert f"({abs(samples)} sample" in found.what
    assert ("late" if samples > 0 else "early") in found.what
    examined(MODEL, s.sheet, wrong)  # a note, no refusal


def test_columns_that_contradict_each_other_are_remarked() -> None:
    s, x = flown(12)
    for wrong, words in (
        (scaled(x, "omegadot", -1.0), "minus the derivative of omega_x"),
        (scaled(x, "omegadot", 180 / np.pi), "degrees for radians"),
        (
            dataclasses.replace(
                x,
                channels={
                    **x.channels,
                    "omegadot_x": x.channels["omegadot_y"],
                    "omegadot_y": x.channels["omegadot_x"],
                },
            ),
            "omegadot_x is the derivative of omega_y, not of omega_x",
        ),
    ):
        try:
            said = "\n".join(examined(MODEL, s.sheet, wrong).notes)
        except UserError as error:
            said = str(error)
        assert words in said


def test_the_fit_finds_parameters_and_noise_by_itself() -> None:
    rng = np.random.default_rng(0)
    X = rng.normal(size=(10, 1000)) * 10.0 ** np.arange(-4, 6)[:, None]
    theta = rng.normal(size=10)
    y = theta @ X + 0.01 * rng.normal(size=1000)
    found = shrunken(X, y)
    assert np.std(y - found @ X) == pytest.approx(0.01, rel=0.05)
    assert found[4:] == pytest.approx(theta[4:], abs=2e-3)
    assert abs(found[0]) < 1.0  # hardly seen: the prior holds it


def test_outliers_do_not_move_the_fit() -> None:
    s, x = flown(13)
    rng = np.random.default_rng(1)
    hit = rng.random(len(x)) < 0.02
    spoiled = dataclasses.replace(
        x, outputs={"G_out": np.where(hit, 50 * x.outputs["G_out"], x.outputs["G_out"])}
    )
    a, b = (picker(f, s.sheet) for f in (x, spoiled))
    clean, dirty = explain(MODEL, s.sheet, a.pick(a.rows())), explain(MODEL, s.sheet, b.pick(b.rows()))
    assert dirty.rms == pytest.approx(clean.rms, rel=0.05)
