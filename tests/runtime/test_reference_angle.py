"""The disc angle must stay exact for days."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from ragg_runtime.reference.angle import disc_angle, turns


@pytest.mark.parametrize("frequency", [0.25, 0.1, 1 / 3, 0.24999999999999, 7.123456789012345, 1e-4])
def test_turns_agree_with_arbitrary_precision_after_ten_days(frequency: float) -> None:
    rng = np.random.default_rng(1)
    times = np.concatenate([1e6 * rng.random(200), 1e6 - np.arange(5) / 16, -1e5 * rng.random(5)])
    with mpmath.workdps(60):
        for t, computed in zip(times, turns(frequency, times), strict=True):
            exact = mpmath.mpf(float(frequency)) * mpmath.mpf(float(t))
            gap = exact - mpmath.mpf(float(computed))
            assert abs(gap - mpmath.nint(gap)) < 1.2e-16


def test_nanosecond_shift_survives_a_long_time() -> None:
    shift = 1.234567e-9
    moved = disc_angle(0.25, np.array([0.0]), shift) - disc_angle(0.25, np.array([0.0]))
    assert moved[0] == pytest.approx(-2 * np.pi * 0.25 * shift, rel=1e-12, abs=0)
    late = disc_angle(0.25, np.array([9e5 + 0.25]), shift) - disc_angle(0.25, np.array([9e5 + 0.25]))
    # What is left is the rounding of an angle near 0.4 rad, not that of a time near 1e6 s (1e-10 s).
    assert late[0] == pytest.approx(moved[0], abs=2e-16)
