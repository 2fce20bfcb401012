"""Likely mistakes: named where they are, never where the record is right, whatever effect is hidden in it."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.layout import paper
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.model.model import make_vector, scale_factor
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.screening import mistakes, screen, timing
from ragg_runtime.screening.linear_fit import make_sampler
from ragg_runtime.screening.mistakes import Finding, find_mistake
from ragg_runtime.signals.demodulators import demodulate

G0 = 9.8
MODEL = model.load_packaged()
DURATION = 120.0


@cache
def drawn(seed: int, trim: Any = "matched") -> Scenario:
    return scenario(seed, duration=DURATION, trim=trim)


def flown(seed: int, effects: dict[str, Any] | None = None, trim: Any = "matched", **options: Any) -> Flight:
    voltages = options.pop("voltages", False)
    return drawn(seed, trim).simulate(effects or {}, **options).flight(voltages=voltages)


def found_in(x: Flight, sheet: Any) -> Finding | None:
    return find_mistake(make_sampler(MODEL, sheet, x))


def changed(x: Flight, change: Callable[[str, np.ndarray], np.ndarray]) -> Flight:
    return replace(x, channels={n: change(n, v) for n, v in x.channels.items()})


SEARCHES: dict[str, tuple[Any, str, Any]] = {
    "timing": (timing, "propose_times", lambda _: []),
    "losses": (timing, "_propose_losses", lambda _: []),
    "columns": (mistakes, "list_mistakes", lambda _: iter(())),
    "all": (sys.modules[screen.__module__], "find_mistake", lambda _: None),
}
"""Searches of mistakes that most tests can do without: they take nearly all of the time."""


def leave_out(monkeypatch: pytest.MonkeyPatch, *names: str) -> None:
    for name in names:
        monkeypatch.setattr(*SEARCHES[name])


def screened(seed: int, flight: Flight, trim: Any = "matched") -> list[str]:
    """What is said of a flight with the sheet of this seed, or why it is refused."""
    try:
        return list(screen(MODEL, drawn(seed, trim).sheet, flight).notes)
    except UserError as refused:
        return [str(refused)]


def test_a_good_flight_is_left_alone() -> None:
    for s, x in (
        (drawn(0), flown(0, voltages=True, record_gradient=False)),
        (drawn(1, "table-v"), flown(1, trim="table-v")),
    ):
        flight = screen(MODEL, s.sheet, x)
        assert flight.flags == () and flight.valid.all()


def test_a_hidden_effect_is_no_mistake() -> None:
    """Beside a force that is written at half the rate, too, which alone is said."""
    x, sheet = flown(7, {"time-offset": {"delta_t": 1e-2}}), drawn(7).sheet
    held = screen(MODEL, sheet, changed(x, lambda n, v: np.repeat(v[::2], 2) if n[:2] == "a_" else v))
    assert [f.columns for f in held.flags] == [("a_x", "a_y", "a_z")]


@pytest.mark.parametrize("trim", ["matched", "table-v"])
def test_the_mistake_is_named_on_any_instrument(monkeypatch, trim: str) -> None:
    leave_out(monkeypatch, "timing")
    x = flown(9, trim=trim, record_gradient=False)
    c = x.channels
    for wrong, words in (
        (changed(x, lambda n, v: v / G0 if n[:2] == "a_" else v), "a_x, a_y, a_z are in g, not in m/s^2"),
        (replace(x, outputs={n: 1e3 * v for n, v in x.outputs.items()}), "in mV, not in V"),
        (replace(x, channels={**c, "a_x": c["a_z"], "a_z": c["a_x"]}), "a_x and a_z are exchanged"),
    ):
        (note,) = screened(9, wrong, trim)
        assert "likely mistake" in note and words in note


def test_a_scale_factor_off_its_sheet_is_no_wrong_unit(monkeypatch) -> None:
    """1 to 5 % off sheets that are sure to 1e-4, alike or each by itself; the sheet of another instrument; or a null bias, with which
    smaller outputs would stay closer to the sheet, but not explain the record.
    """
    leave_out(monkeypatch, "timing")
    sheet, x = drawn(9, "table-v").sheet, flown(9, trim="table-v")
    K1 = sheet.accelerometers["K1"]
    for off in (np.array([1.03, 0.98, 1.01, 0.99]), np.full(4, 1.05)):
        wrong = replace(sheet.replace(K1=off * K1), sigmas={"K1": 1e-4 * K1})
        (flag,) = screen(MODEL, wrong, x).flags
        assert re.search(r"the test sheet is too confident: K1 of A\d is [\d.]+ instead of", flag.reason)
        assert not flag.open
    other = drawn(9).sheet
    assert "K1 of A4" in screen(MODEL, other, x).flags[0].reason
    off = drawn(9).sheet.accelerometers["K0"] + [0.0, 0.0, 0.0, 0.02]
    assert not any("mV" in f.reason for f in screen(MODEL, other.replace(K0=off), flown(9)).flags)


def test_nothing_is_named_where_nothing_follows_the_motion() -> None:
    x, sheet = flown(9), drawn(9).sheet
    noise = np.std(x.outputs["G_out"]) * np.random.default_rng(1).standard_normal(len(x))
    assert found_in(replace(x, outputs={"G_out": noise}), sheet) is None


def test_the_spin_rate_is_measured(monkeypatch) -> None:
    leave_out(monkeypatch, "columns", "losses")
    finding = found_in(flown(10), replace(drawn(10).sheet, layout=paper(0.1, 0.25 * 0.97)))
    assert finding is not None
    assert float(finding.best.what.split()[4]) == pytest.approx(0.25, rel=1e-6)


@pytest.mark.parametrize(("samples", "of"), [(1, ("a_", "om")), (-32, ("a_",))])
def test_what_is_late_is_measured_and_flagged(monkeypatch, samples: int, of: tuple[str, ...]) -> None:
    leave_out(monkeypatch, "columns", "losses")
    x = changed(flown(11), lambda n, v: np.roll(v, samples) if n.startswith(of) else v)
    (flag,) = (f for f in screen(MODEL, drawn(11).sheet, x).flags if f.open)
    assert f"({abs(samples)} sample" in flag.reason
    assert ("late" if samples > 0 else "early") in flag.reason
    assert flag.effects == (("time-offset",) if len(of) == 2 else ())
    assert ("the motion record" if len(of) == 2 else "a_x, a_y, a_z are 2 s") in flag.reason


def counted(x: Flight, rows: np.ndarray) -> Flight:
    """Some of the rows of a flight, with stamps that are made of their numbers."""
    return replace(
        x,
        time=x.time[0] + np.arange(len(rows)) / x.rate,
        valid=x.valid[rows],
        channels={n: v[rows] for n, v in x.channels.items()},
        outputs={n: v[rows] for n, v in x.outputs.items()},
    )


@pytest.mark.parametrize(("gap", "lost"), [(100, {640: 1}), (0, {384: 4, 960: 9, 1536: 1})])
def test_lost_rows_are_said_before_the_disc_is_blamed(monkeypatch, gap: int, lost: dict[int, int]) -> None:
    """At one place, with samples left out on both sides of it, or at several."""
    leave_out(monkeypatch, "columns")
    x, gone = flown(12), np.concatenate([k + np.arange(n) for k, n in lost.items()])
    wrong = counted(x, np.delete(np.arange(len(x)), gone))
    wrong = replace(wrong, valid=wrong.valid & (np.abs(np.arange(len(wrong)) - gone[0] + 0.5) > gap))
    reason = " ".join(screened(12, wrong))
    losses = [(float(at), int(rows)) for at, rows in re.findall(r"at t = ([\d.]+) s: (\d+) row", reason)]
    assert "rows are missing" in reason and [rows for _, rows in losses] == [*lost.values()]
    before = np.cumsum([0, *lost.values()])[:-1]
    assert np.allclose([at for at, _ in losses], (np.array([*lost]) - before) / 16, atol=1.0 + gap / 16)
    assert "write spin_frequency" not in reason


def test_rows_that_lack_or_are_doubled_all_along_are_said(monkeypatch) -> None:
    leave_out(monkeypatch, "columns")
    x, rng = flown(12), np.random.default_rng(1)
    few = rng.random(len(x)) < 0.02
    for rows, word in ((np.flatnonzero(~few), "missing"), (np.repeat(np.arange(len(x)), 1 + few), "doubled")):
        (note,) = screened(12, counted(x, rows))
        count = re.search(rf"rows are {word} \(about (\d+) of \d+\) all along", note)
        assert count is not None and int(count[1]) == pytest.approx(np.sum(few), rel=0.15)


@pytest.mark.parametrize(
    ("begins", "ends", "said"),
    [
        (66.0, np.inf, r"lies between t = 6[56](\.\d+)? s and t = 119\.9 s"),
        (0.0, 12.0, r"lies between t = 0 s and t = 1[12](\.\d+)? s"),
    ],
)
def test_a_part_of_another_record_is_said_with_its_times(monkeypatch, begins, ends, said) -> None:
    """Another instrument; an output that is not there yet: of a short part a robust fit sees nothing."""
    leave_out(monkeypatch, "columns")
    x, other = flown(12), replace(drawn(12), instrument=drawn(13).instrument).simulate({}).flight()
    noise = 0.01 * np.std(x.outputs["G_out"]) * np.random.default_rng(1).standard_normal(len(x))
    wrong = other.outputs["G_out"] if begins else noise
    G = np.where((x.time >= begins) & (x.time < ends), wrong, x.outputs["G_out"])
    reasons = screened(12, replace(x, outputs={"G_out": G}))
    assert any(re.search(f"explains the record, but not what {said}", r) for r in reasons)


@pytest.mark.parametrize(
    ("begins", "ends", "change", "said"),
    [
        (66.0, np.inf, lambda n, v: -v if n == "a_x" else v, "66 s and t = 119.94 s a_x has the wrong sign"),
        (0.0, 80.0, lambda n, v: v / G0 if n[:2] == "a_" else v, "0 s and t = 79.938 s a_x, a_y, a_z are in g, not in m/s^2"),
        (50.0, 54.0, lambda n, v: -v if n == "a_y" else v, "50 s and t = 53.938 s a_y has the wrong sign"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_part_of_a_record_is_said_with_its_times(begins, ends, change, said) -> None:
    x = flown(12)
    there = (x.time >= begins) & (x.time < ends)
    (note,) = screened(12, changed(x, lambda n, v: np.where(there, change(n, v), v)))
    assert f"likely mistake: between t = {said}" in note


CUBIC = {"cubic-input": {"K_iii": [2e-2 / 9.8**2, 0.0, 0.0, 0.0]}}
"""By either clock most is left: of the right one a half."""


@pytest.mark.parametrize(("size", "hidden"), [(0.025, {}), (1.0, {}), (0.1, CUBIC)])
def test_a_clock_that_was_set_is_said_with_its_time(monkeypatch, size: float, hidden: dict[str, Any]) -> None:
    """Where rows seem to lack, as after a step of a second, none does."""
    leave_out(monkeypatch, "all")
    x, gap, at = flown(12, hidden), int(16 * size) // 16 * 16, 1440
    rows = np.insert(np.arange(len(x)), at, [at] * gap)
    lacking = np.isin(np.arange(len(rows)), np.arange(at, at + gap))
    wrong = counted(x, rows)
    wrong = replace(
        wrong,
        time=x.time[rows] + size * (x.time[rows] >= 90) if not gap else wrong.time,
        notes=("the time stamps jump: was the clock adjusted?",),
        valid=~lacking & (np.abs(np.arange(len(rows)) - at) > 40 * (gap > 0)),
        outputs={n: np.where(lacking, np.nan, v) for n, v in wrong.outputs.items()},
    )
    flight = screen(MODEL, drawn(12).sheet, wrong)
    reasons = [f.reason for f in flight.flags if "the sample count" in f.reason]
    assert [*flight.notes] == reasons[:1] and f"the time stamps jump by {size:g} s at t = 9" in reasons[0]
    np.testing.assert_allclose(flight.time, x.time, atol=1e-9)


def test_stamps_that_scatter_or_drift_and_are_put_right_are_made_even() -> None:
    x, size = flown(12), 1e-3
    for wrong in (size / x.rate * np.random.default_rng(1).standard_normal(len(x)), -3e-4 * (x.time % 40.0)):
        flight = screen(MODEL, drawn(12).sheet, replace(x, time=x.time + wrong))
        np.testing.assert_allclose(flight.time, x.time, rtol=0, atol=size / x.rate / 10)


def test_samples_that_were_taken_unevenly_keep_their_instants() -> None:
    s = scenario(12, duration=100.0, rate=160.0)
    x = s.simulate().flight()
    k = 10 * np.arange(1, 1590) + np.random.default_rng(1).integers(-1, 2, 1589)
    columns = {n: {c: v[k] for c, v in getattr(x, n).items()} for n in ("channels", "outputs")}
    uneven = replace(x, time=x.time[k], valid=x.valid[k], **columns)
    assert np.array_equal(screen(MODEL, s.sheet, uneven).time, uneven.time)


def test_a_force_beyond_any_flight_is_refused() -> None:
    with pytest.raises(UserError, match="the specific force is larger than any flight's"):
        screen(MODEL, drawn(12).sheet, changed(flown(12), lambda n, v: 1e3 * v if n[:2] == "a_" else v))


def demodulated(s: Scenario, x: Flight) -> Flight:
    """Inline and cross alone."""
    phi, k = 2 * np.pi * 0.25 * x.time, scale_factor(MODEL, make_vector(MODEL, s.sheet)) * 1e9
    channels = {n: np.full(len(x), np.nan) for n in ("inline", "cross")}
    d = demodulate(x.outputs["G_out"], phi, x.rate, k)
    channels["inline"][d.valid], channels["cross"][d.valid] = d.inline, d.cross
    return replace(x, outputs=channels)


def test_channels_that_are_defined_otherwise_are_named(monkeypatch) -> None:
    leave_out(monkeypatch, "timing")
    s = scenario(13, duration=300.0, gradient_rms=20e-9)
    good = demodulated(s, s.simulate().flight())
    assert found_in(good, s.sheet) is None
    o = {"inline": -1.0 * good.outputs["inline"], "cross": 2.0 * good.outputs["cross"]}
    finding = found_in(replace(good, outputs=o), s.sheet)
    assert finding is not None and finding.others == ()
    assert finding.best.what == "inline is -1 times Gamma_xx - Gamma_yy; cross is 2 times Gamma_xy"


def test_outputs_that_are_recorded_more_seldom_than_the_motion() -> None:
    """Channels may be; an output before demodulation must keep up with the disc."""
    s, x = drawn(15), flown(15)
    good = demodulated(s, x)
    seldom = {n: np.where(np.arange(len(x)) % 16 == 0, v, np.nan) for n, v in good.outputs.items()}
    assert screen(MODEL, s.sheet, replace(good, outputs=seldom)).flags == ()
    G = x.outputs["G_out"]
    screen(MODEL, s.sheet, replace(x, outputs={"G_out": np.where(np.arange(len(x)) % 8 == 0, G, np.nan)}))
    with pytest.raises(UserError, match="the output is sampled too slowly for the disc"):
        screen(MODEL, s.sheet, replace(x, outputs={"G_out": G[np.arange(len(x)) // 16 * 16]}))
