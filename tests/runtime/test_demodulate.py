"""The demodulator: signs, gain, bandwidth, edges."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import freqz

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference import disc_angle, simulate, still
from ragg_runtime.reference.gravity import Gradient
from ragg_runtime.reference.instruments import perfect
from ragg_runtime.signals.demodulate import demodulate, low_pass

RATE = 16.0


def _channels(tensor: object, a: tuple[float, float, float] = (0.15, -0.1, 1.0)):
    flight = simulate(perfect(), still(a=a), 300, RATE, gravity=Gradient(np.asarray(tensor) * 1e-9))
    return demodulate(flight.G_out, disc_angle(0.25, flight.time), RATE, perfect().scale_factor)


@pytest.mark.parametrize(
    ("tensor", "inline", "cross"),
    [
        ([1, 0, 0, 0, 0, -1], 1, 0),
        ([0, 0, 0, 1, 0, -1], -1, 0),
        ([0, 1, 0, 0, 0, 0], 0, 1),
        ([300, 120, 50, 200, -80, -500], 100, 120),
        ([0, 0, 1, 0, 1, 0], 0, 0),
    ],
)
def test_channels_are_the_gradients_with_their_signs(
    tensor: list[float], inline: float, cross: float
) -> None:
    out = _channels(tensor)
    np.testing.assert_allclose(out.inline * 1e9, inline, rtol=0, atol=1e-5)
    np.testing.assert_allclose(out.cross * 1e9, cross, rtol=0, atol=1e-5)


def test_the_page_gives_the_formulas_of_the_code() -> None:
    """docs/reference/flight-file.md, evaluated: what it says of a pure gradient and of its demodulation is so."""
    page = (Path(__file__).parents[2] / "docs" / "reference" / "flight-file.md").read_text("utf-8")
    said = dict(re.findall(r"^    (G_out|inline|cross) = (.+)$", page, flags=re.MULTILINE))
    assert {*said} == {"G_out", "inline", "cross"}
    tensor, instrument = np.array([300, 120, 50, 200, -80, -500]) * 1e-9, perfect()
    flight = simulate(instrument, still(), 300, RATE, gravity=Gradient(tensor))
    known = {
        "sin": np.sin,
        "cos": np.cos,
        "phi": disc_angle(0.25, flight.time),
        "k_ggi": instrument.scale_factor,
    }
    G_out = eval(said["G_out"], {**known, "inline": tensor[0] - tensor[3], "cross": tensor[1]})
    np.testing.assert_allclose(flight.G_out, G_out, rtol=0, atol=1e-5 * np.max(np.abs(G_out)))
    known |= {"G_out": flight.G_out, "LP": lambda x: np.convolve(x, low_pass(RATE), "valid")}
    out = demodulate(flight.G_out, known["phi"], RATE, instrument.scale_factor)
    for name, true in (("inline", tensor[0] - tensor[3]), ("cross", tensor[1])):
        by_page = eval(said[name], dict(known))
        np.testing.assert_allclose(by_page, getattr(out, name), rtol=0, atol=1e-15)
        np.testing.assert_allclose(by_page, true, rtol=0, atol=1e-14)


def test_neighbouring_harmonics_are_stopped() -> None:
    t = np.arange(0, 600, 1 / RATE)
    phi = disc_angle(0.25, t)
    for harmonic in (0, 1, 3, 4, 5):
        out = demodulate(np.cos(harmonic * phi + 0.3), phi, RATE, 1.0)
        assert max(np.abs(out.inline).max(), np.abs(out.cross).max()) < 4e-5


def test_a_slow_gradient_comes_through_undelayed() -> None:
    t = np.arange(0, 900, 1 / RATE)
    phi = disc_angle(0.25, t)
    slow = np.sin(2 * np.pi * 0.02 * t)
    out = demodulate(0.5 * slow * np.sin(2 * phi), phi, RATE, 1.0)
    np.testing.assert_allclose(out.inline, slow[out.valid], rtol=0, atol=3e-5)
    assert out.inline.size == t.size - 2 * out.valid.start


def test_filter_is_symmetric_with_half_amplitude_at_the_cutoff() -> None:
    taps = low_pass(RATE)
    np.testing.assert_allclose(taps, taps[::-1], rtol=0, atol=1e-17)
    assert taps.size % 2 == 1
    _, response = freqz(taps, worN=[0.0, 0.1, 0.15, 0.2, 0.25, 1.0], fs=RATE)
    gain = np.abs(response)
    assert gain[:3] == pytest.approx(1, abs=2e-5)
    assert gain[3] == pytest.approx(0.5, abs=2e-3)
    assert np.all(gain[4:] < 2e-5)
    # The equivalent noise bandwidth is the paper's 0.2 Hz.
    assert np.sum(taps**2) * RATE / 2 == pytest.approx(0.2, rel=0.1)


def test_bad_records_are_refused() -> None:
    with pytest.raises(UserError, match="shorter"):
        demodulate(np.zeros(100), np.zeros(100), RATE, 1.0)
    with pytest.raises(UserError, match="one length"):
        demodulate(np.zeros(100), np.zeros(99), RATE, 1.0)
    with pytest.raises(UserError, match="sampling rate"):
        demodulate(np.zeros(100), np.zeros(100), 0.4, 1.0)
