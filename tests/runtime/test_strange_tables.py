"""Tables as people have them: strange headers, dates, missing-value codes; DataFrames, Datasets and dicts; `ragg map`."""

from __future__ import annotations

import gzip
import os
import sys
from datetime import UTC, datetime, timedelta
from decimal import Decimal
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pandas as pd
import pytest
import xarray
from scipy.io import savemat

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.io import read_flight, read_flights, tables
from ragg_runtime.io.draft import draft_mapping
from ragg_runtime.io.files import describe_flight, read_recordings
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.io.tables import find_codes
from ragg_runtime.simulate import simulate_flight
from tests.runtime.foreign_files import G0, HEADER, RATE, UNITS, N, write_sheets

VALUES = {n: np.round(np.random.default_rng(k).normal(size=N), 6) for k, n in enumerate(UNITS)}
VALUES["time"] = np.arange(N) / RATE


def rows(times: list[Any] | None = None) -> list[list[Any]]:
    columns = [list(v) for v in VALUES.values()]
    return [list(r) for r in zip(times or columns[0], *columns[1:], strict=True)]


def text(head: str, cells: list[list[Any]], delimiter: str = ",", end: str = "\n", decimal: str = ".") -> str:
    lines = [
        delimiter.join(str(c).replace(".", decimal) if isinstance(c, float) else str(c) for c in r)
        for r in cells
    ]
    return head + end + end.join(lines) + end


def mapped(path: Path) -> Any:
    """As ``ragg map`` describes the file."""
    return parse_mapping(draft_mapping(path).text, path)


def same(flight: Any, instants: bool = False) -> None:
    assert flight.instants == instants
    assert flight.time - flight.time[0] == pytest.approx(VALUES["time"], abs=1e-6)
    assert flight.outputs["G_out"] == pytest.approx(VALUES["G_out"])
    assert flight.channels["a_y"] == pytest.approx(VALUES["a_y"] * G0)


PLAIN, TAIL, REST = ",".join(HEADER), ",".join(HEADER[1:]), ";" + ";".join(HEADER[1:])
CSV = {
    "a comma behind every line": text(PLAIN + ",", [[*r, ""] for r in rows()]),
    "a comma behind every row": text(PLAIN, [[*r, ""] for r in rows()]),
    "lines before the header": "Recorder XR-4;serial 0071\nStart: 2026-03-01 10:00\nVersion,2\n\n" + text(PLAIN, rows()),
    "padded lines before it": "Recorder XR-4" + 7 * "," + "\nStart,2026-03-01" + 6 * "," + "\n" + text(PLAIN, rows()),
    "a line break in the header": text(",".join('"' + h.replace(" ", "\n") + '"' for h in HEADER), rows()),
    "decimal commas": text(";".join(HEADER), rows(), ";", decimal=","),
    "decimal commas, with tabs": text("\t".join(HEADER), rows(), "\t", decimal=","),
    "units in a row of their own": text(",".join(UNITS) + "\n" + ",".join(UNITS.values()), rows()),
    "units in round brackets": text(PLAIN.replace("[", "(").replace("]", ")"), rows()),
    "a header over two rows": text("time [s],a [g],,,omega [deg/h],,,G_out [V]\n,x,y,z,x,y,z,", rows()),
    "bare units in the second of two rows": text("time,a,,,omega,,,G_out\ns,x [g],y [g],z [g],x [deg/h],y [deg/h],z [deg/h],V", rows()),
    "units in the second of two rows": text("time,a,,,omega,,,G_out\n[s],x [g],y [g],z [g],x [deg/h],y [deg/h],z [deg/h],[V]", rows()),
    "units as in ISO 80000": text(",".join(f"{n} / {u}" for n, u in UNITS.items()), rows()),
    "units behind a comma": text(";".join(f"{n}, {u}" for n, u in UNITS.items()), rows(), ";"),
    "bars between columns": text(PLAIN.replace(",", "|"), rows(), "|"),
    "numbers of Fortran": text(PLAIN, [[f"{c:.9E}".replace("E", "D") for c in r] for r in rows()]),
    "the minus of print": text(PLAIN, [[str(c).replace("-", "\u2212") for c in r] for r in rows()]),
    "line ends of a Macintosh": text(PLAIN, rows(), end="\r"),
    "another alphabet": text(PLAIN + ",T [°C]", [[*r, 1.0] for r in rows()]).encode("cp1252"),
    "another alphabet late": text(PLAIN + ",remark", [*([*r, "ruhig"] for r in rows()[:-1]), [*rows()[-1], "böig"]]).encode("cp1252"),
    "UTF-16": text(PLAIN, rows()).encode("utf-16"),
    **{f"{order} without its mark": text(PLAIN, rows()).encode(order) for order in ("utf-16-le", "utf-16-be")},
    "a remark in one row": text(PLAIN + ",remark", [[*r, "1" if k < 50 else "x"] for k, r in enumerate(rows())]),
    "an index that is time": text("," + TAIL, rows([f"0 days 00:00:{t:09.6f}" for t in VALUES["time"]])),
    "remarks among the rows and at the end": text(PLAIN, [*rows()[:9], ["# marker 5"], *rows()[9:], ["end", "of", "record"]]),
    "cut off in its last line": text(PLAIN, [*rows(), [3.75, 0.1]]).rstrip(),
    "joined from two": text(PLAIN, [*rows()[:9], [PLAIN], *rows()[9:]]),
    "thousands": text("time [ms]," + TAIL, rows([f'"{1000 * t:,.1f}"' for t in VALUES["time"]])),
    "points between thousands": text(
        "time [ms]" + REST, rows([f"{1000 * t:,.1f}".translate({44: ".", 46: ","}) for t in VALUES["time"]]), ";", decimal=","
    ),
    "over midnight": text(PLAIN, rows([(86398 + t) % 86400 for t in VALUES["time"]])),
    "blanks, ragged": text("  ".join(HEADER), [[" " * (k % 3) + str(c) for c in r] for k, r in enumerate(rows())], "  "),
    "tabs and blanks, a remark as header": text("# " + " ".join(UNITS) + "\n# " + " ".join(UNITS.values()), rows(), " \t "),
    "a quoted stamp between blanks": text(
        " ".join(["time", *(h.replace(" ", "") for h in HEADER[1:])]), rows([f'"2026-03-01 10:00:{t:07.4f}"' for t in VALUES["time"]]), " "
    ),
    "a stamp of two words between blanks": text(
        "  ".join(["time", *HEADER[1:]]), rows([f"2026-03-01 10:00:{t:07.4f}" for t in VALUES["time"]]), " "
    ),
    "names of two words between blanks": text("  ".join(f"{n}  " for n in HEADER), [[f"{c:9.6f}" for c in r] for r in rows()], " "),
    "units in the cells": text(",".join(UNITS), [[f"{c} {u}" for c, u in zip(r, UNITS.values(), strict=True)] for r in rows()]),
    "units in the cells, as they fit": text(
        ";".join(UNITS),
        [
            [f"{t}s", f"{1000 * x:.3f} mg", f"{y} g" if t % 1 else f"{1000 * y:.3f} mg"]
            + [f"{c} {u}" for c, u in zip(r, [*UNITS.values()][3:], strict=True)]
            for t, x, y, *r in rows()
        ],
        ";",
    ).replace(".", ","),
    "numbers before the header": text("V\t3\nn" + 7 * "\t60" + "\nX0" + 7 * "\t0.0" + "\nnames\tx\n" + "\t".join(HEADER), rows(), "\t"),
    "a row that is called units": text("," + ",".join(UNITS) + "\nUnits," + ",".join(UNITS.values()), [["data", *r] for r in rows()]),
    "units alone below the names": text("time,a,,,omega,,,G_out\n(s),x (g),y (g),z (g),x (deg/h),y (deg/h),z (deg/h),(V)", rows()),
    "units in other brackets": text(PLAIN.replace("[", "{").replace("]", "}"), rows()),
    "blanks between thousands": text("time [ms]" + REST, rows([f"{1000 * t:,.1f}".replace(",", "\u202f") for t in VALUES["time"]]), ";"),
    "commas between thousands below a header": text("time [ms]" + REST, rows([f"{1000 * t + 5000:,.1f}" for t in VALUES["time"]]), ";"),
    "commas between thousands alone": text("time [us]," + TAIL, rows([f'"{1e6 * t + 1e6:,.0f}"' for t in VALUES["time"]])),
    "points between thousands alone": text(
        "time [us]" + REST, rows([f"{1e6 * t + 1e6:,.0f}".replace(",", ".") for t in VALUES["time"]]), ";", decimal=","
    ),
    "room reserved ahead": text(PLAIN, rows()) + 300 * "\0",
    "row numbers in front, as R writes them": text(PLAIN, [[f'"{k + 1}"', *r] for k, r in enumerate(rows())]),
    "row numbers in front": text("," + PLAIN, [[k, *r] for k, r in enumerate(rows())]),
    "units above the names": text(",".join(UNITS.values()) + "\n" + ",".join(UNITS), rows()),
    "columns of pandas in two levels": text(",imu" * 7 + f"\n,{TAIL}\n{HEADER[0]}" + "," * 7, rows()),
    "signs apart": text(PLAIN, [[f"{'-' if c < 0 else '+'} {abs(c)}" for c in r] for r in rows()]),
    "zeros reserved ahead": text(PLAIN, [*rows(), *[[0] * 8] * 20]),
    "milliseconds beside whole seconds": text("time [s],ms," + TAIL, [[int(t), 1000 * (t % 1), *r] for t, *r in rows()]),
    "a line that is named once": text("Line," + PLAIN, [["" if r[0] else "L7", *r] for r in rows()]),
    "a line of Geosoft": text("/ " + " ".join(HEADER).replace(" [", "[") + "\n/ ==== ====\nLine 1010", rows(), " "),
}  # fmt: skip


@pytest.mark.parametrize("kind", CSV)
def test_tables_in_disguise(tmp_path: Path, kind: str) -> None:
    content = CSV[kind]
    (tmp_path / "x.csv").write_bytes(content if isinstance(content, bytes) else content.encode())
    same(read_flight(tmp_path / "x.csv", G0), "stamp" in kind)


def stamps(start: str, form: str) -> list[str]:
    instants = pd.to_datetime(start) + pd.to_timedelta(VALUES["time"], unit="s")
    return [t.strftime(form) for t in instants]


DATES: dict[str, tuple[list[Any], bool]] = {
    "ISO": (stamps("2026-03-01 23:59:58", "%Y-%m-%dT%H:%M:%S.%fZ"), True),
    "slashes, year first": (stamps("2026-03-01 23:59:58", "%Y/%m/%d %H:%M:%S.%f"), True),
    "an underscore between": (stamps("2026-03-01 10:00:00", "%Y-%m-%d_%H:%M:%S.%f"), True),
    "dots": (stamps("2026-03-01 10:00:00", "%d.%m.%Y %H:%M:%S.%f"), True),
    "day first": (stamps("2026-03-13 23:59:58", "%d/%m/%Y %H:%M:%S.%f"), True),
    "month first, in the afternoon": (stamps("2026-03-13 11:59:58", "%m/%d/%y %I:%M:%S.%f %p"), True),
    "month by name": (stamps("2026-03-01 10:00:00", "%d-%b-%Y %H:%M:%S.%f"), True),
    "month by name, first": ([t.replace(",", "") for t in stamps("2026-03-01 10:00:00", "%b %d %Y %H:%M:%S.%f")], True),
    "day of the week": (stamps("2026-03-01 10:00:00", "%a %b %d %H:%M:%S.%f %Y"), True),
    "day of the year": (stamps("2026-03-01 10:00:00", "%Y-%jT%H:%M:%S.%f"), True),
    "day of the year, slashes": (stamps("2026-03-01 10:00:00", "%Y/%j %H:%M:%S.%f"), True),
    "six columns": (stamps("2026-03-01 23:59:58", "%Y,%m,%d,%H,%M,%S.%f"), True),
    "time of the day over midnight": (stamps("2026-03-01 23:59:58", "%H:%M:%S.%f"), True),
    "more than a day": ([f"{23 + k // 32}:{59 - k // 32 * 59:02d}:{k % 32 / 16 + 58 - k // 32 * 58:09.6f}" for k in range(N)], False),
    "without marks": ([t[:-3] for t in stamps("2026-03-01 23:59:58", "%Y%m%d%H%M%S.%f")], True),
    "minutes and seconds": ([f"{int((t + 3598) % 3600) // 60:02d}:{(t + 58) % 60:07.4f}" for t in VALUES["time"]], True),
    "a colon before the milliseconds": ([t[:-3] for t in stamps("2026-03-01 10:00:00", "%Y-%m-%d %H:%M:%S:%f")], True),
    "colons throughout": (stamps("2026-03-01 10:00:00", "%Y:%j:%H:%M:%S.%f"), True),
    "the zone in hours": (stamps("2026-03-01 10:00:00", "%Y-%m-%d %H:%M:%S.%f +01"), True),
    "an underscore between digits": (stamps("2026-03-01 10:00:00", "%Y%m%d_%H%M%S.%f"), True),
    "points in the time of the day": (stamps("2026-03-13 10:00:00", "%d-%b-%y %I.%M.%S.%f %p"), True),
    "hyphens throughout": (stamps("2026-03-01 10:00:00", "%Y-%m-%dT%H-%M-%S.%f"), True),
    "the date behind": (stamps("2026-03-13 10:00:00", "%H:%M:%S.%f %d/%m/%Y"), True),
    "as web servers write it": (stamps("2026-03-13 10:00:00", "%d/%b/%Y:%H:%M:%S.%f +0000"), True),
    "in brackets": (stamps("2026-03-13 10:00:00", "[%Y-%m-%d %H:%M:%S.%f]"), True),
    "a point behind the year": (stamps("2026-03-13 10:00:00", "%d. %m. %Y. %H:%M:%S.%f"), True),
    "the year first, of two digits": (stamps("2026-03-26 23:59:58", "%y/%m/%d %H:%M:%S.%f"), True),
    "days of .NET": ([f"1.00:00:{k / 16:09.6f}" for k in range(N)], False),
    "days of Python": ([f"1 days 0:00:{k / 16:09.6f}" for k in range(N)], False),
    "a leap second": (
        [f"2016-12-31T23:59:{59 + k / 16:07.4f}Z" if k < 32 else f"2017-01-01T00:00:{(k - 32) / 16:07.4f}Z" for k in range(N)],
        True,
    ),
    "the afternoon in Spanish": ([f"{t} p. m." for t in stamps("2026-03-13 10:00:00", "%d/%m/%Y %I:%M:%S.%f")], True),
}  # fmt: skip


@pytest.mark.parametrize("kind", DATES)
def test_dates_as_people_write_them(tmp_path: Path, kind: str) -> None:
    times, instants = DATES[kind]
    head = "Year,Month,Day,Hour,Minute,Second," if "columns" in kind else "time,"
    (tmp_path / "x.csv").write_text(text(head + TAIL, rows(times)))
    same(read_flight(tmp_path / "x.csv", G0), instants)
    draft = draft_mapping(tmp_path / "x.csv")
    assert not draft.questions, draft.text
    if "days" not in kind:
        same(read_flight(tmp_path / "x.csv", G0, mapping=mapped(tmp_path / "x.csv")), instants)


def test_a_second_of_almost_60_is_no_leap_second(tmp_path: Path) -> None:
    """Sums of floats: six columns, a clock in digits; and texts in letters, as NetCDF 3 has them."""
    second = (58 + VALUES["time"]) % 60
    second[32] = 60 - 1e-10
    minute = np.r_[np.zeros(33), np.ones(N - 33)]
    parts = {"year": 2026.0, "month": 3.0, "day": 1.0, "hour": 12.0, "minute": minute, "second": second}
    table = {h: v for h, v in zip(HEADER[1:], [*VALUES.values()][1:], strict=True)}  # noqa: C416
    letters = np.array([[*t] for t in stamps("2026-03-01 10:00:00", "%Y-%m-%dT%H:%M:%S.%f")], "S1")
    for time in ({n: np.broadcast_to(v, N) for n, v in parts.items()}, {"time": letters}):
        same(read_flight(time | table, G0), True)
    columns = "".join(f'{n} = "{n}"\n' for n in UNITS if n != "time")
    mapping = parse_mapping(f'[time]\ncolumn = "t"\nformat = "clock"\n[columns]\n{columns}', tmp_path)
    same(read_flight({"t": 120000 + 100 * minute + second} | table, G0, mapping=mapping), True)


def test_a_date_of_two_meanings_is_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    times = stamps("2026-03-01 10:00:00", "%m/%d/%Y %H:%M:%S.%f")
    path.write_text(text("when," + TAIL, rows(times)))
    draft = draft_mapping(path)
    assert 'format = "?"' in draft.text and "d/m/y" in draft.questions[0]
    march, january = datetime(2026, 3, 1, tzinfo=UTC), datetime(2026, 1, 3, tzinfo=UTC)
    for form, day in (
        ("d/m/y", january),
        ("m/d/y", march),
        ("mm/dd/yyyy", march),
        ("%d/%m/%Y %H:%M:%S.%f", january),
    ):
        (record,) = read_recordings(path, parse_mapping(draft.text.replace('"?"', f'"{form}"'), tmp_path))
        assert record.origin == day
    for old, new, said in (
        ("when", "time", r"day/month or month/day[^$]*03/01/2026[^$]*format"),
        ("10:00:01.0", "10h00m01", r"cannot be read[^$]*line 18: '03/01/2026 10h00m01"),
    ):
        path.write_text(path.read_text().replace(old, new, 1))
        with pytest.raises(UserError, match=said):
            read_flight(path, G0)


def test_excel_as_people_write_it(tmp_path: Path) -> None:
    """Elapsed times over 24 h (dates of 1900 for Excel), times of the day, a header over merged cells, text among numbers."""
    above = ["time", "a [g]", None, None, "omega [deg/h]", None, None, "G_out [V]"]
    merged = [above, [None, *"xyzxyz", None]]
    path, elapsed = tmp_path / "x.xlsx", [timedelta(seconds=float(t)) for t in VALUES["time"]]
    noon, of_1900 = datetime(2026, 3, 1, 23, 59, 58), datetime(1900, 1, 1, 10)
    for times, instants in (
        ([timedelta(hours=23, minutes=59, seconds=58) + t for t in elapsed], False),
        ([(noon + t).time() for t in elapsed], True),
        ([noon + t for t in elapsed], True),
        ([of_1900 + t for t in elapsed], False),
    ):
        write_sheets(path, {"a": [["of a survey"], *merged, *rows(times)]})
        read = read_flight(path, G0)
        assert read.instants == instants
        # openpyxl rounds to milliseconds
        assert read.time - read.time[0] == pytest.approx(VALUES["time"], abs=6e-4)
        assert read.channels["a_y"] == pytest.approx(VALUES["a_y"] * G0)
    cells = [[(noon + t).date(), (noon + t).time(), *r[1:]] for t, r in zip(elapsed, rows(), strict=True)]
    write_sheets(path, {"a": [["Date", "Time", *HEADER[1:]], *cells]})
    flight = read_flight(path, G0, mapping=mapped(path))
    assert np.diff(flight.time) == pytest.approx(1 / RATE, abs=6e-4) and flight.instants


NOISE = 290 + np.random.default_rng(3).normal(size=500)
EVERY = np.arange(500) % 97 == 5
CODES = (
    *(-9999.0, -999.25, 99999.9, float(np.float32(-9999.9)), -1e32),
    *(float(np.float32(-1e32)), 9.969209968386869e36, 0.0, -1.0),
)
SMOOTH = np.sin(np.arange(500) / 30)


@pytest.mark.parametrize(
    ("values", "codes"),
    [
        *((np.where(EVERY, code, NOISE), [code]) for code in CODES),
        (np.where(np.arange(500) == 5, -9999.0, NOISE), [-9999.0]),
        (np.where(EVERY, -9999.0, np.where(np.arange(500) % 89 == 3, -99999.0, NOISE)), [-99999.0, -9999.0]),
        (np.where(EVERY, -9999.0, np.where(np.arange(500) == 3, 4e3, NOISE)), [-9999.0]),
        (np.where(EVERY, -9999.0, 290.0), [-9999.0]),
        (np.where(EVERY, -9999.0, np.arange(500) * 25.0), [-9999.0]),
        (NOISE, []),
        (np.clip(SMOOTH, -0.9, 0.9), []),  # a saturated output
        (np.clip(NOISE, 289, 291), []),
        (np.where(np.arange(500) == 5, 400.0, NOISE), []),  # a spike
        (np.where(np.arange(500) > 480, 1.0, 0.0), []),  # a switch
        (np.mod(np.arange(500) * 0.1, 2 * np.pi), []),  # an angle
        (np.where(np.arange(500) > 250, 270.0, 90.0) + np.round(SMOOTH, 1), []),  # a heading
        (np.linspace(9000.0, 9999.0, 500), []),
    ],
)  # fmt: skip
def test_missing_value_codes(values: np.ndarray, codes: list[float]) -> None:
    assert sorted(find_codes(values)) == sorted(codes)


@pytest.mark.parametrize(
    "name", [f"{n}.mat" for n in ("x", "rows", "cells", "labels", "signals")] + ["x.h5", "x.parquet"]
)
def test_vectors_and_channels_apart(tmp_path: Path, name: str) -> None:
    """A group for each channel; a matrix beside its names, structures, cells of MATLAB; vectors in one column."""
    path = tmp_path / name
    if name == "x.h5":
        with h5py.File(path, "w") as file:
            for n in [*UNITS][1:]:
                file[f"{n}/time"], file[f"{n}/value"] = VALUES["time"], VALUES[n]
                file[f"{n}/time"].attrs["units"], file[f"{n}/value"].attrs["units"] = "s", UNITS[n]
    elif path.suffix == ".mat":
        names, data = np.array(HEADER, object), np.stack([*VALUES.values()], 1)
        whole = {
            "x": {"data": data, "colheaders": names, "textdata": names},
            "rows": [dict(zip(UNITS, r, strict=True)) for r in rows()],
            "cells": np.array([HEADER, *rows()], object),
            "labels": {"imu": data, "imu_label": names},
            "signals": {
                "signals": [{"label": h, "values": v} for h, v in zip(HEADER, VALUES.values(), strict=True)]
            },
        }
        savemat(path, {"data": whole[path.stem], "units": UNITS})
    else:
        a, omega = (np.stack([VALUES[f"{n}_{k}"] for k in "xyz"], 1) for n in ("a", "omega"))
        one = {"time [s]": VALUES["time"], "a [g]": list(a), "omega [deg/h]": list(omega)}
        one["G_out [V]"] = VALUES["G_out"]
        pd.DataFrame(one).to_parquet(path)
    same(read_flight(path, G0))


def test_codes_are_left_out_with_a_note_in_every_column(tmp_path: Path) -> None:
    data = {n: v.copy() for n, v in VALUES.items()}
    data |= {"temperature": NOISE[:N].copy(), "load": np.arange(N) % 7.0}
    for k, n in enumerate((n for n in data if n != "load"), 3):
        data[n][[k, k + 20]] = -9999.0
    data["temperature"][7] = -300.0
    units = {**UNITS, "temperature": "K", "load": "1"}
    table = {f"{n} [{u}]": data[n] for n, u in units.items()}
    flight = read_flight(table, G0)
    assert len(flight) == N
    assert sum("2 values of -9999" in n for n in flight.notes) == 9
    assert "2 rows without a time left out" in flight.notes
    assert np.min(flight.channels["temperature"]) > 280
    assert "temperature: 1 sample not above absolute zero, left out" in flight.notes
    lines = ["null = [-9999]", '[time]\ncolumn = "time"', "[columns]"]
    lines += [f'{n} = {{ column = "{n}", null = [0, "n/a"] }}' for n in units if n != "time"]
    mapped = read_flight(table, G0, mapping=parse_mapping("\n".join(lines), tmp_path))
    assert any("load: left out as missing: 9 values of 0" in n for n in mapped.notes)


def test_flights_in_memory() -> None:
    plain = {h: v for h, v in zip(HEADER, VALUES.values(), strict=True)}  # noqa: C416
    vector = {h: v for h, v in plain.items() if h[:2] != "a_"}
    vector["a [g]"] = np.stack([VALUES[f"a_{k}"] for k in "xyz"], axis=1)
    bare = {n: v for n, v in VALUES.items() if n != "time"}
    named = pd.DataFrame(bare, index=pd.Index(pd.to_timedelta(VALUES["time"], unit="s")))
    named.attrs = {"units": UNITS}
    index = pd.to_datetime(stamps("2026-03-01", "%Y-%m-%dT%H:%M:%S.%f"))
    dated = pd.DataFrame({h: v for h, v in plain.items() if h[0] != "t"}, index)
    two = pd.DataFrame(np.stack([*VALUES.values()], axis=1), columns=pd.MultiIndex.from_tuples(UNITS.items()))
    variables = {n: ("time", v, {"units": UNITS[n]}) for n, v in bare.items()}
    attributes = xarray.Dataset(variables, {"time": index})
    seconds = attributes.assign_coords(time=("time", VALUES["time"], {"units": "s"}))
    seconds["wide"] = ("band", np.arange(3.0))
    seconds["a_y"].attrs["valid_range"] = [-20.0, 20.0]
    seconds["a_y"].encoding["scale_factor"] = 10.0
    for data, instants in (
        (plain, False),
        (pd.DataFrame(plain), False),
        (vector, False),
        (pd.DataFrame(plain).iloc[::1].set_index(HEADER[0]), False),
        (named, False),
        (dated, True),
        (dated.tz_localize("UTC").rename_axis("time"), True),
        (two, False),
        (pd.DataFrame(plain).astype("Float64"), False),
        (pd.DataFrame(plain).map(lambda v: Decimal(repr(v))), False),
        (pd.DataFrame(plain).map(lambda v: repr(v).replace(".", ",")).astype("category"), False),
        (pd.DataFrame(plain).assign(covariance=[np.eye(3)] * N, **{"n [1]": [pd.NA, *range(N - 1)]}), False),
        (pd.DataFrame(plain).assign(line="A").set_index(["line", HEADER[0]]), False),
        (attributes, True),
        (seconds, False),
        ({**VALUES, "attrs": {"units": UNITS}}, False),
        ({n: xarray.DataArray(v, attrs={"units": UNITS[n]}) for n, v in VALUES.items()}, False),
    ):
        (flight,) = read_flights(data, G0, name="x")
        same(flight, instants)
        assert (flight.name, flight.path, len(flight.digest)) == ("x", None, 64)
    masked = np.ma.masked_array(VALUES["a_x"], np.arange(N) == 9)
    flight = read_flight(plain | {HEADER[1]: masked}, G0)
    assert np.flatnonzero(~flight.valid[:-10]).tolist() == [*range(N // 8), 9]
    with pytest.raises(UserError, match="not a flight"):
        read_flight(3.0, G0)


def test_what_is_in_memory_is_compared(tmp_path: Path) -> None:
    m = api.new(tmp_path / "m")
    x = simulate_flight(m.instrument, [], seed=1, duration=60.0, rate=8.0)
    data = {"time [s]": x.time} | {f"{n} [{x.units[n]}]": v for n, v in {**x.channels, **x.outputs}.items()}
    pd.DataFrame(data).to_csv(tmp_path / "x.csv", index=False)
    sources = (data, [pd.DataFrame(data)], str(tmp_path / "x.csv"))
    values = [api.compare(m, f).calibrated.rms_Eo for f in sources]
    assert values[0] == values[1] == pytest.approx(values[2], rel=1e-9)


def test_a_map_is_written_whatever_is_odd(tmp_path: Path) -> None:
    path = tmp_path / "x.h5"
    with h5py.File(path, "w") as file:
        for n, v in VALUES.items():
            file[f"imu/{n}"] = v
            file[f"imu/{n}"].attrs["units"] = UNITS[n]
        file["imu/names"] = np.array([b"a"] * N)
        file["other/time"], file["other/x"] = np.arange(5.0), np.arange(5.0)
    draft = draft_mapping(path)
    assert 'part = "/imu"' in draft.text and "no numbers" in draft.text
    assert "skipped, further tables: /other (time, x)" in read_flight(path, G0).notes
    same(read_flight(path, G0, mapping=mapped(path)))
    path, lines = tmp_path / "x.csv", [1010] * 20 + [1020] * 20 + ["T9010"] * (N - 20 - 20)
    kinds = text("LINE," + PLAIN, [[n, *r] for n, r in zip(lines, rows(), strict=True)])
    path.write_text(kinds + "," * 8 + "\n" + "," + "0," * 7 + "0\n")
    records = read_recordings(path, mapped(path))
    assert [r.line for r in records] == ["1010", "1020", "T9010"]
    assert any("2 rows without the name of a line left out" in n for n in records[0].notes)


def test_a_map_of_names_in_groups_and_with_units(tmp_path: Path) -> None:
    """Channels of TDMS keep the names of their groups; many people write units at the end of a name, and text for numbers."""
    path = tmp_path / "x.parquet"
    names = [f"/'Untitled'/'{n}_{u}'" if u != "deg/h" else f"/'imu'/'{n}_dph'" for n, u in UNITS.items()]
    pd.DataFrame({n: v.astype(str) for n, v in zip(names, VALUES.values(), strict=True)}).to_parquet(path)
    draft = draft_mapping(path)
    assert not draft.questions and not draft.notes, draft
    same(read_flight(path, G0, mapping=mapped(path)))
    path, a = tmp_path / "x.csv", [f"/imu/linear_acceleration/{k}.g" for k in "xyz"]
    names = ["__time.s", *a, *(f"imu.gyroscope.{k} [deg/h]" for k in "xyz"), "G_out.V"]
    path.write_text(text(",".join(names), rows()))
    same(read_flight(path, G0, mapping=mapped(path)))
    path.write_text(text("X_Value,u,v", [[*r[:3]] for r in rows()]))
    draft = draft_mapping(path)
    assert "[time]: unit of 'X_Value'" in draft.questions[0]
    assert "no column is recognised as a_x" in draft.notes[0]


def test_a_file_name_that_is_no_unicode(tmp_path: Path) -> None:
    if sys.platform != "linux":
        pytest.skip("file systems that take any bytes")
    import pyarrow.parquet

    place = Path(os.fsdecode(os.fsencode(tmp_path) + b"/fl\374g"))
    place.with_suffix(".csv").write_text(text(PLAIN, rows()))
    with place.with_suffix(".parquet").open("wb") as stream:
        pyarrow.parquet.write_table(pyarrow.table(dict(zip(HEADER, VALUES.values(), strict=True))), stream)
    for ending in (".csv", ".parquet"):
        same(read_flight(place.with_suffix(ending), G0))
        assert draft_mapping(place.with_suffix(ending)).text


def test_a_table_larger_than_memory_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with h5py.File(tmp_path / "x.h5", "w") as file:
        for n in UNITS:
            file.create_dataset(n, (10**12,), "f8", chunks=(10**6,))
    many = PLAIN.encode() + b"\n" + b"0,0,0,0,0,0,0,0\n" * 200_000
    (tmp_path / "x.txt.gz").write_bytes(gzip.compress(many))
    monkeypatch.setattr(tables, "find_free_memory", lambda: 2e7)
    for ending in (".h5", ".txt.gz"):
        with pytest.raises(UserError, match="too large for the memory"):
            read_flight(tmp_path / f"x{ending}", G0)


def test_what_a_file_holds(tmp_path: Path) -> None:
    kept = [r for k, r in enumerate(rows()) if k not in (20, 21, 40)]
    (tmp_path / "x.csv").write_text(text(PLAIN + ",fuel", [[*r, 1.5] for r in kept]))
    (record,) = describe_flight(tmp_path / "x.csv")["records"]
    assert (record["rows"], record["gap_count"], record["missing"]) == (N - 3, 2, 3)
    assert record["rate_Hz"] == pytest.approx(RATE)
    assert (record["gaps"][0]["from_s"], record["gaps"][0]["samples"]) == (19 / RATE, 2)
    assert record["refused"] is not None and "'fuel'" in record["refused"]
    fuel = {"name": "fuel", "unit": "", "samples": 57, "missing": 0}
    assert record["columns"][-1] == fuel | dict.fromkeys(("minimum", "maximum", "mean"), 1.5)
    (tmp_path / "x.csv").write_text(text(PLAIN, kept))
    (record,) = describe_flight(tmp_path / "x.csv")["records"]
    assert record["refused"] is None and any("2 gaps" in n for n in record["notes"])


def test_a_header_over_two_rows_is_named_where_its_names_are_not_known(tmp_path: Path) -> None:
    rows_above = "time [s],force [g],,,rate [deg/h],,,G_out [V]\n,x,y,z,x,y,z,"
    (tmp_path / "x.csv").write_text(text(rows_above, rows()))
    with pytest.raises(UserError, match=r"columns time, force_x.*G_out; the header spans two rows"):
        read_flight(tmp_path / "x.csv", G0)


def test_cells_that_say_that_nothing_was_measured(tmp_path: Path) -> None:
    cells = rows()
    for k, cell in enumerate(("---", "-----", "?", "****", "1.#QNAN", "n/a"), 20):
        cells[k][2] = cell
    (tmp_path / "x.csv").write_text(text(PLAIN, cells))
    assert "a_y: without a value at 6 samples, not used" in read_flight(tmp_path / "x.csv", G0).notes
