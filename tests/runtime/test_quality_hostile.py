"""`ragg qc` on what strangers hand in: one clear message or an honest figure, never a traceback or a silent wrong one."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.files import write_tables
from ragg_runtime.flight.source import Column, Written
from ragg_runtime.report.quality_page import quality_html, quality_text
from ragg_runtime.survey.quality import crossovers
from ragg_runtime.survey.quality.limits import limits_with
from ragg_runtime.survey.quality.qc import Quality, qc
from ragg_runtime.survey.quality.spectra import causal_band
from ragg_runtime.survey.quality.track import Track

N = 90
T = np.arange(float(N))
ABSENT = np.full(N, np.nan)
UNITS = {"time": "s", "easting": "m", "northing": "m", "latitude": "deg", "longitude": "deg", "altitude": "m"}

Line = Mapping[str, np.ndarray]


def noise(seed: int) -> np.ndarray:
    return 5.0 * np.random.default_rng(seed).normal(size=N)


def gappy(x: np.ndarray) -> np.ndarray:
    return np.where(np.arange(N) % 5 == 0, np.nan, x)


def checked(path: Path, make: Callable[[int], Line], lines: int = 6) -> Quality:
    """Quality of lines that ``make`` gives by their number, once through text, report and JSON."""
    tables = [
        Written([(Column(n, UNITS.get(n, "Eo")), v) for n, v in make(k).items()], f"{k}<script>alert({k})")
        for k in range(lines)
    ]
    write_tables(path / "x.parquet", lambda: tables)
    q = qc([path / "x.parquet"])
    assert "<script>alert" not in quality_html(q, title="t", command="c")
    quality_text(q)
    json.dumps(q.as_json(), allow_nan=False)
    return q


def along(k: int) -> Line:
    return {"time": T, "altitude": T * 0 + 3.0 * k, "easting": 50 * T, "northing": T * 0 + 20.0 * k}


def discs(k: int, *names: str) -> Line:
    return {**along(k), **{n: noise(10 * k + i) for i, n in enumerate(names)}}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("make", "noises", "lacking"),
    [
        (lambda k: discs(k, "inline_A", "inline_B"), ["difference UV"], 0),
        (lambda k: discs(k, "inline_A", "inline_B", "cross_A"), ["difference UV"], 0),
        (lambda k: discs(k, "inline", "inline_A", "cross"), ["difference UV"], 0),
        (lambda k: discs(k, "cross_A", "cross_B"), [], 0),
        (lambda k: discs(k, "inline_1", "inline_2", "inline_3"), ["in-line sum"], 0),
        (lambda k: {n: gappy(v) if n[0] == "i" else v for n, v in discs(k, "inline_A", "inline_B").items()},
         ["difference UV"], 6),
        (lambda k: discs(k, "inline_B", "cross_A", "cross_B") | {"inline_A": ABSENT if k == 0 else noise(k)},
         ["difference UV", "difference NE"], 1),
        (lambda k: discs(k, "inline") | {"easting": 0 * T, "northing": 0 * T}, [], 0),
        (lambda k: discs(k, "inline") | {"altitude": np.where(T > 3, np.nan, T)}, [], 0),
    ],
)  # fmt: skip
def test_channels_that_are_missing(
    tmp_path: Path, make: Callable[[int], Line], noises: list[str], lacking: int
) -> None:
    q = checked(tmp_path, make)
    assert (q.names("noise"), q.lacking) == (noises, lacking)
    assert ("incomplete" in quality_text(q)) == bool(lacking)


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"easting": 1e9 * T}, "out of all proportion"),
        ({"northing": np.where(T == 5, np.inf, T)}, "out of all proportion"),
        ({"latitude": 900.0 + T, "longitude": T}, "at most 1.6 rad"),
        ({"inline": np.where(T == 5, -np.inf, T)}, "out of all proportion"),
        ({"time": 1e15 * T}, "a sample every 1e\\+15 s"),
        ({"time": 1e-12 * T}, "a sample every 1e-12 s"),
        ({"time": np.where(T == 5, 4.0, T)}, "an instant appears twice"),
        ({n: v[:2] for n, v in {"time": T, "inline": T}.items()}, "none of 3 lines .* too short"),
    ],
)
def test_what_is_refused(tmp_path: Path, columns: Line, message: str) -> None:
    base: Line = {} if len(columns.get("time", T)) < N else {"time": T, "inline": noise(1)}
    with pytest.raises(UserError, match=f"(?s){message}"):
        checked(tmp_path, lambda k: {**base, **columns}, 3)


@pytest.mark.parametrize("text", ["lag=inf", "lag=nan", "lag=0", "lag=-1", "lag", "=3", "<b>=1", "lag=1e400"])
def test_limits_that_are_none(text: str) -> None:
    with pytest.raises(UserError, match="the number above zero"):
        limits_with([text])


def test_what_is_left_out_is_said(tmp_path: Path) -> None:
    text = "time [s],inline [Eo],cross [Eo],easting,temperature [K]\n"
    (tmp_path / "x.csv").write_text(text + "".join(f"{k},3,{k % 7},{k},warm\n" for k in range(60)))
    said = quality_text(qc([tmp_path / "x.csv"], limits=["in-line-sum=3"]))
    for note in (
        "temperature holds text; it is left out",
        "easting has no unit; it is left out",
        "inline has no values, or one value alone, on 1 of 1 lines",
        "--limit in-line-sum: these channels give no such figure",
    ):
        assert f"note: {note}" in said


def test_names_do_not_steer_the_terminal(tmp_path: Path) -> None:
    """A mark that reverses the line, and a name of a page, in the table of the lines."""
    tables = [
        Written([(Column(n, UNITS.get(n, "Eo")), v) for n, v in discs(k, "inline").items()], name)
        for k, name in enumerate(["\u202eabc", "x" * 5000, "日本"])
    ]
    write_tables(tmp_path / "x.parquet", lambda: tables)
    said = quality_text(qc([tmp_path / "x.parquet"]))
    assert "\u202e" not in said
    assert max(map(len, said.splitlines())) < 300
    assert "日本" in said


def test_positions_in_degrees_over_the_date_line_and_beside_empty_eastings(tmp_path: Path) -> None:
    def line(k: int) -> Line:
        longitude = (179.98 + 1e-3 * T * (k % 2) + 180.0) % 360.0 - 180.0 if k else 180.0 - 1e-4 * T
        place = {"latitude": 1e-3 * (T - 45) * (k % 2 == 0) + 1e-4 * k, "longitude": longitude}
        return {"time": T, "inline": noise(k), **place, "easting": ABSENT, "northing": ABSENT}

    q = checked(tmp_path, line, 4)
    lengths = [f.track.length for f in q.lines if f.track is not None]
    assert len(lengths) == 4
    assert max(lengths) < 11e3  # 0.09 degrees, not a turn of the Earth and not some milliradians as metres
    assert min(lengths) > 9e3


def test_positions_that_are_no_track(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(crossovers, "MOST_CROSSINGS", 100)
    rng = np.random.default_rng(3)
    scattered = [
        Track(east=rng.normal(size=N), north=rng.normal(size=N), direction=d) for d in (0.0, np.pi / 2)
    ]
    with pytest.raises(UserError, match="positions are no tracks"):
        crossovers.crossings(scattered)


@pytest.mark.parametrize("rate", [1.0, 16.0, 100.0])
def test_bands_at_any_rate(rate: float) -> None:
    """One polynomial of the band's filter made of white noise 1e15 times as much at 16 Hz, and nothing at 100 Hz."""
    x = np.random.default_rng(2).normal(size=int(2000 * rate))
    found = causal_band(x, rate, 0.1, 0.48, 6)
    assert found is not None
    assert np.std(found) == pytest.approx(np.sqrt(0.38 / (rate / 2.0)), rel=0.1)
