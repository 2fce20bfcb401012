"""The array of MEMS sensors: the record that ships with the project, and what its calibration must find."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest

from examples.mimu import elsewhere, record
from examples.mimu.record import sheet
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import read_flight
from ragg_runtime.model import derive

HERE = Path(record.__file__).parent
RADIUS = 0.013364


def calibrated(i: Instrument, *names: str) -> Fitted:
    model = derive.load_model(i, candidates=False)
    flights = [read_flight(HERE / f"{n}.parquet", i.g0, accelerometers=i.layout) for n in names]
    return fit(model, i, observe_flights(flights, i))


def values(c: Calibration, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Values and standard deviations of a parameter, SI."""
    at = [n for n, q in enumerate(c.columns) if q.name == name]
    return c.p[c.index[at]], np.array([np.sqrt(c.covariance[n, n]) * c.columns[n].scale for n in at])


@pytest.fixture(scope="module")
def unlifted() -> Fitted:
    """A sheet that does not know that the gradiometer lies above the motion sensors."""
    return calibrated(parse_instrument(sheet(height="0 mm", lift="10")), "rests", "motion")


def test_motion_tells_where_the_accelerometers_are(unlifted: Fitted) -> None:
    c = unlifted.calibration
    K1, std = values(c, "K1")
    assert np.max(np.abs(K1 * 9.81 - 1)) < 0.01 and np.max(std * 9.81) < 2e-3  # against gravity, at rest
    dR, _ = values(c, "dR")
    assert np.max(np.abs(dR)) < 1e-3
    assert abs(np.mean(dR)) < 3e-4
    lifted, std = values(c, "beta_x")
    height = RADIUS * lifted
    assert np.mean(height) == pytest.approx(2e-3, abs=3e-4)  # the two sides of the board
    assert np.max(np.abs(height - 2e-3)) < 6e-4
    assert np.max(RADIUS * std) < 3e-4


def test_the_lever_arm_that_is_left_out_is_found_and_agrees_with_the_survey() -> None:
    d = elsewhere.diagnosed(elsewhere.FLAT)
    assert d.verdict == "missing-effect"
    assert {"imu-lever-arm", "gyro-delay"} <= set(d.found) <= elsewhere.FOUNDED
    arm = {q.name: q for r in d.ranking if r.effect == "imu-lever-arm" for q in r.parameters}
    for name, known in (("l_x", 0.0), ("l_y", 0.0), ("l_z", -2e-3)):
        assert abs(arm[name].value - known) < 3 * arm[name].std
    assert arm["l_z"].std < 3e-4


def test_packets_are_read_and_broken_ones_left_out(tmp_path: Path) -> None:
    counts = (np.arange(48) - 40).astype(">i2")
    payload = bytes(4) + counts.tobytes()
    head = b"\xaa\x00\x01\x64"
    whole = head + payload
    packet = whole + (sum(whole) & 0xFFFF).to_bytes(2, "big")
    broken = bytearray(packet)
    broken[40] ^= 0xFF
    raw = tmp_path / "raw.bin.gz"
    raw.write_bytes(gzip.compress(b"\x01\xaa" + packet + bytes(broken) + packet))
    packets = record.packets(gzip.decompress(raw.read_bytes()))
    assert packets.shape == (2, 8, 2, 3)
    assert np.array_equal(packets[0].reshape(-1), counts)
    force, rate, saturated = record.read(raw)
    assert force.shape == rate.shape == (2, 8, 3)
    assert not saturated.any()
    x, y, z = counts.reshape(8, 2, 3)[1, 0] * (9.81 / 2048)
    assert force[0, 1] == pytest.approx([-y, -x, -z])


def test_angular_acceleration_of_a_rigid_body() -> None:
    """What the four of the back feel of a pure rotation gives the rotation back."""
    rng = np.random.default_rng(0)
    omega, alpha, a = rng.standard_normal((3, 50, 3)) * np.array([30.0, 500.0, 20.0])[:, None, None]
    force = np.zeros((50, 8, 3))
    for k, (x, y) in enumerate(record.CORNERS):
        r = record.HALF * np.array([x, y, 0.0])
        force[:, 2 * k + 1] = a + np.cross(alpha, r) + np.cross(omega, np.cross(omega, r))
    assert record.angular_acceleration(force, omega) == pytest.approx(alpha)
