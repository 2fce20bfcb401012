"""From where the angle of a disc without an encoder counts: t = 0 of seconds, the first sample of instants."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks.sheet import model_text
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.files import convert
from ragg_runtime.model.evaluate import output, scale_factor, vector
from ragg_runtime.model.model import packaged
from ragg_runtime.model.record import record
from ragg_runtime.reference import simulate
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.screening import screen
from ragg_runtime.simulate import simulate_flight
from tests.rate import RATE

S = scenario(5, trim="table-v", duration=120.0, rate=RATE)


def flown(start: float) -> Flight:
    """A flight that begins when the disc has been turning for so many seconds, at whole turns (of 4 s) as at none."""
    turn = start % 4.0
    made = simulate(
        S.instrument, S.motion, S.duration, S.rate, start=turn, gravity=S.gravity, noise=S.noise, seed=1
    ).flight()
    return replace(made, time=made.time + (start - turn), began=None)


@pytest.mark.parametrize("start", [-3.0, 0.0, 0.00037, 2.0, 10.0, 1802.0])
def test_seconds_count_from_zero_whatever_the_first_sample_is(start: float) -> None:
    x = flown(start)
    r = record(x, S.sheet)
    expected = 2 * np.pi * np.mod(0.25 * x.time, 1.0)
    assert np.max(np.abs(np.exp(1j * r.phi) - np.exp(1j * expected))) < 1e-11
    assert r.time[0] == 0.0
    later = record(x.part(slice(100, None)), S.sheet)
    assert later.phi[0] == pytest.approx(np.angle(np.exp(1j * expected[100])), abs=1e-11)
    assert not [n for n in screen(packaged(), S.sheet, x).notes if "mistake" in n]


def test_instants_count_from_the_first_sample_and_the_sheet_may_say_otherwise() -> None:
    x = replace(flown(10.0), instants=True)
    assert record(x, S.sheet).phi[0] == 0.0
    cut = x.part(slice(8, None))
    assert record(cut, S.sheet).phi[0] == pytest.approx(2 * np.pi * 0.25 * 8 / RATE)
    assert abs(record(x, replace(S.sheet, angle_origin="zero")).phi[0]) == pytest.approx(np.pi)
    late = replace(S.sheet, angle_origin="first-sample")
    assert record(flown(10.0), late).phi[0] == 0.0
    assert parse_instrument(model_text(late)).angle_origin == "first-sample"
    with pytest.raises(UserError, match="angle_origin"):
        parse_instrument(model_text(late).replace("first-sample", "first"))


def test_where_the_sheet_speaks_against_it_the_user_is_asked() -> None:
    x = flown(0.0)
    x = replace(x, time=x.time + 10.0, began=None)  # half a turn
    with pytest.raises(UserError, match="angle_origin") as told:
        screen(packaged(), S.sheet, x)
    assert "at the first sample (t = 10 s), not at t = 0" in str(told.value)
    screen(packaged(), replace(S.sheet, angle_origin="first-sample"), x)


@pytest.mark.parametrize("stamp", ["2026-03-01T12:00:{:05.2f}Z", "12:00:{:05.2f}"])
def test_what_is_converted_keeps_its_angle(stamp: str, tmp_path: Path) -> None:
    columns = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "G_out")
    units = ("m/s^2",) * 3 + ("rad/s",) * 3 + ("V",)
    head = ",".join(["time", *(f"{n} [{u}]" for n, u in zip(columns, units, strict=True))])
    rng = np.random.default_rng(1)
    rows = [f"{stamp.format(10 + k / 8)},{','.join(map(str, rng.normal(size=7)))}" for k in range(64)]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]) + "\n")
    first = read_flight(tmp_path / "a.csv", 9.8)
    told = convert(tmp_path / "a.csv", tmp_path / "b.csv")
    second = read_flight(tmp_path / "b.csv", 9.8)
    assert first.instants
    assert not second.instants
    assert second.time[0] == 0.0
    np.testing.assert_allclose(record(first, S.sheet).phi, record(second, S.sheet).phi, atol=1e-9)
    assert any("time counts from" in n for n in told.notes)


def test_a_motion_that_is_flown_keeps_its_time(tmp_path: Path) -> None:
    write_flight(flown(11.0), tmp_path / "motion.parquet")
    x = simulate_flight(
        S.sheet, [], motion=tmp_path / "motion.parquet", noise=0.0, sheet_error=0.0, no_gradient=False
    )
    assert x.time[0] == 11.0
    model, r = packaged(), record(x, S.sheet)
    p = vector(model, S.sheet)
    left = (x.outputs["G_out"] - output(model.chain, r, p)) / scale_factor(model, p)
    assert np.std(left) < 1e-5
