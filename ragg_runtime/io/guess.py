"""A first ``mapping.toml`` from what a file says: names and units. What it does not say is marked, not guessed.

Every line carries how sure it is: *certain* (the contract's own name), *likely* or *guess*. Units come from the file
alone.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.names import LONGEST, is_column
from ragg_runtime.instrument.units import units
from ragg_runtime.io.formats import open_file
from ragg_runtime.io.instants import GPS_EPOCH, is_clock, way_of
from ragg_runtime.io.mapping import UNKNOWN
from ragg_runtime.io.record import DEMODULATED, SI_UNITS, is_demodulated
from ragg_runtime.io.source import Heading, Look, Table, is_unit

_LOOKED_AT = 20_000  # rows whose numbers are looked at for remarks
_DATED = (datetime(1995, 1, 1, tzinfo=UTC), datetime(2045, 1, 1, tzinfo=UTC))
_EPOCHS = ((GPS_EPOCH, "GPS time"), (datetime(1970, 1, 1, tzinfo=UTC), "Unix time"))

NEAR_G = 0.1
"""Relative distance from gravity, on the median, within which a vertical channel's unit is guessed: less than platforms feel on average."""


@dataclass(frozen=True)
class Draft:
    """A mapping to begin with: its ``text``, the ``questions`` to be answered, the columns that are ``unused``, and
    channel -> ``certain``, ``likely`` or ``guess``.
    """

    text: str
    questions: tuple[str, ...]
    unused: tuple[str, ...]
    sure: Mapping[str, str]


def draft(path: Path) -> Draft:
    """Look at a file's first table and write a mapping for it."""
    tables = open_file(path, Look(text=True))
    table = tables[0]
    values = sample(table)
    lines: list[str] = [
        f"# How ragg reads {path.name}: written by `ragg map`, to be looked over.",
        '# certain: the name is ragg\'s own; likely: usual for it; guess: look twice. "?" waits for an answer.',
        "",
    ]
    questions: list[str] = []
    used: set[str] = set()
    sure: dict[str, str] = {}
    lines += _file(table, tables, used)
    lines += _time(table, values, used, questions)
    lines += _columns(table, values, used, questions, sure)
    unused = [h for h in table.headings if h.name not in used]
    if unused:
        lines += ["", "# Not used (any column can be kept as an auxiliary channel under a name of its own):"]
        lines += [f"# {_key(h.name)} = {_entry(h.name, h.unit or UNKNOWN)}" for h in unused if not h.text]
    if any(is_demodulated(r.name) for h in table.headings if (r := role_of(h.name)) is not None):
        lines += [
            "",
            "# How inline and cross were made, if it is known:",
            "# [demodulator]",
            '# kind = "butterworth"',
            '# cutoff = "0.18 Hz"',
            "# order = 6",
        ]
    return Draft(
        text="\n".join(lines) + "\n",
        questions=tuple(questions),
        unused=tuple(h.name for h in unused),
        sure=MappingProxyType(sure),
    )


def _file(table: Table, tables: Sequence[Table], used: set[str]) -> list[str]:
    if len(tables) > 1 or table.line is not None:
        names = [str(t.line) for t in tables]
        shown = ", ".join(f'"{_quoted(n)}"' for n in names[:6]) + (", ..." if len(names) > 6 else "")
        return [
            f"# {len(tables)} lines, told apart by the file itself; [file] lines = [...] picks some: {shown}",
            "",
        ]
    role = ROLES["line"]
    name = next((h.name for h in table.headings if role.fits(h.name)), None)
    if name is None:
        return []
    used.add(name)
    return [
        "[file]",
        f'line = "{_quoted(name)}"  # likely: tells flight lines apart; take it out if it does not',
        "",
    ]


def _time(
    table: Table, values: Mapping[str, NDArray[Any]], used: set[str], questions: list[str]
) -> list[str]:
    found = _instants(table, values)
    if found is not None:
        names, form, sure = found
        used.update(names)
        shown = f'"{_quoted(names[0])}"' if len(names) == 1 else str(list(names)).replace("'", '"')
        return ["[time]", f"column = {shown}  # {sure}", f'format = "{form}"', ""]
    fits = [h for h in table.headings if not h.text and ROLES["time"].fits(h.name)]
    if not fits:
        questions.append("[time] column: which column is time?")
        return [
            "[time]",
            f'column = "{UNKNOWN}"  # no column has a name that is usual for time',
            f'unit = "{UNKNOWN}"',
            "",
        ]
    h = min(fits, key=lambda h: (h.name != "time", not h.unit))
    used.add(h.name)
    sure = "certain" if h.name == "time" else "likely"
    lines = ["[time]", f'column = "{_quoted(h.name)}"  # {sure}']
    unit, remark = _unit(h, "time", values[h.name], questions, "[time]")
    lines.append(f'unit = "{unit}"{remark}')
    return [*lines, *_origin(values[h.name]), ""]


def _instants(table: Table, values: Mapping[str, NDArray[Any]]) -> tuple[tuple[str, ...], str, str] | None:
    """Columns that hold instants as such, their format, and how sure that is."""
    by_role = {
        r: h
        for h in reversed(table.headings)
        for r in ("week", "second_of_week", "date", "clock")
        if ROLES[r].fits(h.name)
    }
    if "week" in by_role and "second_of_week" in by_role:
        return (
            (by_role["week"].name, by_role["second_of_week"].name),
            "gps",
            "likely: GPS week and seconds in it",
        )
    for h in table.headings:
        if h.text and not h.name.startswith("//") and (way := way_of(values[h.name])) is not None:
            text = next((str(t) for t in values[h.name] if str(t)), "")
            if way.dated and (":" in text or values[h.name].dtype.kind == "M"):
                return (h.name,), "iso", "certain: a date and a time in every row"
    if "date" in by_role and "clock" in by_role:
        return (
            (by_role["date"].name, by_role["clock"].name),
            "date clock",
            "likely: a date and a time of the day",
        )
    for h in table.headings:
        if h.text and len(values[h.name]) and is_clock(str(values[h.name][0])):
            return (h.name,), "clock", "certain: a time of the day in every row"
    return None


def _columns(
    table: Table,
    values: Mapping[str, NDArray[Any]],
    used: set[str],
    questions: list[str],
    sure: dict[str, str],
) -> list[str]:
    lines = ["[columns]"]
    taken: dict[str, str] = {}
    candidates = [
        (h, r) for h in table.headings if not h.text and h.name not in used and (r := role_of(h.name))
    ]
    # The surest name wins a channel: certain before likely before guess, then the order of the file.
    for h, role in sorted(candidates, key=lambda c: c[1].rank):
        if role.name in taken or role.name in ("time", "line", "week", "second_of_week", "date", "clock"):
            continue
        taken[role.name] = h.name
        used.add(h.name)
    order = [*SI_UNITS, *dict.fromkeys(r.name for _, r in candidates)]
    by_name = {h.name: h for h in table.headings}
    roles = {r.name: r for _, r in reversed(candidates)}
    for name in dict.fromkeys(n for n in order if n in taken):
        h = by_name[taken[name]]
        role = role_of(h.name) or roles[name]
        unit, remark = (
            (role.unit, "") if role.unit else _unit(h, name, values[h.name], questions, f"[columns] {name}")
        )
        sure[name] = role.sure
        scale = f", scale = {role.scale:g}" if role.scale != 1.0 else ""
        comment = f"  # {role.sure}" + (f": {role.why}" if role.why else "") + remark.replace("  # ", "; ", 1)
        lines.append(f'{_key(name)} = {{ column = "{_quoted(h.name)}", unit = "{unit}"{scale} }}{comment}')
    return lines


def _unit(h: Heading, name: str, values: NDArray[Any], questions: list[str], where: str) -> tuple[str, str]:
    """The unit to write and a remark; a question where the file gives none or one that cannot be."""
    stem = re.sub(r"_[^_]+$", "", name)
    si = SI_UNITS.get(name) or (SI_UNITS.get(stem) if stem in DEMODULATED else None)
    if h.unit and is_unit(h.unit):
        if si is None or units(9.8).fits(h.unit, si):
            return h.unit, ""
        questions.append(f"{where}: the file says {h.unit!r}, which is no unit of it")
        return UNKNOWN, f"  # the file says {_quoted(h.unit)}, which is no unit of {name}"
    said = f"the file says {h.unit!r}, which is no unit that is known" if h.unit else "the file gives none"
    looks = _looks(name, values)
    questions.append(f"{where}: unit of {h.name!r} ({said}{'; ' + looks if looks else ''})")
    return UNKNOWN, f"  # {_quoted(said)}" + (f"; {looks}" if looks else "")


def _looks(name: str, values: NDArray[Any]) -> str:
    """What the numbers remind of, as a remark beside a question; never an answer."""
    v = values[np.isfinite(values)] if values.dtype.kind == "f" else np.empty(0)
    if not len(v):
        return "no number to look at"
    size = float(np.median(np.abs(v)))
    if name == "a_z":
        for unit, g in (("g", 1.0), ("m/s^2", 9.8), ("Gal", 980.0), ("mGal", 9.8e5)):
            if abs(size / g - 1.0) < NEAR_G:
                return f"the median is {size:.4g}, as gravity in {unit}"
    if name == "time" and len(v) > 1:
        return f"steps of {float(np.median(np.diff(v))):.6g}"
    return f"from {v.min():.6g} to {v.max():.6g}"


def _origin(values: NDArray[Any]) -> list[str]:
    """Remarks on when the record may have begun, if its seconds count from a usual epoch."""
    first = float(values[0]) if len(values) and np.isfinite(values[0]) else 0.0
    found = []
    for epoch, what in _EPOCHS:
        if 0.0 < first < 3e9 and _DATED[0] < (begun := epoch + timedelta(seconds=first)) < _DATED[1]:
            begins = begun.isoformat(timespec="seconds").replace("+00:00", "Z")
            origin = epoch.isoformat().replace("+00:00", "Z")
            found.append(f"# origin = {origin}  # guess: as {what} in seconds the record begins {begins}")
    return found


def sample(table: Table) -> dict[str, NDArray[Any]]:
    """The first rows of every column."""
    return {n: v[:_LOOKED_AT] for n, v in table.rows().items()}


def _entry(column: str, unit: str) -> str:
    return f'{{ column = "{_quoted(column)}", unit = "{_quoted(unit)}" }}'


def _key(name: str) -> str:
    """A channel's name: the column's own, or one made of its letters."""
    return name if is_column(name) else ("c_" + re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_"))[:LONGEST]


def _quoted(text: str) -> str:
    """Text inside a TOML string or comment: no quotes, no lines, nothing that cannot be printed."""
    text = text.replace("\\", "\\\\").replace('"', '\\"')
    return "".join(c if c.isprintable() else f"\\u{min(ord(c), 0xFFFF):04x}" for c in text)


_RANKS = ("certain", "likely", "guess")


@dataclass(frozen=True)
class Role:
    """A channel that a column may be.

    ``pattern`` must match the column's whole name, in small letters, divided by ``_``. ``sure``: ``likely`` or
    ``guess``. ``scale``: between column and channel, where the name tells it. ``unit``: the only one that it can have.
    """

    name: str
    pattern: str
    sure: str = "likely"
    scale: float = 1.0
    why: str = ""
    unit: str = ""

    def fits(self, column: str) -> bool:
        return column == self.name or re.fullmatch(self.pattern, plain(column)) is not None

    @property
    def rank(self) -> int:
        return _RANKS.index(self.sure)


def plain(column: str) -> str:
    """A column's name in small letters, its words divided by ``_``."""
    words = re.sub(r"([a-z])([A-Z][a-z])", r"\1_\2", column)
    return re.sub(r"[\W_]+", "_", words).strip("_").casefold()


def _roles() -> tuple[Role, ...]:
    found = [
        Role("time", r"t|time|(gps|utc|unix|imu|rec)_?(time|sec(onds?)?)|time_?(s|sec|gps|utc|1980|day)|sec(onds?)?|f_?time|fid(ucial)?"),
        Role("line", r"line|line_?(no|num|number|id)|(flight_?)?line"),
        Role("week", r"(gps_?)?w(ee)?k(_?no|_?number)?"),
        Role("second_of_week", r"(gps_?)?(sow|tow|sec(onds?)?_?(of|in)_?week|week_?sec(onds?)?|seconds_of_gps_week)|gps_?seconds?"),
        Role("date", r"date|y{2,4}m{2}d{2}|utc_?date|gps_?date"),
        Role("clock", r"hhmmss(_?s+)?|utc|clock|time_?of_?day|utc_?time"),
    ]  # fmt: skip
    for n, axis in enumerate("xyz", 1):
        found += [
            Role(
                f"a_{axis}",
                rf"(a|acc|accel(eration)?|f|sf|specific_force)_?{axis}|{axis}_?(acc|accel(eration)?)",
            ),
            Role(
                f"omega_{axis}",
                rf"(w|omega|gyro?|(ang(ular)?_?)?rate)_?{axis}|{axis}_?(gyro?|(ang(ular)?_?)?rate)",
            ),
            Role(f"omegadot_{axis}", rf"(omega_?dot|alpha|ang(ular)?_?acc(el(eration)?)?)_?{axis}"),
            Role(f"B_{axis}", rf"(b|mag|field)_?{axis}", "guess"),
            Role(
                f"a_{axis}", rf"(acc|accel(eration)?)_?{n}", "guess", why="a number in the place of an axis"
            ),
            Role(
                f"omega_{axis}",
                rf"(gyro?|rate)_?{n}|{'pqr'[n - 1]}",
                "guess",
                why="roll, pitch and yaw rate?",
            ),
        ]
    for pair in ("xx", "xy", "xz", "yy", "yz", "zz"):
        either = f"({pair}|{pair[::-1]})"
        found.append(Role(f"Gamma_{pair}", rf"(gamma|gradient|gg)_?{either}"))
        found.append(
            Role(
                f"Gamma_{pair}",
                rf"[tg]_?{either}",
                "guess",
                why="of which frame, and is it known beforehand?",
            )
        )
    return (*found, *_outputs(), *_auxiliaries())


def _outputs() -> list[Role]:
    half = "of a disc the inline output is usually (Gamma_xx - Gamma_yy)/2, inline is twice that"
    found = [
        Role("G_out", r"g_?out|sum_?(volt(age)?)?|ggi(_?(out|sum))?"),
        Role(name="inline", pattern=r"in_?line(_?raw)?", sure="likely", scale=2.0, why=half),
        Role("cross", r"cross(_?raw)?"),
    ]
    found += [Role(f"V_{k}", rf"v_?{k}|volt(age)?_?{k}|acc(el)?_?{k}_?v(olt(age)?)?") for k in range(1, 5)]
    for disc in ("1", "2", "3", "4", "a", "b", "c"):
        name = disc.upper()
        found += [
            Role(
                name=f"inline_{name}",
                pattern=rf"(ggi_?)?in_?line_?{disc}(_?raw)?",
                sure="likely",
                scale=2.0,
                why=half,
            ),
            Role(f"cross_{name}", rf"(ggi_?)?cross_?{disc}(_?raw)?"),
        ]
    for complement in ("a", "b"):
        name = complement.upper()
        found += [
            Role(
                name=f"inline_{name}",
                pattern=rf"{complement}_?uv(_\w+)?",
                sure="likely",
                scale=2.0,
                why="UV is (Gamma_xx - Gamma_yy)/2",
            ),
            Role(f"cross_{name}", rf"{complement}_?ne(_\w+)?"),
        ]
    return found


def _auxiliaries() -> list[Role]:
    return [
        Role("spin_angle", r"spin_?(angle|phase)|encoder(_?angle)?|disc_?angle"),
        Role("temperature", r"temp(erature)?(_?[a-z0-9]+)?"),
        Role("pressure", r"(air_?|baro_?)?press(ure)?|baro"),
        Role("roll", r"roll"),
        Role("pitch", r"pitch"),
        Role("yaw", r"yaw"),
        Role("heading", r"heading|hdg|bearing|azimuth"),
        Role("easting", r"east(ing)?|mga_?x|utm_?(e|x)|x_?utm"),
        Role("northing", r"north(ing)?|mga_?y|utm_?(n|y)|y_?utm"),
        Role("easting", r"x", "guess", why="a position?"),
        Role("northing", r"y", "guess", why="a position?"),
        Role("latitude", r"lat(itude)?(_?(deg|wgs84))?"),
        Role("longitude", r"lon(g|gitude?)?(_?(deg|wgs84))?"),
        Role("altitude", r"alt(itude)?|height|gps_?(z|alt|height)|(mga|msl)_?z|elev(ation)?"),
        Role("clearance", r"clearance|radar_?alt|ralt|lalt|drape_?agl"),
        Role("flight", r"flight(_?(no|num|number))?|flt", unit="1"),
        Role("turbulence", r"turb(ulence)?"),
        Role("vertical_velocity", r"v(ert(ical)?)?_?(vel(ocity)?|speed)|vz"),
        Role("vertical_acceleration", r"vert(ical)?_?acc(el(eration)?)?"),
    ]


_ALL = _roles()

ROLES: Mapping[str, Role] = MappingProxyType({r.name: r for r in reversed(_ALL)})
"""The first role of every channel, by name."""


def role_of(column: str) -> Role | None:
    """What a column of this name may be; its own name is certain."""
    own = next((r for r in _ALL if r.name == column), None)
    if own is not None and column not in ("line", "flight"):
        return Role(own.name, own.pattern, "certain", unit=own.unit)
    return min((r for r in _ALL if r.fits(column)), key=lambda r: r.rank, default=None)
