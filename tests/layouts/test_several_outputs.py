"""Instruments of several outputs: tensor and noise against what was simulated, `ragg compensate` and `ragg export` of every output."""

from __future__ import annotations

import dataclasses
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from derive import pipeline
from derive.effects import catalogue
from ragg_runtime import api
from ragg_runtime.api import Loaded
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.compensate import (
    Kind,
    OutputChannel,
    PreparedFlights,
    make_columns,
    prepare,
)
from ragg_runtime.compensation.export import Contents
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification import comparison
from ragg_runtime.identification.strong import Stage
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.model import derive
from ragg_runtime.model.directory import ModelDir
from ragg_runtime.model.model import evaluate_output, load_files, make_vector
from ragg_runtime.model.record import record
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.signals.demodulators import COMPONENTS, Demodulator, solve_tensor
from tests.layouts import sheets
from tests.layouts.sheets import flown_by
from tests.layouts.test_layouts_physics import instrument
from tests.runtime.test_export import make_strictly
from tests.simulated import RATE


def test_two_discs_are_refused() -> None:
    axes = [(np.eye(3)[0], np.eye(3)[1]), (np.eye(3)[1], np.eye(3)[2])]
    with pytest.raises(UserError, match="do not determine"):
        solve_tensor(axes, np.zeros((4, 1)), np.ones(4))


DURATION = 600.0


@cache
def flight_of(which: str) -> tuple[Instrument, Flight]:
    """A flight by the reference over a gradient that varies; the sheet knows the instrument to a third of its errors."""
    sheet = instrument(which, sheets.FULL)
    return sheet, flown_by(sheet, DURATION)


def compared(which: str) -> comparison.Together:
    sheet, flight = flight_of(which)
    model = derive.load_model(sheet, candidates=False)
    (together,) = comparison.compare_outputs(fit(model, sheet, observe_flights([flight], sheet)))
    return together


def test_three_discs_see_the_tensor_and_close() -> None:
    together = compared("umbrella")
    t, (_, flight) = together.tensor, flight_of("umbrella")
    assert t is not None
    true = np.stack([flight.channels[f"Gamma_{c}"] for c in COMPONENTS])
    off = (t.gamma - true[:, np.searchsorted(flight.time, together.time)] / 1e-9) / t.std[:, None]
    assert np.sqrt(np.mean(off**2)) < 1.5  # the calibration takes its own share
    assert 0.7 < t.quality < 1.4
    assert not together.differences()


def test_complements_tell_their_noise() -> None:
    together = compared("complements")
    assert together.tensor is None
    (difference,) = together.differences()
    assert difference["outputs"] == ["G_out_A", "G_out_B"]
    for channel, usual in (("inline", 2.0), ("cross", 1.0)):  # 2 Eo/sqrt(Hz) of the cross channel
        noise = float(str(difference[f"{channel}_Eo"]))
        assert noise == pytest.approx(usual * 2.0 * np.sqrt(0.2), rel=0.25)
        assert noise == pytest.approx(float(str(difference[f"expected_{channel}_Eo"])), rel=0.25)


AT = 71.3


@pytest.mark.parametrize("hidden", [False, True])
def test_a_step_is_found_in_several_outputs(hidden: bool) -> None:
    sheet = parse_instrument(sheets.sheet(sheets.complements(), 8, sheets.FULL))
    candidates = tuple(e for e in catalogue() if e.id in ("bias-step", "gain-step"))
    model = load_files(pipeline.derive_model((), candidates, derive.make_symbolic_form(sheet)), sheet.layout)
    size = [0, 0, 2e-8, 0, 0, 0, 0, 0]
    effects: EffectValues = {"gain-step": {"dK1": size, "t_step": AT}} if hidden else {}
    stage = Stage.of(fit(model, sheet, observe_flights([flown_by(sheet, 120.0, effects)], sheet)))
    assert [*stage.chosen] == [*effects]
    if hidden:
        assert stage.instants["gain-step"] == pytest.approx(AT, abs=0.25)  # of some tens of sigma
        columns = stage.problem.candidates["gain-step"]
        found, covariance = stage.fitted.coefficients([n for n, _ in columns])
        scales, last = np.array([c.scale for _, c in columns]), slice(-len(columns), None)
        off = size - found[last] * scales
        spread = scales[:, None] * covariance[last, last] * scales
        assert off @ np.linalg.solve(spread, off) < 30.0  # chi-square of at most eight


@cache
def compensated(
    which: str, kind: Kind
) -> tuple[PreparedFlights, tuple[OutputChannel, ...], dict[str, NDArray[Any]]]:
    sheet, flight = flight_of(which)
    model = derive.load_model(sheet, candidates=False)
    p = prepare(model, sheet, [flight], kind)
    (channels,) = p.channels
    return p, channels, make_columns(sheet, channels, [c.compensate() for c in channels])


def low_passed(d: Demodulator, x: NDArray[np.float64]) -> NDArray[np.float64]:
    return d.low_pass(x.astype(np.complex128)).real


def true_tensor(flight: Flight) -> NDArray[np.float64]:
    """(3, 3, N) Eo."""
    six = {c: flight.channels[f"Gamma_{c}"] / 1e-9 for c in COMPONENTS}
    return np.array([[six["".join(sorted((i, k)))] for k in "xyz"] for i in "xyz"])


def require_sure(scores: Sequence[NDArray[np.float64]]) -> None:
    """Errors over their stated standard deviations, one every two seconds: some 1,100 values, half of them independent."""
    z = np.concatenate([x[:: int(2 * RATE)] for x in scores])
    assert 0.6 < np.mean(np.abs(z) < 1.0) < 0.76
    assert 0.91 < np.mean(np.abs(z) < 1.96) < 0.98


@pytest.mark.parametrize(("which", "kind"), [("umbrella", "self"), ("complements", "crossed")])
def test_channels_of_every_output_are_as_sure_as_they_say(which: str, kind: Kind) -> None:
    """Against the gradient that was flown over, by axes that are computed here."""
    sheet, flight = flight_of(which)
    p, channels, found = compensated(which, kind)
    assert p.calibration.converged
    G = true_tensor(flight)
    scores = []
    for x in channels:
        disc = sheet.layout.discs[x.observation.output.disc]
        end = f"_{disc.name}"
        first = np.array(disc.zero)
        second = np.cross(disc.axis, first)
        inline = np.einsum("i,ijn,j->n", first, G, first) - np.einsum("i,ijn,j->n", second, G, second)
        cross = np.einsum("i,ijn,j->n", first, G, second)
        good = found[f"quality{end}"] == 0
        assert np.mean(good) > 0.9
        for name, true in (("inline", inline), ("cross", cross)):
            z = (found[f"{name}{end}"] - low_passed(x.demodulator, true)) / found[f"{name}{end}_std"]
            scores.append(z[good])
    require_sure(scores)


def test_three_discs_give_the_tensor() -> None:
    _, flight = flight_of("umbrella")
    _, channels, found = compensated("umbrella", "self")
    assert {f"Gamma_{c}{end}" for c in COMPONENTS for end in ("", "_std")} <= {*found}
    G = true_tensor(flight)
    good = np.isfinite(found["Gamma_xx"])
    scores = []
    for c in COMPONENTS:
        true = low_passed(channels[0].demodulator, G["xyz".index(c[0]), "xyz".index(c[1])])
        scores.append(((found[f"Gamma_{c}"] - true) / found[f"Gamma_{c}_std"])[good])
    require_sure(scores)
    trace = found["Gamma_xx"] + found["Gamma_yy"] + found["Gamma_zz"]
    assert np.nanmax(np.abs(trace)) < 1e-6
    assert 0.7 < np.std(found["closure"][good]) < 1.4


def test_two_complements_give_no_tensor() -> None:
    names = ("inline", "cross", "inline_{}_std", "cross_{}_std", "quality")
    expected = [n.format(disc) if "{" in n else f"{n}_{disc}" for disc in "AB" for n in names]
    assert list(compensated("complements", "crossed")[2]) == expected


def test_a_disc_that_stands_still_is_left_out_and_alone_refused() -> None:
    p, _, found = compensated("odd", "self")
    assert len(p.channels[0]) == 1
    assert [n for n in found if n.startswith("inline")] == ["inline_A", "inline_A_std"]
    still = parse_instrument(
        sheets.sheet([sheets.disc("B", [sheets.accelerometer("B1", 0.0, 1)], spin=0.0)], 1)
    )
    model = derive.load_model(still, candidates=False)
    _, flight = flight_of("odd")
    outputs = {"G_out": flight.outputs["G_out_B"]}
    with pytest.raises(UserError, match="no output of a spinning disc"):
        prepare(model, still, [dataclasses.replace(flight, outputs=outputs)], "self")


@cache
def contents() -> Contents:
    """A vertical disc with heights and directions beside one that stands still."""
    i = instrument("odd", sheets.FULL)
    model = derive.load_model(i, candidates=False)
    return Contents(
        name="odd", model=model, instrument=i, p=make_vector(model, i), sources=derive.derive_plain_c(i),
        module=derive.read_chain(i), origin="values of model.toml",
    )  # fmt: skip


def flown_file(path: Path, wobble: float = 0.0) -> Flight:
    """A flight file with an encoder and without angular acceleration."""
    i = contents().instrument
    x = flown_by(i, 60.0)
    columns = {n: v for n, v in x.channels.items() if not n.startswith(("omegadot", "Gamma"))}
    columns["spin_angle_A"] = np.mod(2 * np.pi * 0.3 * x.time + wobble * np.sin(x.time), 2 * np.pi)
    write_flight(Flight(time=x.time, channels=columns, outputs=x.outputs), path)
    return read_flight(path, i.g0, accelerometers=i.layout)


def written(folder: Path, files: Mapping[str, str]) -> Path:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = written(tmp_path_factory.mktemp("odd"), api.FORMS["c"](contents()))
    recorded, derived = re.findall(r"largest difference (\S+) V", make_strictly(folder, "check"))
    assert float(recorded) == 0.0
    assert float(derived) < 1e-10  # the last bit of some of its 260,000 V
    return folder


def rows(text: bytes) -> tuple[str, np.ndarray]:
    head, *lines = text.decode().splitlines()
    return head, np.array([[float(x) for x in line.split(",")] for line in lines if line[0] != "#"])


def test_every_output_is_what_python_gives(program: Path, tmp_path: Path) -> None:
    """Of one accelerometer 1e-6 Eo are less than a double can tell of its volts: there it is the last bits."""
    x = flown_file(tmp_path / "flight.csv", wobble=1e-4)
    c = contents()
    text = (tmp_path / "flight.csv").read_bytes()
    head, found = rows(
        subprocess.run([program / "ragg_model"], input=text, capture_output=True, check=True).stdout
    )
    assert head == "time,G_out_A,G_out_B"
    folder = written(tmp_path, api.FORMS["numpy"](c))
    command = [sys.executable, "-I", "-c", f"import sys, runpy; sys.path.insert(0, {str(folder)!r}); "
               f"runpy.run_path({str(folder / 'ragg_model.py')!r}, run_name='__main__')"]  # fmt: skip
    example = (folder / "test" / "motion.csv").read_bytes()  # without an encoder
    _, again = rows(subprocess.run(command, input=example, capture_output=True, check=True).stdout)
    answers = rows(example)[1][:, -2:]
    for k, o in enumerate(c.outputs()):
        r = record(x, c.instrument, k)
        expected = evaluate_output(c.model.chain, r, c.p, c.instrument.layout.outputs[k])
        limit = max(
            1e-6 * o["scale_factor"]["value"], 8 * np.finfo(float).eps * float(np.max(np.abs(expected)))
        )
        assert np.max(np.abs(found[:, 1 + k] - expected)) < limit
        assert np.max(np.abs(again[:, 1 + k] - answers[:, k])) < limit
        assert np.std(expected) > 1e6 * limit


def test_the_filter_is_that_of_the_output_that_sees_a_gradient(tmp_path: Path) -> None:
    x, c = flown_file(tmp_path / "flight.csv"), contents()
    m = Loaded(ModelDir(path=tmp_path, text="", instrument=c.instrument, generated=None, history=()), c.model)
    (series,) = api.compensate(m, [x], "online", noise=2.0, walk=1.0).series
    assert list(series) == ["time", "inline_A", "cross_A", "inline_A_std", "cross_A_std", "quality_A"]
