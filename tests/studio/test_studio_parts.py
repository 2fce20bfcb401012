"""What the studio asks of the fitting room, and how it sends long series."""

from __future__ import annotations

import math
import struct
import subprocess
import time
import tomllib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow.csv
import pytest
from serving import brief, foreign, new

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification import predict
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.identification.selection import make_problem
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import write_flight
from ragg_runtime.model.directory import HistoryStep
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.studio import mapping, session, views
from ragg_runtime.studio.files import Places
from ragg_runtime.studio.routes import ACTIONS
from ragg_runtime.studio.series import HEAD, sample
from ragg_runtime.studio.session import Branches, Session
from ragg_runtime.studio.views import find_missing, mathml
from ragg_runtime.wording import numbers
from tests.layouts import sheets


@pytest.fixture(scope="module")
def diagnosis(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    folder = tmp_path_factory.mktemp("m")
    new(folder / "model")
    brief(folder / "flight.parquet")
    m = api.load(folder / "model")
    return api.diagnose(m, api.read_flights(m, [folder / "flight.parquet"]))


def test_what_is_predicted_is_what_the_derived_effect_leaves(diagnosis: Diagnosis) -> None:
    f, (found,) = diagnosis.fitted, diagnosis.found
    problem = make_problem(f, [found])
    (row,) = (r for r in diagnosis.ranking if r.effect == found)
    errors = predict.predict_error(f, problem, [found])
    assert errors == pytest.approx((row.after.rms_Eo, row.after_holdout.rms_Eo), rel=1e-3)
    assert errors[0] < 0.95 * predict.predict_error(f, problem, [])[0]


def test_the_map_of_terms_has_the_search_s_own_best(diagnosis: Diagnosis) -> None:
    from ragg_runtime.identification import omnibus

    f = diagnosis.fitted
    h = predict.score_terms(f, 0)
    best = omnibus.search_residual(f).searches[0].terms[0]
    at = h.harmonics.index(best.term.harmonic), h.products.index(best.term.product)
    assert h.z[at] == pytest.approx(best.z, rel=1e-6)
    assert abs(best.z) > h.level
    found = list(diagnosis.found)
    given = predict.score_terms(f, 0, predict.list_columns(make_problem(f, found), found))
    assert np.nanmax(np.abs(given.z)) < h.level
    # of the output as the model predicts it
    squared = predict.compute_term(f.prepared[0], "const", "G_out*G_out", 1.0)
    assert np.ptp(squared) > 0.0


def test_a_window_of_a_series_loses_no_extreme_and_no_gap() -> None:
    n = 200_003
    x = np.random.default_rng(3).normal(size=n)
    x[77_777], x[123_456] = 50.0, -60.0
    x[10_000:11_000] = np.nan
    p = sample(5.0, 0.01, x)
    for first, last, points in (
        (5.0, 2005.03, 700),
        (700.0, 1300.0, 300),
        (781.0, 784.0, 400),
        (0.0, 1e9, 100),
    ):
        data = p.window(first, last, points)
        mark, count, start, step, kind = HEAD.unpack_from(data)
        values = np.frombuffer(data, "<f4", offset=HEAD.size).reshape(1 + kind, count)
        assert mark == b"RAGG"
        assert count <= 8 * points
        half = 0.5 * step if kind else 0.0
        a, b = (
            int(np.clip(np.round((t - 5.0) / 0.01), 0, n))
            for t in (start - half + 0.005 * kind, start + (count - 1) * step + half + 0.005)
        )
        inside = x[a : b + 1].astype(np.float32)
        assert np.nanmax(values) == np.nanmax(inside)
        assert np.nanmin(values) == np.nanmin(inside)
    assert struct.calcsize("<4sIddI") == HEAD.size == 28
    gap = np.frombuffer(p.window(106.0, 114.0, 400), "<f4", offset=HEAD.size)
    assert np.isnan(gap).all()


def test_undo_and_redo_walk_along_a_branch() -> None:
    made = [
        ("new", ""),
        ("add", "lag"),
        ("add", "time-offset"),
        ("undo", "1"),
        ("undo", "0"),
        ("redo", "1"),
        ("edit", ""),
    ]
    made += [("undo", "1"), ("redo", "6"), ("calibrate", ""), ("restore", "2")]
    steps = [HistoryStep(action, "2026-01-01", effect, text="x") for action, effect in made]

    def state(count: int) -> tuple[list[int], int | None, int | None]:
        b = Branches(steps[:count])
        return b.path, b.undo, b.redo

    assert state(3) == ([0, 1, 2], 1, None)
    assert state(5) == ([0], None, 1)
    assert state(6) == ([0, 1], 0, 2)
    assert state(7) == ([0, 1, 6], 1, None)
    assert state(8) == ([0, 1], 0, 6)
    assert state(10) == ([0, 1, 6], 1, None)
    assert state(11) == ([0, 1, 2], 1, None)  # what is shown is the state after step 2


def test_a_timeline_shows_gaps_and_lone_samples() -> None:
    valid = np.ones(1000, dtype=bool)
    valid[:20] = valid[500:504] = valid[700:703] = valid[999] = False
    assert find_missing(valid, 10.0) == {"gaps": [[0.0, 2.0], [50.0, 50.4]], "alone": [70.0, 99.9]}
    valid[np.arange(0, 1000, 5)[:, None] + np.arange(4)[None]] = False
    many = find_missing(np.tile(valid, 4), 10.0)
    assert len(many["gaps"]) == 300
    assert many["gaps"] == sorted(many["gaps"])


def test_a_mapping_is_asked_tried_and_kept_but_never_laid_over_another_unasked(tmp_path: Path) -> None:
    new(tmp_path / "model")
    m = api.load(tmp_path / "model")
    path = tmp_path / "flight.csv"
    foreign(path)
    given = mapping.draft(m, path)
    asked = [r for r in given["rows"] if r["asked"]]
    assert [r["channel"] for r in asked] == ["a_x", "a_y", "a_z"]
    assert "not answered" in mapping.try_mapping(m, path, given)["error"]["what"]
    for r in asked:
        r["unit"] = "g"
    found = mapping.try_mapping(m, path, given)
    assert found["error"] is None
    x = next(p for p in found["preview"] if p["channel"] == "a_z")
    raw = pyarrow.csv.read_csv(path)["ACC_Z"].to_numpy()
    assert x["unit"] == "m/s²"
    assert x["points"] == pytest.approx(
        raw[:: len(raw) // len(x["points"])][: len(x["points"])] * m.instrument.g0
    )
    for r in asked:
        r["unit"] = "m/s^2"
    found = mapping.try_mapping(m, path, given)
    mapping.keep(m, path, given, replace=False)
    m = api.load(tmp_path / "model")
    (flight,) = api.read_flights(m, [path])
    assert flight.channels["a_z"] == pytest.approx(raw)
    assert tomllib.loads(found["text"]) == tomllib.loads((tmp_path / "model" / "mapping.toml").read_text())
    assert mapping.draft(m, path)["rows"][0]["unit"] == "m/s^2"
    (tmp_path / "model" / "mapping.toml").unlink()
    page = session.Session(Places((tmp_path.resolve(),)))
    page.open(tmp_path / "model", [])
    while page.jobs.status.job:
        time.sleep(0.05)
    ACTIONS["map"](page, {"flight": str(path), "mapping": given})  # read by the mapping that it has just kept
    while page.jobs.status.job and not page.state.flights:
        time.sleep(0.05)
    page.jobs.cancel()
    assert page.state.flights[0].channels["a_z"] == pytest.approx(raw)
    given["rows"][0]["sign"] = -1
    with pytest.raises(UserError, match="mapping already"):
        mapping.keep(m, path, given, replace=False)
    mapping.keep(m, path, given, replace=True)
    for wrong in (
        {"scale": {"a": 1}},
        {"column": 'x"\n[time]', "unit": "g"},
        {"scale": math.nan},
        {"unit": "]"},
    ):
        bad = given | {"rows": [given["rows"][0] | wrong]}
        assert mapping.try_mapping(m, path, bad)["error"]
        with pytest.raises(UserError):
            mapping.keep(m, path, bad, replace=True)


def test_another_flight_that_cannot_be_read_leaves_a_page_to_look_at(tmp_path: Path) -> None:
    """Its reading, and its failure, ended in a fault of the program: what was left out of the flight before was kept."""
    m = api.new(tmp_path / "model")
    flight = simulate_flight(m.instrument, [], seed=3, duration=30.0, rate=8.0)
    write_flight(flight, tmp_path / "x.csv")
    (tmp_path / "y.csv").write_bytes(b"\x00\x01")
    s = Session(Places((tmp_path,)))
    s._put(loaded=m, paths=(tmp_path / "x.csv",), flights=(flight,), read=(flight,), cuts=((),))
    s.open(None, [tmp_path / "y.csv"])
    s.jobs.wait(60)
    assert s.jobs.status.error is not None
    assert views.overview(s.state)["flights"] == []
    assert views.commands(s.state)


def test_an_output_is_told_from_those_of_other_flights(tmp_path: Path) -> None:
    """Two flights of one name, each with another of two outputs, were taken for one."""
    both = parse_instrument(sheets.sheet(sheets.complements(), 8, sheets.FULL))
    x = simulate_flight(both, [], seed=3, duration=30.0, rate=8.0)
    halves = [replace(x, outputs={n: x.outputs[n]}) for n in ("G_out_A", "G_out_B")]
    found = observe_flights([*halves, x], both)
    assert [(o.flight, o.place) for o in found] == [(0, 0), (1, 1), (2, 0), (2, 1)]
    assert [o.part(slice(0, 9)).flight for o in found] == [0, 1, 2, 2]


def test_every_equation_of_the_catalogue_is_typeset() -> None:
    from derive.effects import catalogue

    for e in catalogue():
        for text in (e.equation, *(q.latex for q in e.parameters)):
            assert mathml(text).startswith("<math"), (e.id, text)
        assert not set("\\{}") & set(numbers.equation(e.equation)), e.id
    assert mathml("K_x*f_i**2") == "<code>K_x*f_i**2</code>"
    assert "<script" not in mathml("\\text{<script>alert(1)</script>}")


def test_names_of_several_lines_stay_in_the_comments_of_a_shell(tmp_path: Path) -> None:
    """commands.sh is run by hand: names of strangers' files, lines and folders stand in its comments, too."""
    evil = "x\ntouch PWNED\n#"
    new(tmp_path / evil)
    m = api.load(tmp_path / evil)
    steps = (
        HistoryStep(action="add", time="", effect="lag", flights={evil: ""}),
        HistoryStep(action=evil, time=""),
    )
    shown = SimpleNamespace(
        loaded=m,
        model=SimpleNamespace(directory=SimpleNamespace(path=m.directory.path, history=(*m.directory.history, *steps))),
        paths=[tmp_path / evil / "flight.csv"],
        flights=[SimpleNamespace(name=evil)],
        cuts=[[(1.0, 2.0)]],
        diagnosed=None,
        compensated=None,
        kept=0,
    )  # fmt: skip
    script = "ragg() { :; }\n" + "\n".join(views.commands(shown))  # type: ignore[arg-type]
    assert script.count("# done: ") == 2
    subprocess.run(["sh", "-c", script], cwd=tmp_path, check=True)
    assert not (tmp_path / "PWNED").exists()
