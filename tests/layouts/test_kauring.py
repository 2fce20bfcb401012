"""An instrument of one accelerometer: an airborne gravimeter, and the Eotvos effect that its model lacks."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from examples import kauring

ENVIRONMENT = "RAGG_KAURING"
"""Path of GRAV.DAT in the sdist of galileoqc; its licence keeps it out of the project."""


def survey(path: Path) -> None:
    """A flight of lines to and fro in columns as those of GRAV.DAT, the Earth turning."""
    rng = np.random.default_rng(1)
    rows = []
    for flight in (1,):
        for line in range(8):
            t = 700.0 * line + np.arange(0.0, 500.0, 0.5)
            v = 45.0 * (-1) ** line
            latitude = -32.0 + 1e-3 * line
            shake = 0.01 * np.cumsum(rng.normal(size=len(t))) / np.sqrt(len(t)) + 0.02 * np.sin(0.3 * t)
            normal, height = 979483.0 + line, 117.0
            eotvos = -2 * kauring.EARTH_RATE * np.cos(np.deg2rad(latitude)) * v - v**2 / kauring.EARTH_RADIUS
            FZ = (shake + eotvos + 3e-4 * rng.normal(size=len(t))) / kauring.MGAL + normal - height
            row = np.zeros((len(t), 36))
            place = kauring.COLUMNS
            for name, x in (
                ("east", v * (t - t[0])), ("north", 3e3 * line + 0 * t), ("line", 100.0 * flight + line),
                ("flight", flight), ("second", t), ("latitude", latitude), ("FZ", FZ),
                ("AZ", shake / kauring.MGAL), ("LATCOR", normal), ("FACOR", height),
            ):  # fmt: skip
                row[:, place[name]] = x
            rows.append(row)
    np.savetxt(path, np.concatenate(rows), fmt="%.7f")


def test_the_effect_of_a_turning_earth_is_left_over_and_measured(tmp_path: Path) -> None:
    survey(tmp_path / "GRAV.DAT")
    found = kauring.eotvos(tmp_path / "GRAV.DAT")
    assert found.diagnosis.verdict == "unexplained"
    assert found.diagnosis.terms()[0]["term"] == "v_E"
    assert abs(found.ratio - 1.0) < min(0.01, 4 * found.std)


@pytest.mark.skipif(ENVIRONMENT not in os.environ, reason=f"{ENVIRONMENT} does not name GRAV.DAT")
def test_the_lines_over_kauring() -> None:
    found = kauring.eotvos(Path(os.environ[ENVIRONMENT]))
    assert found.diagnosis.verdict == "unexplained"
    assert found.diagnosis.terms()[0]["term"] == "v_E"
    assert abs(found.ratio - 1.0) < 0.01
    assert found.std < 0.01
