"""Results in notebooks: the words of the terminal, escaped."""

from __future__ import annotations

import html
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from ragg_runtime.cli import terminal
from ragg_runtime.report import in_words
from ragg_runtime.survey.result import Survey
from ragg_runtime.wording import notebook
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.loop import Added

EXAMPLES = Path(__file__).parents[2] / "examples"
HOSTILE = "<script>alert(1)</script>&\x1b[2J\u202e"


class Result:
    """The demonstration, step by step."""

    def __init__(self, folder: Path) -> None:
        self.model = loop.new(folder / "model")
        self.flights = loop.read_flights(self.model, [EXAMPLES / "demo-flight.parquet"])
        self.before = loop.compare(self.model, self.flights)
        self.diagnosis = loop.diagnose(self.model, self.flights)
        self.step: Added = loop.add(self.model, self.diagnosis.found[0], self.flights)


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Result:
    return Result(tmp_path_factory.mktemp("display"))


class Balanced(HTMLParser):
    """Every tag is closed in its turn."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def shown(x: Any) -> str:
    """The text of a result's display, whose markup is checked."""
    parser = Balanced()
    parser.feed(x._repr_html_())
    parser.close()
    assert not parser.open
    return "\n".join(parser.text)


def test_a_notebook_shows_what_the_terminal_says(result: Result) -> None:
    for x, said in (
        (result.before, in_words.compared(result.before, ["m"], "next")),
        (result.diagnosis, in_words.diagnosed(result.diagnosis, "next")),
        (result.step, terminal.added(result.step)),
    ):
        text = shown(x)
        sentences = [
            line for line in said.split("\n") if re.match(r"\w+ .*(adequate|ADEQUATE)|MISSING|error|  dK1", line)
        ]  # fmt: skip
        assert sentences
        for sentence in sentences:
            assert sentence.strip() in text
    assert "demo-flight" in shown(result.before)
    assert "thermal-scale" in shown(result.diagnosis)
    assert f"{result.before.calibrated.rms_Eo:.4g}" in shown(result.before)
    assert f"{result.before.noise_floor:.4g}" in shown(result.before)
    history = shown(result.step.loaded)
    assert "thermal-scale" in history
    assert f"{result.step.after.calibrated.rms_Eo:.4g}" in history if result.step.after else False


def test_every_verdict_has_its_words() -> None:
    assert notebook.verdict("missing-effect", ["lag", "arm-sag"]) == "MISSING: lag and arm-sag"
    assert notebook.verdict("adequate", []).startswith("ADEQUATE")
    assert notebook.verdict("unexplained", []).startswith("UNEXPLAINED")
    with pytest.raises(KeyError):
        notebook.verdict("fine", [])


def hostile(x: Any) -> Any:
    """The same JSON with text of a stranger in it."""
    if isinstance(x, dict):
        return {k: v if k == "verdict" else hostile(v) for k, v in x.items()}
    if isinstance(x, list):
        return [hostile(v) for v in x]
    return HOSTILE if isinstance(x, str) else x


def test_names_of_strangers_are_escaped(result: Result) -> None:
    error = {"rms_Eo": 1.0}
    records = [
        {"flight": HOSTILE, "verdict": "adequate", "found": [HOSTILE], "noise_floor": error,
         "error": {"calibrated": error, "holdout": None, "after": error}},
        {"flight": HOSTILE, "error": {"kind": "input", "message": f"{HOSTILE}\nmore"}},
    ]  # fmt: skip
    unexplained = hostile(result.diagnosis.as_json()) | {
        "verdict": "unexplained",
        "unexplained": {
            "terms": [{"harmonic": HOSTILE, "term": HOSTILE, "coefficient": 1.0, "unit": HOSTILE, "z": 5.0}],
            "expression": HOSTILE,
        },
    }
    steps = hostile([s.as_json() for s in result.step.loaded.directory.history])
    pages = [
        notebook.comparison(hostile(result.before.as_json()), [HOSTILE]),
        notebook.diagnosis(hostile(result.diagnosis.as_json())),
        notebook.diagnosis(unexplained),
        notebook.added(hostile(result.step.as_json()), [HOSTILE], 4.0, True),
        notebook.model(HOSTILE, [HOSTILE], steps),
        notebook.survey(records, HOSTILE, [HOSTILE]),
    ]
    for page in pages:
        assert "<script" not in page
        assert html.escape("<script>alert(1)</script>&") in page
        assert "\x1b" not in page
        assert "\u202e" not in page


def test_a_survey_is_shown_flight_by_flight(result: Result) -> None:
    error = {k: {"rms_Eo": 8.0} for k in ("nominal", "calibrated", "holdout", "after", "after_holdout")}
    common = {"file": "", "notes": [], "ranking": [], "not_testable": [], "parameters": []}
    own = {"verdict": "missing-effect", "found": ["lag"], "indistinguishable": {"lag": []}, "error": error}
    records = [common | own | {"flight": f"{k:03}", "noise_floor": {"rms_Eo": 2.5}} for k in range(100)]
    text = shown(Survey(tuple(records)))
    assert "100 flights: 100 missing an effect" in text
    assert "recommended: add lag, which 100 of 100 flights ask for" in text
    assert "and 40 more" in text
