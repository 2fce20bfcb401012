"""`ragg export` of an instrument with discs, heights and directions of its own: every output, in C and in NumPy."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.api import Loaded
from ragg_runtime.compensation.export.contents import Contents, unit_of
from ragg_runtime.compensation.export.program import format_csv
from ragg_runtime.compensation.recursive import Online, Tuning
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.model import derive
from ragg_runtime.model.directory import ModelDir
from ragg_runtime.model.evaluate import output, vector
from ragg_runtime.model.record import record
from tests.layouts import sheets
from tests.layouts.flown import flown_by
from tests.layouts.test_layouts_physics import instrument
from tests.runtime.test_export import make_strictly


@cache
def contents() -> Contents:
    """A vertical disc with heights and directions beside one that stands still."""
    i = instrument("odd", sheets.FULL)
    model, files = derive.derived((), (), i.form, i.layout)
    return Contents(
        name="odd", model=model, instrument=i, p=vector(model, i), sources=derive.plain_c(i),
        module=files["chain.py"], origin="values of model.toml",
    )  # fmt: skip


def flown(path: Path, wobble: float = 0.0) -> Flight:
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
    given, derived = re.findall(r"largest difference (\S+) V", make_strictly(folder, "check"))
    assert float(given) == 0.0
    assert float(derived) < 1e-10  # the last bit of some of its 260,000 V
    return folder


def rows(text: bytes) -> tuple[str, np.ndarray]:
    head, *lines = text.decode().splitlines()
    return head, np.array([[float(x) for x in line.split(",")] for line in lines if line[0] != "#"])


def test_every_output_is_what_python_gives(program: Path, tmp_path: Path) -> None:
    """Of one accelerometer 1e-6 Eo are less than a double can tell of its volts: there it is the last bits."""
    x = flown(tmp_path / "flight.csv", wobble=1e-4)
    c = contents()
    text = (tmp_path / "flight.csv").read_bytes()
    head, found = rows(
        subprocess.run([program / "ragg_model"], input=text, capture_output=True, check=True).stdout
    )
    assert head == "time,G_out_A,G_out_B"
    folder = written(tmp_path, api.FORMS["numpy"](c))
    command = [sys.executable, "-I", "-c", f"import sys, runpy; sys.path.insert(0, {str(folder)!r}); "
               f"runpy.run_path({str(folder / 'ragg_model.py')!r}, run_name='__main__')"]  # fmt: skip
    _, again = rows(subprocess.run(command, input=text, capture_output=True, check=True).stdout)
    for k, o in enumerate(c.outputs()):
        r = record(x, c.instrument, k)
        expected = output(c.model.chain, r, c.p, c.instrument.layout.outputs[k])
        limit = max(1e-6 * o.scale_factor, 8 * np.finfo(float).eps * float(np.max(np.abs(expected))))
        assert np.max(np.abs(found[:, 1 + k] - expected)) < limit
        assert np.max(np.abs(again[:, 1 + k] - expected)) < limit
        assert np.std(expected) > 1e6 * limit


def test_the_filter_is_that_of_the_output_that_sees_a_gradient(program: Path, tmp_path: Path) -> None:
    x = flown(tmp_path / "flight.csv")
    c = contents()
    sigma = 4 * c.outputs()[0].scale_factor
    o = observe_flights([x], c.instrument)[0]
    G = np.where(o.record.valid, x.outputs["G_out_A"], np.nan)
    columns = {f"{n} [{unit_of(n)}]": v for n, v in {"time": o.record.time, **o.record.channels}.items()}
    done = subprocess.run(
        [program / "ragg_online", f"{sigma:.17g}", "1", "60"],
        input=format_csv(columns | {"G_out_A [V]": G}).encode(), capture_output=True, check=True,
    )  # fmt: skip
    head, found = rows(done.stdout)
    assert head == "time,inline_A,cross_A,inline_A_std,cross_A_std"
    got = Online(c.model, c.instrument, Tuning(noise=sigma, walk=1.0, forget=60.0), c.p).feed(o)
    assert np.max(np.abs(found[:, 1] - got.inline) / got.inline_std) < 1e-4
    assert np.max(np.abs(found[:, 2] - got.cross) / got.cross_std) < 1e-4
    assert found[:, 3] == pytest.approx(got.inline_std, rel=1e-6)
    m = Loaded(
        ModelDir(path=tmp_path, text="", instrument=c.instrument, generated=None, history=()),
        c.model,
    )
    (series,) = api.compensate(m, [x], "online", noise=2.0, walk=1.0).series
    assert ",".join(series) == f"{head},quality_A"
