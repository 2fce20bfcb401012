"""An HDF5 file that has its numbers in another file is refused before anything there is touched."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import hdf5_self_contained, hdf5_trial, read_flight, write_flight
from ragg_runtime.flight.glance import glance
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

G0 = 9.8
ENDLESS = Path(__file__).parents[1] / "fixtures" / "endless.nc"


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("whole")
    m = loop.new(folder / "model")
    write_flight(simulated(m.instrument, [], seed=1, duration=90.0, rate=16.0), folder / "f.nc")
    return folder / "f.nc"


def copy(whole: Path, to: Path, change: Callable[[h5py.File], object]) -> Path:
    to.write_bytes(whole.read_bytes())
    with h5py.File(to, "r+") as file:
        change(file)
    return to


def external(file: h5py.File, other: str, name: str = "a_x") -> None:
    """``name`` with its numbers in another file, raw."""
    length, units = len(file[name]), file[name].attrs["units"]
    del file[name]
    made = file.create_dataset(name, (length,), dtype="f8", external=[(other, 0, 8 * length)])
    made.attrs["units"] = units
    made.dims[0].attach_scale(file["time"])


def virtual(file: h5py.File, other: str, name: str = "a_x", unlimited: bool = False) -> None:
    length, units = len(file[name]), file[name].attrs["units"]
    del file[name]
    if unlimited:  # whose size alone is asked of the other files
        layout = h5py.VirtualLayout((1,), dtype="f8", maxshape=(None,))
        source = h5py.VirtualSource(other, "x", (1,), dtype="f8", maxshape=(None,))
        layout[0 : h5py.h5s.UNLIMITED : 1] = source[0 : h5py.h5s.UNLIMITED : 1]
    else:
        layout = h5py.VirtualLayout((length,), dtype="f8")
        layout[:] = h5py.VirtualSource(other, "x", (length,))
    made = file.create_virtual_dataset(name, layout)
    made.attrs["units"] = units


def linked(file: h5py.File, other: str, name: str = "a_x") -> None:
    del file[name]
    file[name] = h5py.ExternalLink(other, "/x")


@pytest.mark.parametrize("target", ["file", "pipe", "nothing"])
@pytest.mark.parametrize("make", [external, virtual, linked])
def test_what_stands_in_another_file(
    whole: Path, tmp_path: Path, target: str, make: Callable[[h5py.File, str], None]
) -> None:
    other = tmp_path / "secret.bin"
    if target == "file" and make is external:
        other.write_bytes(np.arange(5000.0).tobytes())
    elif target == "file":
        with h5py.File(other, "w") as file:
            file["x"] = np.arange(5000.0)
    path = copy(whole, tmp_path / "f.nc", lambda f: make(f, str(other)))
    if target == "pipe":
        if sys.platform == "win32":
            pytest.skip("there are no such pipes")
        os.mkfifo(other)
    with pytest.raises(UserError, match="does not hold its numbers itself") as caught:
        read_flight(path, G0)
    assert "a_x" in caught.value.message


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such pipes")
def test_a_virtual_dataset_whose_size_stands_elsewhere(whole: Path, tmp_path: Path) -> None:
    path = copy(whole, tmp_path / "f.nc", lambda f: virtual(f, str(tmp_path / "pipe"), unlimited=True))
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(UserError, match="does not hold its numbers itself"):
        read_flight(path, G0)


def test_in_a_group_of_a_group(whole: Path, tmp_path: Path) -> None:
    def change(file: h5py.File) -> None:
        file.create_group("a/b")["c"] = h5py.ExternalLink("/etc/passwd", "/x")
        file["a/b/up"] = file["/"]  # round in a circle
        file["a/b/soft"] = h5py.SoftLink("/a/b/c")

    path = copy(whole, tmp_path / "f.nc", change)
    with pytest.raises(UserError, match=r"/a/b/(up/a/b/)?c is a link to another file"):
        read_flight(path, G0)


def test_too_many_objects_to_look_through(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert hdf5_self_contained.leads_elsewhere(whole) is None
    monkeypatch.setattr(hdf5_self_contained, "MOST", 5)
    with pytest.raises(UserError, match="more than 5 objects"):
        read_flight(whole, G0)


def test_a_whole_file_with_groups_and_links_is_read(whole: Path, tmp_path: Path) -> None:
    def change(file: h5py.File) -> None:
        file.create_group("notes")["again"] = file["a_x"]

    path = copy(whole, tmp_path / "f.nc", change)
    assert np.array_equal(read_flight(path, G0).channels["a_x"], read_flight(whole, G0).channels["a_x"])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="tried in a child")
def test_tables_that_lead_in_circles_are_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, whole: Path
) -> None:
    """A file that fuzzing found: the HDF5 library never comes back from the dimensions of one of its columns."""
    monkeypatch.setattr(hdf5_trial, "PATIENCE", 1.0)
    with pytest.raises(UserError, match="cannot be read to their end"):
        read_flight(ENDLESS, G0)
    assert glance(ENDLESS, G0) is None
    read_flight(whole, G0)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="tried in a child")
def test_a_library_that_crashes_takes_nobody_along(monkeypatch: pytest.MonkeyPatch, whole: Path) -> None:
    monkeypatch.setattr(hdf5_trial, "_visit", lambda *_: os.kill(os.getpid(), signal.SIGKILL))
    with pytest.raises(UserError, match="cannot be read to their end"):
        read_flight(whole, G0)


def test_a_first_look_reads_no_other_file_either(tmp_path: Path, whole: Path) -> None:
    np.arange(10_000.0).tofile(tmp_path / "other")
    path = copy(whole, tmp_path / "x.nc", lambda f: external(f, str(tmp_path / "other"), "G_out"))
    assert glance(whole, G0) is not None
    assert glance(path, G0) is None
