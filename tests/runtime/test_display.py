"""Results in notebooks and on the terminal: the same sentences, escaped."""

from __future__ import annotations

import contextlib
import html
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from test_reference_pages import PYTHON
from test_report import Page

from ragg_runtime.api import Added
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.survey.result import Survey
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import render_notebook, render_text

EXAMPLES = Path(__file__).parents[2] / "examples"
HOSTILE = "<script>alert(1)</script>&\x1b[2J\u202e"


@dataclass(frozen=True)
class Result:
    """The demonstration, step by step."""

    before: Comparison
    diagnosis: Diagnosis
    step: Added


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Result:
    """README's Python as it is typed, on three minutes of the shipped flight."""
    folder, made = tmp_path_factory.mktemp("display"), dict[str, Any]()
    (folder / "examples").mkdir()
    whole = pq.read_table(EXAMPLES / "demo-flight.parquet")
    pq.write_table(whole.slice(0, 2880), folder / "examples" / "demo-flight.parquet")
    with contextlib.chdir(folder):
        exec(PYTHON, made)
    assert made["analytical"] and made["simplified"]
    return Result(made["step"].before, made["d"], made["step"])


def test_the_python_of_readme_finds_what_is_missing(result: Result) -> None:
    assert result.diagnosis.found == ("thermal-scale",)
    assert result.step.after is not None and result.step.after.adequate


def shown(x: Any) -> str:
    """The text of a result's display, whose markup is checked."""
    page = Page(x._repr_html_())
    assert not page.open
    return "\n".join(page.words)


def test_the_terminal_and_a_notebook_say_the_same(result: Result) -> None:
    for x, said in (
        (result.before, describe.describe_comparison(result.before.as_json(), ["m"])),
        (result.diagnosis, describe.describe_diagnosis(result.diagnosis.as_json())),
        (result.step, describe.describe_addition(result.step.as_json(), ["thermal-scale"])),
    ):
        text, lines = shown(x), render_text(said).split("\n")
        assert lines[0] == numbers.to_ascii(said[0].sentences[0])
        assert said[0].sentences[0] in text
    assert "demo-flight" in shown(result.before)
    assert numbers.number(result.step.after.calibrated.rms_Eo) in shown(result.step.loaded)  # type: ignore[union-attr]


def test_the_terminal_says_what_a_physicist_would(result: Result) -> None:
    """The verdict first, the determined combination, one noise floor, details on request."""
    d = result.diagnosis.as_json()
    brief, full = (render_text(describe.describe_diagnosis(d), verbose=v) for v in (False, True))
    assert brief.startswith("Missing: thermal-scale. With it the error falls from ")
    assert "thermal-scale: D34 of dK1/dT = (" in brief
    assert "D34 = A3 - A4" in brief
    assert "(-v)" in brief and "(-v)" not in full
    values: Any = result.diagnosis.ranking[0].parameters
    for q in values:
        label = numbers.to_ascii(describe.label_parameter(q.as_json()))
        assert label in full
        assert label not in brief or abs(q.value) > q.std
    assert "1e-2" not in brief and "< 1e-16" in brief
    a = result.step.as_json()
    floors = [result.before.as_json()["noise_floor"], a["before"]["noise_floor"]]  # type: ignore[index]
    assert floors[0] == floors[1] == d["noise_floor"]
    assert (a["before"]["adequate"], a["after"]["adequate"]) == (False, True)  # type: ignore[index]
    assert set(a["after"]["noise_floor"]) == {"rms_Eo", "inline_Eo", "cross_Eo"}  # type: ignore[index]


def test_every_verdict_has_its_sentence(result: Result) -> None:
    d = result.diagnosis.as_json()
    term = {"harmonic": "cos 2", "term": "a_x", "coefficient": 1.0, "std": 0.1, "unit": "V/(m/s^2)"}
    term |= {"share": 0.5, "z": 10.0}
    left: Any = dict(d["unexplained"]) | {"terms": [term]}  # type: ignore[call-overload]
    partly = d | {"verdict": "partly-explained", "unexplained": left}
    assert describe.write_verdict(partly).endswith(
        ". Not yet explained: less than the noise, mostly at cos 2Ωt × a_x."
    )
    quiet = partly | {"noise_floor": dict(d["noise_floor"]) | {"rms_Eo": 1.0}}  # type: ignore[call-overload]
    assert describe.write_verdict(quiet).endswith(" Eo, mostly at cos 2Ωt × a_x.")
    nothing = d | {"verdict": "unexplained", "found": [], "unexplained": left}
    assert describe.write_verdict(nothing).startswith("Unexplained: ")
    assert "Not explained:" in render_text(describe.describe_diagnosis(nothing))
    assert describe.write_verdict(d | {"verdict": "adequate"}).startswith("Adequate: ")
    failed = describe.write_verdict(d | {"converged": False, "remark": "stopped after"})
    assert failed == "No verdict: stopped after."


def hostile(x: Any) -> Any:
    """The same JSON with text of a stranger in it."""
    if isinstance(x, dict):
        return {k: v if k == "verdict" else hostile(v) for k, v in x.items()}
    if isinstance(x, list):
        return [hostile(v) for v in x]
    return HOSTILE if isinstance(x, str) else x


def test_names_of_strangers_are_escaped(result: Result) -> None:
    d = hostile(result.diagnosis.as_json())
    steps = hostile([s.as_json() for s in result.step.loaded.directory.history])
    for said in (
        describe.describe_comparison(hostile(result.before.as_json()), [HOSTILE]),
        describe.describe_diagnosis(d),
        describe.describe_addition(hostile(result.step.as_json()), [HOSTILE]),
        describe.describe_model(HOSTILE, [HOSTILE], steps),
    ):
        page = render_notebook(said)
        assert "<script" not in page
        assert html.escape("<script>alert(1)</script>&") in page
        for text in (page, render_text(said, verbose=True)):
            assert "\x1b" not in text
            assert "\u202e" not in text


def test_a_survey_is_shown_flight_by_flight() -> None:
    error = {k: {"rms_Eo": 8.0} for k in ("nominal", "calibrated", "holdout", "after", "after_holdout")}
    common = {"file": "", "notes": [], "ranking": [], "not_testable": [], "parameters": []}
    own = {"verdict": "missing-effect", "found": ["lag"], "indistinguishable": {"lag": []}, "error": error}
    records = [common | own | {"flight": f"{k:03}", "noise_floor": {"rms_Eo": 2.5}} for k in range(100)]
    text = shown(Survey(tuple(records)))
    assert "100 flights: 100 missing an effect" in text
    assert "recommended: add lag (needed by 100 of 100 flights)" in text
    assert "and 40 more" in text
