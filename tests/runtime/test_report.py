"""Reports, notebooks and the terminal: what they say is what the physics says, and nothing in them can reach beyond the page."""

from __future__ import annotations

import contextlib
import html
import math
import re
import warnings
from dataclasses import dataclass, replace
from functools import cache
from html.parser import HTMLParser
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from test_reference_pages import PYTHON, put_flight

from ragg_runtime.api import Added
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.calibrate import list_combinations, list_parameters
from ragg_runtime.estimation.fitted import predict_channel_noise
from ragg_runtime.identification import comparison as compare
from ragg_runtime.identification import result
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.model import model as load
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.scenario import scenario, trimmed
from ragg_runtime.report import panels
from ragg_runtime.report.pages import write_addition, write_comparison, write_diagnosis
from ragg_runtime.report.plots import draw_plot
from ragg_runtime.signals.demodulators import demodulate
from ragg_runtime.survey.result import Survey
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Bar, Bars, render_notebook, render_text
from ragg_runtime.workspace import Source
from tests.simulated import RATE, diagnosed

HOSTILE = 'leg <script>alert("1")</script> & $\\frac{x}$ \u202e\x07\udcff'


def flight(effects: EffectValues = MappingProxyType({}), name: str = "leg 1") -> Flight:
    """200 s of an instrument whose biases are 1 ug, and K7 a tenth, above its test sheet."""
    s, k = scenario(1, duration=200.0, rate=RATE), trimmed().accelerometers
    true = trimmed().replace(K0=k["K0"] + 9.8e-6, K7=k["K7"] * 1.1)
    return replace(s, instrument=true).simulate(effects).flight(name)


CUBIC = {"cubic-input": {"K_iii": [0.0, 0.0, 4e-6 / 9.8**2, 0.0]}}


@dataclass(frozen=True, eq=False)
class Case:
    comparison: compare.Comparison
    diagnosis: result.Diagnosis
    flight: Any


@pytest.fixture(scope="module")
def clean() -> compare.Comparison:
    return compare.compare(load.load_packaged(), trimmed(), [flight()])


@pytest.fixture(scope="module")
def cubic() -> Case:
    record, sheet = flight(CUBIC, name=HOSTILE), trimmed()
    return Case(compare.compare(load.load_packaged(), sheet, [record]), diagnosed(sheet, record), record)


ORIGIN = Source(
    "ragg compare <dir> leg.csv",
    files=[("model.toml", "", "ab" * 32), ('<img src="http://evil.example/x">', "", "cd" * 32)],
    title="gradiometer & leg",
)


class Page(HTMLParser):
    """Elements, attributes and text of a document."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.open: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_startendtag(tag, attrs)
        if tag not in ("meta", "br"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not {"style", "script"} & set(self.open):
            self.words.append(data)

    @property
    def text(self) -> str:
        return re.sub(r"\s+", " ", "".join(self.words))


@cache
def pages(c: Case) -> dict[str, str]:
    e = c.comparison.as_json()["error"]
    history = [
        {"action": "add", "effect": "lag <i>", "time": "2031-01-01T00:00:00Z", "before": None, "after": None},
        {"action": "add", "effect": "cubic-input", "time": "2031-01-02T00:00:00Z", "before": e, "after": e},
    ]
    texts = {"diagnose": write_diagnosis(c.diagnosis, ORIGIN)}
    with pytest.MonkeyPatch.context() as patch:  # the figures are those of the diagnosis
        patch.setattr("ragg_runtime.report.pages.draw_figure", lambda _: "<svg></svg>")
        texts["compare"] = write_comparison(c.comparison, ORIGIN)
        texts["add"] = write_addition(history, c.comparison, c.comparison, ORIGIN)
    return texts


def test_pages_are_self_contained_well_formed_and_small(cubic: Case) -> None:
    for name, text in pages(cubic).items():
        page = Page(text)
        assert page.open == [], name
        for said in (ORIGIN.command, "ab" * 32, f"numpy {np.__version__}"):
            assert said in page.text  # how to make it again
        assert len(text.encode()) < 500_000, name
        assert {"html", "svg", "table", "footer"} <= {tag for tag, _ in page.elements}
        foreign = {"link", "iframe", "object", "embed", "img", "form", "base", "foreignobject"}
        assert foreign.isdisjoint(tag for tag, _ in page.elements), name
        for tag, attributes in page.elements:
            for key, value in attributes.items():
                assert not key.startswith("on"), (name, tag, key)
                if key in ("src", "href", "xlink:href", "action"):
                    assert (value or "").startswith("#"), (name, tag, value)
        assert "@import" not in text
        for target in re.findall(r"url\(([^)]*)\)", text):
            assert target.startswith("#")
        policy = [a["content"] for t, a in page.elements if a.get("http-equiv") == "Content-Security-Policy"]
        assert str(policy[0]).startswith("default-src 'none'")
        assert "script" not in {tag for tag, _ in page.elements}


def test_names_of_strangers_are_text(cubic: Case) -> None:
    for name, text in pages(cubic).items():
        page = Page(text)
        assert "<script>" in page.text or name != "compare"
        assert "http://evil.example" in page.text
        assert not any(c in text for c in "\u202e\x07\udcff")
        text.encode("utf-8")
    added = Page(pages(cubic)["add"]).text
    assert "lag <i>" in added
    e = numbers.number(cubic.comparison.calibrated.rms_Eo)
    assert f"error {e} → {e} Eo" in added and "cubic-input" in added
    sections = describe.describe_comparison(cubic.comparison.as_json(), [HOSTILE])
    sections += describe.describe_model(HOSTILE, [HOSTILE], [])
    notebook, terminal = render_notebook(sections), render_text(sections, verbose=True)
    assert "<script" not in notebook and "&lt;script&gt;alert(" in notebook
    assert not any(c in text for c in "\u202e\x07\udcff" for text in (notebook, terminal))


@pytest.mark.usefixtures("no_figures")
def test_same_input_same_bytes(cubic: Case) -> None:
    assert write_diagnosis(cubic.diagnosis, ORIGIN) == write_diagnosis(cubic.diagnosis, ORIGIN)
    plot = panels.plot_whiteness(cubic.comparison.fitted, 0, cubic.diagnosis.residual[0], ("a_x",))
    assert draw_plot(plot) == draw_plot(plot)


def test_missing_effect_is_named_with_its_size(cubic: Case) -> None:
    """The same sentence with the same digits in the terminal, on the page and in a notebook."""
    assert cubic.diagnosis.found == ("cubic-input",)
    sections = describe.describe_diagnosis(cubic.diagnosis.as_json())
    (line,) = [x for x in sections[0].sentences if x.startswith("cubic-input: ")]
    (best,) = describe.choose_values(
        next(r.as_json() for r in cubic.diagnosis.ranking if r.effect == "cubic-input")
    )
    assert abs(best["value"]) == pytest.approx(4.0, rel=0.1)
    assert numbers.plus_minus(best["value"], best["std"]) in line
    spaces = lambda text: re.sub(r"\s+", " ", text)  # noqa: E731
    assert spaces(line) in Page(pages(cubic)["diagnose"]).text
    assert line in html.unescape(cubic.diagnosis._repr_html_())
    assert numbers.to_ascii(line) in render_text(sections).split("\n")


def test_what_a_record_sees_of_the_parameters_is_what_the_paper_derives(clean: compare.Comparison) -> None:
    """Eq. 17-19: of the biases only D1234 enters; K2 and K5 enter as Sigma (k5 - k2) and D1234 (k2 + k5)."""
    unseen = panels.list_unseen(clean.fitted)
    assert {f"{pattern} K0" for pattern in ("Sigma", "D12", "D34")} <= {*unseen}
    assert "D1234 K0" not in unseen
    matrix = panels.correlate_parameters(clean.fitted)
    places = np.argwhere(np.abs(matrix.values - np.eye(len(matrix.names))) > 0.9)
    alike = {frozenset(matrix.names[k] for k in pair) for pair in places}
    assert {frozenset({f"{pattern} K2", f"{pattern} K5"}) for pattern in ("Sigma", "D1234")} <= alike
    # a larger radius is the same as a larger scale factor
    assert frozenset({"Sigma dR", "Sigma K1"}) in alike


def test_combinations_are_known_better_than_single_values(clean: compare.Comparison) -> None:
    f = clean.fitted
    named = {q["name"]: q for q in list_combinations(f)}
    # the flight's biases are 1 ug above the test sheet in all four: D1234 stays 10 + 2 - 5 - 8 = -1 ug
    assert named["D1234 K0"]["value"] == pytest.approx(-1.0, abs=0.05)
    assert "Sigma K0" not in named
    assert all(q["std"] > 10 * named["D1234 K0"]["std"] for q in list_parameters(f) if q["name"] == "K0")
    text = render_text(panels.describe_parameters(f), verbose=True)
    assert "D1234 of K0  " in text
    assert "shift, sigma of the sheet" in text


def test_noise_in_the_channels_is_what_demodulated_noise_has(clean: compare.Comparison) -> None:
    """Against the demodulator itself, on noise drawn with the estimated density."""
    f = clean.fitted
    w = f.prepared[0]
    rng = np.random.default_rng(5)
    n = 1 << 17
    frequency = np.fft.rfftfreq(n, 1 / RATE)
    psd = sum(m.psd(np.maximum(frequency, frequency[1])) for m in w.noise.spectra)
    spectrum = np.sqrt(psd * RATE * n / 2) * np.exp(2j * np.pi * rng.random(len(frequency)))
    noise = np.fft.irfft(spectrum, n)
    phi = 2 * np.pi * 0.25 * np.arange(n) / RATE
    d = demodulate(noise, phi, RATE, f.k_ggi)
    inline, cross = predict_channel_noise(f)
    assert np.std(d.inline) == pytest.approx(inline, rel=0.05)
    assert np.std(d.cross) == pytest.approx(cross, rel=0.05)


def test_spectrum_has_the_density_of_white_noise_and_the_power_of_a_line() -> None:
    rng = np.random.default_rng(3)
    n, density, amplitude = 1 << 16, 2.0, 40.0
    time = np.arange(n) / RATE
    x = rng.normal(0, density * math.sqrt(RATE / 2), n) + amplitude * np.sin(2 * np.pi * 3.0 * time)
    spectrum = panels.estimate_spectrum(x, np.ones(n, bool), RATE)
    assert spectrum is not None
    frequency, found = spectrum
    assert np.sqrt(np.mean(found[np.abs(frequency - 3.0) > 0.2] ** 2)) == pytest.approx(density, rel=0.03)
    assert frequency[np.argmax(found)] == pytest.approx(3.0, abs=0.05)


def test_whiteness_has_99_percent_bounds_and_finds_what_is_not_noise(clean: compare.Comparison) -> None:
    f = clean.fitted
    rng = np.random.default_rng(8)
    w = f.prepared[0]
    n = len(w.observation.record.time)
    frequency = np.fft.rfftfreq(n, 1 / RATE)
    density = w.noise_psd(np.maximum(frequency, frequency[1])) * RATE / 2
    noise = np.fft.irfft(np.fft.rfft(rng.normal(size=n)) * np.sqrt(density), n)
    a_x = w.observation.record.channels["a_x"]

    def outside(residual: np.ndarray, axes: int) -> float:
        band, curve = panels.plot_whiteness(f, 0, residual, ("a_x",)).axes[axes].curves
        assert band.high is not None
        high, low = (np.interp(curve.x, band.x, y) for y in (band.high, band.y))
        return float(np.mean((curve.y > high) | (curve.y < low)))

    assert outside(noise, 0) < 0.03
    assert outside(noise, 1) < 0.03
    assert outside(noise + 0.3 * np.std(noise) * a_x / np.std(a_x), 1) > 0.03
    assert panels.find_worst_channel(f, 0, noise + 0.3 * np.std(noise) * a_x / np.std(a_x)) == "a_x"
    against = panels.plot_against(f, 0, noise, "a_x")
    assert np.mean(against.axes[1].curves[1].y) == pytest.approx(1.0, abs=0.05)
    with pytest.raises(UserError, match="no such channel"):
        panels.plot_against(f, 0, noise, "humidity")


def test_numbers_a_reader_expects() -> None:
    assert numbers.number(float("nan")) == "–"
    assert numbers.number(107234.0) == "107\u202f000"
    assert numbers.number(-0.00041) == "−4.10\u202f×\u202f10⁻⁴"
    assert numbers.plus_minus(4.0061e-8, 3.1e-10) == "(4.006\u202f±\u202f0.031)\u202f×\u202f10⁻⁸"
    assert numbers.plus_minus(40.0045, 5e-8) == "40.004500000(50)"
    assert numbers.to_ascii(numbers.plus_minus(4.0061e-8, 3.1e-10)) == "(4.006 +- 0.031)e-8"
    assert (
        numbers.to_ascii("−107\u202f000 Eo/√Hz, 2\u202f×\u202f10⁻⁷, 10⁻⁹")
        == "-107000 Eo/sqrt(Hz), 2e-7, 1e-9"
    )
    assert numbers.probability(-768.0) == "<\u202f10⁻¹⁶"
    assert numbers.probability(math.log10(0.05)) == "0.050"
    assert numbers.unit("ug/g^2") == "µg/g²"
    assert numbers.unit_of_term("V/(m/s^2*(((m/s^2)^2))*(1)*K)") == "V/((m/s²)³·K)"
    assert numbers.unit_of_term("V/(rad/s)") == "V/(rad/s)"
    latex = r"K_1 \leftarrow K_1 (1 + \partial_{\dot T} K_1\,\dot T),\; \bm f \mathrel{+}= 2\bm\omega\times\dot{\bm d}"
    assert numbers.equation(latex) == "K_1 <- K_1 (1 + d_T' K_1 T'), f += 2 omega x d'"
    assert numbers.product("a_x*omegadot_y*d_a_z") == "a_x · dω_y/dt · da_z/dt"
    assert numbers.harmonic("sin 1") == "sin Ωt"


def test_labels_in_figures_are_never_taken_for_mathematics() -> None:
    bars = (Bar("$\\frac{1}$ <b>\udc80\u202e 傾斜", 2.0), Bar("b" * 300, 3.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        text = draw_plot(Bars("x", 'a "label" <', bars, "Eo", log=True, threshold=(1.0, "needed")))
    assert "$\\frac{1}$ &lt;b&gt;" in text
    assert "傾斜" in text
    assert "b" * 60 not in text
    text.encode("utf-8")


@dataclass(frozen=True)
class Result:
    """The demonstration, step by step."""

    before: Comparison
    diagnosis: Diagnosis
    step: Added


@pytest.fixture(scope="module")
def demonstration(tmp_path_factory: pytest.TempPathFactory) -> Result:
    """README's Python as it is typed, on three minutes of the shipped flight."""
    folder, names = tmp_path_factory.mktemp("display"), dict[str, Any]()
    put_flight(folder)
    with contextlib.chdir(folder):
        exec(PYTHON, names)
    assert names["analytical"] and names["simplified"]
    return Result(names["step"].before, names["d"], names["step"])


def test_the_python_of_readme_finds_what_is_missing(demonstration: Result) -> None:
    assert demonstration.diagnosis.found == ("thermal-scale",)
    assert demonstration.step.after is not None and demonstration.step.after.adequate


def shown(x: Any) -> str:
    """The text of a result's display, whose markup is checked."""
    page = Page(x._repr_html_())
    assert not page.open
    return "\n".join(page.words)


def test_the_terminal_and_a_notebook_say_the_same(demonstration: Result) -> None:
    for x, said in (
        (demonstration.before, describe.describe_comparison(demonstration.before.as_json(), ["m"])),
        (demonstration.diagnosis, describe.describe_diagnosis(demonstration.diagnosis.as_json())),
        (demonstration.step, describe.describe_addition(demonstration.step.as_json(), ["thermal-scale"])),
    ):
        text, lines = shown(x), render_text(said).split("\n")
        assert lines[0] == numbers.to_ascii(said[0].sentences[0])
        assert said[0].sentences[0] in text
    assert "demo-flight" in shown(demonstration.before)
    assert numbers.number(demonstration.step.after.calibrated.rms_Eo) in shown(demonstration.step.loaded)  # type: ignore[union-attr]


def test_the_terminal_says_what_a_physicist_would(demonstration: Result) -> None:
    """The verdict first, the determined combination, one noise floor, details on request."""
    d = demonstration.diagnosis.as_json()
    brief, full = (render_text(describe.describe_diagnosis(d), verbose=v) for v in (False, True))
    assert brief.startswith("Missing: thermal-scale. With it the error falls from ")
    assert "thermal-scale: D34 of dK1/dT = (" in brief
    assert "D34 = A3 - A4" in brief
    assert "(-v)" in brief and "(-v)" not in full
    values: Any = demonstration.diagnosis.ranking[0].parameters
    for q in values:
        label = numbers.to_ascii(describe.label_parameter(q.as_json()))
        assert label in full
        assert label not in brief or abs(q.value) > q.std
    assert "1e-2" not in brief and "< 1e-16" in brief
    a = demonstration.step.as_json()
    floors = [demonstration.before.as_json()["noise_floor"], a["before"]["noise_floor"]]  # type: ignore[index]
    assert floors[0] == floors[1] == d["noise_floor"]
    assert (a["before"]["adequate"], a["after"]["adequate"]) == (False, True)  # type: ignore[index]
    assert set(a["after"]["noise_floor"]) == {"rms_Eo", "inline_Eo", "cross_Eo"}  # type: ignore[index]


def test_every_verdict_has_its_sentence(demonstration: Result) -> None:
    d = demonstration.diagnosis.as_json()
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


def test_a_survey_is_shown_flight_by_flight() -> None:
    error = {k: {"rms_Eo": 8.0} for k in ("nominal", "calibrated", "holdout", "after", "after_holdout")}
    common = {"file": "", "notes": [], "ranking": [], "not_testable": [], "parameters": []}
    record = {"verdict": "missing-effect", "found": ["lag"], "indistinguishable": {"lag": []}, "error": error}
    records = [common | record | {"flight": f"{k:03}", "noise_floor": {"rms_Eo": 2.5}} for k in range(100)]
    text = shown(Survey(tuple(records)))
    assert "100 flights: 100 missing an effect" in text
    assert "recommended: add lag (needed by 100 of 100 flights)" in text
    assert "and 40 more" in text
