"""`ragg qc` on lines of known noise, phase, steps and dependences, and on the real survey where the user has it."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.signal import butter, lfilter

from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import cli
from ragg_runtime.flight.files import write_tables
from ragg_runtime.flight.mapping import parse_mapping
from ragg_runtime.flight.source import Column, Written
from ragg_runtime.report.quality_galileo import tables
from ragg_runtime.report.quality_page import quality_html, quality_text
from ragg_runtime.survey.quality import galileo, galileo_lines
from ragg_runtime.survey.quality.crossovers import Repeat, crossings
from ragg_runtime.survey.quality.lines import SurveyLine
from ragg_runtime.survey.quality.qc import Quality, qc
from ragg_runtime.survey.quality.track import Track
from ragg_runtime.wording import numbers

SIGMA = 6.0  # Eo: noise of a sample of UV and NE of every disc
SPEED = 50.0  # m/s
ENVIRONMENT = "RAGG_VINTON_DOME"
"""Environment variable that names the user's copy of VintonDome.xyz."""


def field(east: np.ndarray, north: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A smooth (UV, NE) of a survey, Eo."""
    a, b = east / 2500.0, north / 3000.0
    return 40 * np.sin(a) * np.cos(b), 30 * np.cos(a + b)


def positions(number: int, ties: bool, n: int) -> tuple[np.ndarray, np.ndarray]:
    along = SPEED * (np.arange(n) - n / 2)
    if ties:
        return along, np.full(n, 2000.0 * (number - 1.5))
    return np.full(n, 1000.0 * (number - 5.0)), along[::-1] if number % 2 else along


def survey(path: Path, kind: str, *, rate: float = 1.0, phase: float = 0.0, seed: int = 0) -> Path:
    """Twelve lines, two of them one again, and four ties, on two days; discs 1-3 orthogonal, or complements A and B."""
    rng = np.random.default_rng(seed)
    n = 300
    tables = []
    plan = [(k, False) for k in range(11)] + [(5, False)] + [(k, True) for k in range(4)]
    for order, (number, ties) in enumerate(plan):
        east, north = positions(number, ties, n)
        direction = np.arctan2(east[-1] - east[0], north[-1] - north[0])
        east, north = (x + np.cumsum(rng.normal(size=n)) * 0.2 for x in (east, north))
        uv, ne = field(east, north)
        rough = rng.uniform(0.3, 1.0)
        columns = [
            (Column("time", "s"), 1e5 * (order // 8) + 600.0 * order + np.arange(n) / rate),
            (Column("easting", "m"), east),
            (Column("northing", "m"), north),
            (Column("altitude", "m"), 100 + 3 * rng.normal() + np.cumsum(rng.normal(size=n)) * 0.05),
            (Column("temperature", "degC"), np.full(n, 20 + rng.normal())),
            (Column("vertical_acceleration", "m/s2"), rough * rng.normal(size=n)),
        ]
        if kind == "orthogonal":
            parts = {"1": (uv, ne), "2": (0.3 * uv, 2 * ne), "3": (-1.3 * uv, ne)}
        else:
            turned = (ne + 1j * uv) * np.exp(2j * phase)
            parts = {"A": (turned.imag, turned.real), "B": (uv, ne)}
        for disc, (u, c) in parts.items():
            level = 100.0 * (order >= 8) if disc in "1A" else 0.0
            u = u + SIGMA * rng.normal(size=n) + level
            c = c + SIGMA * rng.normal(size=n) + (15.0 * np.cos(direction) if disc in "1A" else 0.0)
            columns += [(Column(f"inline_{disc}", "E"), 2 * u), (Column(f"cross_{disc}", "E"), c)]
        name = f"T{number}" if ties else str(10 * number + 1000 + (order == 11))
        tables.append(Written(columns, name))
    write_tables(path, lambda: tables)
    return path


@pytest.fixture(scope="module")
def three(tmp_path_factory: pytest.TempPathFactory) -> Quality:
    return qc([survey(tmp_path_factory.mktemp("qc") / "x.xyz", "orthogonal")])


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory) -> Quality:
    return qc([survey(tmp_path_factory.mktemp("qc") / "x.h5", "complements", phase=np.radians(1.5))])


def test_the_in_line_sum_is_the_noise_of_a_disc(three: Quality) -> None:
    assert three.discs.arrangement == "orthogonal"
    assert len(three.lines) == 16
    noise = np.array([f.noise["in-line sum"] for f in three.lines])
    assert np.mean(noise) == pytest.approx(SIGMA, rel=0.03)
    densities = np.array([f.densities["in-line sum"] for f in three.lines])
    assert np.sqrt(np.mean(densities**2)) == pytest.approx(SIGMA * np.sqrt(2.0), rel=0.1)  # white at 1 Hz
    assert not three.failed


def test_the_difference_of_complements_is_the_noise_of_their_mean(two: Quality) -> None:
    assert two.discs.arrangement == "complements"
    for name in ("difference UV", "difference NE"):
        noise = np.mean([f.noise[name] for f in two.lines])
        assert noise == pytest.approx(SIGMA / np.sqrt(2.0), rel=0.06), name
    figures = [f.figures["difference-noise"] for f in two.lines]
    galileo_s = [
        (f.galileo["difference_noise_UV_Eo"] + f.galileo["difference_noise_NE_Eo"]) / 2 for f in two.lines
    ]
    assert np.array(figures) == pytest.approx(np.sqrt(2.0) * np.array(galileo_s))


def test_the_phase_between_complements(two: Quality) -> None:
    found = np.array([f.phase for f in two.lines if f.phase is not None])
    assert len(found) == 16
    assert np.abs((found[:, 0] - np.radians(1.5)) / found[:, 1]).max() < 5.0
    weights = found[:, 1] ** -2
    std = weights.sum() ** -0.5
    assert abs((found[:, 0] * weights).sum() / weights.sum() - np.radians(1.5)) < 4 * std


def test_crossovers_and_repeats(three: Quality) -> None:
    assert len(three.crossings) == 48  # 12 lines over 4 ties
    by_name = {m.channel: m for m in three.misfits}
    assert by_name["inline_1"].count == 48
    assert by_name["inline_1"].rms > 100.0  # the step between the days, twice as large in inline
    # Linear interpolation between two samples leaves 0.82 of white noise; the gravity is the same for both.
    assert 0.75 * 2 * SIGMA < by_name["inline_2"].levelled < 1.15 * 2 * SIGMA
    assert [(r.first, r.second) for r in three.repeats] == [("1050", "1051")]
    assert three.repeats[0].noise["cross_2"] == pytest.approx(0.82 * SIGMA, rel=0.25)
    assert three.repeats[0].shared == pytest.approx(299 * SPEED, rel=0.02)


def test_crossings_are_where_they_are() -> None:
    n = 1000
    x = np.linspace(-500.0, 500.0, n)
    first = Track(east=x, north=0.3 * x, direction=float(np.arctan2(1.0, 0.3)))
    second = Track(east=40 + 0.1 * x, north=x, direction=float(np.arctan2(0.1, 1.0)))
    (c,) = crossings([first, second, None])
    assert c.east == pytest.approx(40 / (1 - 0.03), abs=1e-9)
    assert c.north == pytest.approx(0.3 * c.east, abs=1e-9)
    assert np.interp(c.at_first, np.arange(n), first.east) == pytest.approx(c.east, abs=1e-9)
    assert np.interp(c.at_second, np.arange(n), second.north) == pytest.approx(c.north, abs=1e-9)


def test_dependences_and_days(three: Quality) -> None:
    found = {(d.of, d.on): d for d in three.dependences}
    heading = found["mean of NE 1", "cos(heading)"]
    assert heading.p_value < 1e-3
    assert abs(heading.slope - 15.0) < 4 * heading.std
    assert not [k for k, d in found.items() if d.p_value < 1e-4 and k[0].startswith("noise")]
    assert found["in-line sum", "vertical acceleration squared"].p_value > 1e-4
    steps = [d for d in three.days if d.step is not None and d.channel == "UV 1"]
    assert steps == []  # without dates or flights there is one group


def test_days_by_their_dates(tmp_path: Path) -> None:
    path = survey(tmp_path / "x.xyz", "orthogonal")
    names = ("easting", "northing", "inline_1", "cross_1", "inline_2", "inline_3")
    columns = "\n".join(f'{n} = {{ column = "{n}" }}' for n in names)
    mapping = parse_mapping(
        f'[time]\ncolumn = "time"\norigin = 2026-03-01T06:00:00Z\n[columns]\n{columns}\n', tmp_path
    )
    q = qc([path], mapping)
    step = next(d for d in q.days if d.step is not None and d.channel == "UV 1")
    assert (step.name, step.lines) == ("2026-03-02", 8)
    assert step.step is not None
    assert step.step_std is not None
    assert abs(step.step - 100.0) < 4 * step.step_std
    assert q.lines[0].as_json()["begins"] == "2026-03-01T06:00:00.000Z"


def test_rectified_vibration_is_seen(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    n, rate, k = 4000, 8.0, 7.0
    tables = []
    for line in range(4):
        rough = 0.5 + 0.5 * np.sin(np.arange(n) / 400.0 + line)
        b, a = butter(2, [0.5, 3.0], "band", fs=rate)
        a_z = 9.8 + rough * lfilter(b, a, rng.normal(size=n))
        noise = [3 * rng.normal(size=n) for _ in range(4)]
        columns = [
            (Column("time", "s"), np.arange(n) / rate + 1000.0 * line),
            (Column("a_z", "m/s^2"), a_z),
            (Column("inline_A", "Eo"), 2 * (noise[0] + 2 * k * (a_z - 9.8) ** 2)),
            (Column("inline_B", "Eo"), 2 * noise[1]),
            (Column("cross_A", "Eo"), noise[2]),
            (Column("cross_B", "Eo"), noise[3]),
        ]
        tables.append(Written(columns, str(line)))
    write_tables(tmp_path / "x.parquet", lambda: tables)
    q = qc([tmp_path / "x.parquet"])
    found = {d.of: d for d in q.dependences if d.on == "vertical acceleration squared"}
    assert found["difference UV"].p_value < 1e-6
    assert (
        abs(found["difference UV"].slope - k) < 4 * found["difference UV"].std + 0.1 * k
    )  # the band takes a little
    assert found["difference NE"].p_value > 1e-3
    rough_ones = [f.rough.made_of for f in q.lines if f.rough is not None]
    assert rough_ones == ["a_z, 0.3 to 3.6 Hz"] * 4


def test_limits_and_failures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    survey(Path("x.xyz"), "orthogonal")
    run = CliRunner().invoke(
        cli, ["qc", "x.xyz", "--limit", "in-line-sum=5", "--json", "q.json", "--report", "q.html"]
    )
    assert (run.exit_code, run.exception) == (0, None)
    data = json.loads(Path("q.json").read_text())
    assert all("in-line-sum" in x["failed"] for x in data["lines"])
    limit = next(x for x in data["limits"] if x["name"] == "in-line-sum")
    assert (limit["failed"], limit["source"]) == (16, "given with --limit")
    page = Path("q.html").read_text()
    assert page.count("<svg") == 4
    assert "Crossovers" in page
    assert "galileoQC" in page
    assert "http" not in page.split("<body>")[1].replace("http://www.w3.org", "")
    assert "16 lines, 16 beyond a limit." in run.output
    run = CliRunner().invoke(cli, ["qc", "x.xyz", "--limit", "in-line=5"])
    assert isinstance(run.exception, UserError)


def test_the_same_bytes(tmp_path: Path, three: Quality) -> None:
    again = qc([survey(tmp_path / "x.xyz", "orthogonal")])
    assert quality_html(again, title="t", command="c") == quality_html(three, title="t", command="c")
    assert quality_text(again) == quality_text(three)
    assert json.dumps(again.as_json()) == json.dumps(three.as_json())


def test_the_report_has_galileos_figures(three: Quality) -> None:
    """Every table that the survey gives rise to, with the figures that the JSON holds."""
    found = {t.title.split(" (")[0]: t for t in tables(three)}
    assert list(found) == ["By line", "Crossovers", "Repeat lines"]
    line = three.lines[3]
    (row,) = [r for r in found["By line"].rows if r[0] == line.line.name]
    assert row[1] == numbers.number(line.galileo["in_line_sum_Eo"])
    first = three.galileo["crossovers"][0]
    (row,) = [r for r in found["Crossovers"].rows if r[0] == first["line"]]
    assert row[1:4] == (str(first["count"]), numbers.number(first["rms"]), numbers.number(first["largest"]))
    assert all(len(r) == len(t.heads) for t in found.values() for r in t.rows)
    page = quality_html(three, title="t", command="c")
    assert all(t.title in page for t in found.values())


def test_a_single_disc_without_positions(tmp_path: Path) -> None:
    rng = np.random.default_rng(4)
    columns = [(Column("time", "s"), np.arange(200.0)), (Column("inline", "Eo"), rng.normal(size=200))]
    write_tables(tmp_path / "x.csv", lambda: [Written(columns)])
    q = qc([tmp_path / "x.csv"])
    assert (q.discs.arrangement, len(q.crossings), q.lines[0].track) == ("single", 0, None)
    assert q.lines[0].densities["UV"] == pytest.approx(np.sqrt(2.0) / 2, rel=0.4)
    assert "cannot be separated" in quality_html(q, title="x", command="c")
    with pytest.raises(UserError, match="needs 2 discs"):
        qc([tmp_path / "x.csv"], arrangement="complements")


def test_bad_lines_do_not_hinder_the_others(tmp_path: Path) -> None:
    text = "line [1],time [s],inline [Eo]\n"
    text += "".join(f"1,{k},{k % 7}\n" for k in range(60)) + "2,0,1\n2,1,2\n"
    text += "".join(f"3,{5 if k == 9 else k},{k % 7}\n" for k in range(60))
    (tmp_path / "x.csv").write_text(text)
    q = qc([tmp_path / "x.csv"])
    assert [f.line.name for f in q.lines] == ["1"]
    assert {n for n, _ in q.read.refused} == {"2", "3"}
    assert "could not be used" in quality_html(q, title="x", command="c")
    (tmp_path / "y.csv").write_text("time [s],a_x [g]\n" + "".join(f"{k},1\n" for k in range(60)))
    with pytest.raises(UserError, match="no gradient that a disc"):
        qc([tmp_path / "y.csv"])


def test_galileos_lag_finds_a_shift() -> None:
    rng = np.random.default_rng(5)
    x = lfilter([1.0], [1.0, -0.9], rng.normal(size=600))
    assert galileo.phase_lag(x[3:-3], x[6:], 2.0) == pytest.approx(1.5, abs=0.06)


def straight(
    name: str, start: tuple[float, float], step: tuple[float, float], **channels: np.ndarray
) -> tuple[SurveyLine, Track]:
    """A line of evenly spaced samples along a straight track."""
    n = len(next(iter(channels.values())))
    east, north = (a + b * np.arange(n) for a, b in zip(start, step, strict=True))
    line = SurveyLine(name=name, flight="f", time=np.arange(n) * 1.0, rate=1.0, channels=channels)
    return line, Track(east=east, north=north, direction=float(np.arctan2(*step)))


def test_galileos_gaps_crossovers_and_repeats() -> None:
    z = np.arange(100.0)
    holed = np.where(z == 7, np.nan, z)
    traverse = straight("10", (0.0, -480.0), (0.0, 10.0), altitude=z)
    ties = [
        straight(f"T{k}", (-480.0, 100.0 * k), (10.0, 0.0), altitude=50.0 + k + 0.0 * z) for k in range(3)
    ]
    beside = straight("20", (5000.0, -480.0), (0.0, 10.0), altitude=holed)
    lines, tracks = zip(traverse, *ties, beside, strict=True)
    assert galileo_lines.gaps(lines) == [{"line": "20", "missing": {"altitude": 1}}]
    found = galileo_lines.crossovers(lines, tracks, ["altitude"])
    (mine,) = [c for c in found if c["line"] == "10"]  # samples 48, 58 and 68 over 50, 51 and 52
    assert (mine["count"], mine["largest"]) == (3, 16.0)
    assert mine["rms"] == pytest.approx(np.std([-2.0, 7.0, 16.0]))
    assert mine["rms_root2"] == pytest.approx(mine["rms"] / np.sqrt(2.0))
    assert [c["count"] for c in found if c["line"][0] == "T"] == [1, 1, 1]

    wave = np.sin(z / 15.0)
    again = [
        straight("a", (0.0, 0.0), (10.0, 0.1), g=wave),
        straight("b", (0.0, 5.0), (10.0, 0.0), g=wave + 3.0),
        straight("c", (990.0, 5.0), (-10.0, 0.0), g=(wave + np.cos(z / 9.0))[::-1]),
    ]
    lines, tracks = zip(*again, strict=True)
    r = galileo_lines.repeat_lines(lines, tracks, [0, 1, 2], "g")
    assert r is not None
    inner = [wave, wave + 3.0, wave + np.cos(z / 9.0)]
    off = np.array(inner) - np.mean(inner, axis=0)
    assert list(r["lines"].values()) == pytest.approx(np.std(off, axis=1), rel=1e-4)
    assert r["all"] == pytest.approx(np.mean(np.std(inner, axis=0)), rel=1e-4)
    pairs = [Repeat("a", "c", 900.0, {}), Repeat("c", "b", 900.0, {})]
    assert galileo_lines.groups(lines, pairs) == [[0, 1, 2]]


VINTON = """
[time]
column = "Time"
unit = "s"
origin = 1980-01-06T00:00:00Z
[columns]
easting = { column = "X", unit = "m" }
northing = { column = "Y", unit = "m" }
altitude = { column = "Altitude", unit = "m" }
cross_1 = { column = "Cross1_raw", unit = "E" }
cross_2 = { column = "Cross2_raw", unit = "E" }
cross_3 = { column = "Cross3_raw", unit = "E" }
inline_1 = { column = "Inline1_raw", unit = "E", scale = 2 }
inline_2 = { column = "Inline2_raw", unit = "E", scale = 2 }
inline_3 = { column = "Inline3_raw", unit = "E", scale = 2 }
"""


@pytest.mark.skipif(ENVIRONMENT not in os.environ, reason=f"{ENVIRONMENT} does not name VintonDome.xyz")
def test_the_survey_over_vinton_dome() -> None:
    """Figures that galileoQC 1.0.16 itself gives of its lines, run beside (see docs/quality.md)."""
    q = qc([Path(os.environ[ENVIRONMENT])], parse_mapping(VINTON, Path("vinton.toml")))
    assert len(q.lines) == 91
    assert len([f for f in q.lines if f.line.name.startswith("T")]) == 17
    line = next(f for f in q.lines if f.line.name == "11")
    assert line.galileo["in_line_sum_Eo"] == pytest.approx(8.82428612002832, rel=1e-9)
    assert line.galileo["in_line_sum_filtered_Eo"] == pytest.approx(5.570033764946008, rel=1e-6)
    assert line.galileo["frobenius_Eo"] == pytest.approx(118.95881167258771, rel=1e-8)
    assert line.figures["high-frequency-orthogonal"] == pytest.approx(8.27547872472793, rel=1e-8)
    assert line.galileo["turbulence_of_altitude"] == pytest.approx(0.3534008661544658, rel=1e-12)
    assert len(q.crossings) == 1258  # 74 lines over 17
    assert {d.name for d in q.days} == {"2008-07-03", "2008-07-04", "2008-07-05", "2008-07-06"}
    assert all(r.first.split(".")[0] == r.second.split(".")[0] for r in q.repeats)
    assert len(q.repeats) == 23
    crossed = {
        (c["line"], c["channel"]): c for c in q.galileo["crossovers"]
    }  # as checkIntersection, mode RMS
    assert crossed["11", "altitude"]["rms"] == pytest.approx(11.040368919040345, rel=1e-12)
    assert q.galileo["gaps"] == []


def test_odd_channels_and_the_same_line_twice(tmp_path: Path) -> None:
    """Values whose squares overflow ended in a traceback, a channel that stands still in a warning."""
    rng = np.random.default_rng(8)
    noise = rng.normal(size=90)

    def file(name: str, **channels: np.ndarray) -> Path:
        columns = [(Column("time", "s"), np.arange(90.0))]
        write_tables(
            tmp_path / name,
            lambda: [Written([*columns, *((Column(n, "Eo"), x) for n, x in channels.items())])],
        )
        return tmp_path / name

    good = file("a.csv", inline=noise)
    others = [
        file("b.parquet", inline=noise),
        file("c.csv", inline=1e300 * noise),
        file("d.csv", inline=0.0 * noise),
    ]
    q = qc([good, *others])
    said = dict(q.read.refused)
    assert [f.line.name for f in q.lines] == ["a", "d"]
    assert "the same record as line a of a: it would count twice" in said["b"]
    assert "out of all proportion" in said["c"]
    json.dumps(q.as_json(), allow_nan=False)
    quality_html(q, title="t", command="c")
    quality_html(qc([others[2]]), title="t", command="c")
