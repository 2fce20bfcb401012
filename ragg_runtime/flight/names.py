"""Names that recorders and survey companies give their columns, and what they stand for here."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

_RANKS = ("certain", "likely", "guess")


@dataclass(frozen=True)
class Role:
    """A channel that a column may be.

    Attributes
    ----------
    name
        Of the channel.
    pattern
        Regular expression that the column's whole name must match, in small letters, divided by ``_``.
    sure
        ``likely`` or ``guess``; the channel's own name is ``certain``.
    scale
        Factor between the column and the channel, where the name tells it.
    why
        A remark for whoever looks the mapping over.
    unit
        The only unit that it can have (of a number that counts), where there is just one.
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
