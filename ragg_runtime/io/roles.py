"""What columns may be, by the words of their names: loggers have many names for the same things.

A name is taken apart into words, and a unit among them is taken off. A quantity and a direction are looked for; words that
say that it is no reading (``covariance``, ``bias``) rule it out, unknown ones make it a guess.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ragg_runtime.io.record import SI_UNITS

RANKS = ("certain", "likely", "guess")


@dataclass(frozen=True)
class Role:
    """A channel that a column may be: how sure that is (see ``RANKS``), the ``scale`` between column and channel where the name tells it,
    and ``why``. Of a component whose axis the other columns decide, ``direction`` is how the name calls it.
    """

    name: str
    sure: str = "likely"
    scale: float = 1.0
    why: str = ""
    direction: str = ""

    @property
    def rank(self) -> int:
        return RANKS.index(self.sure)


_HALF = "an inline output is usually (Gamma_xx - Gamma_yy)/2; ragg's inline is twice that"
_DISCS = "1234ABC"
_PAIRS = ("xx", "xy", "xz", "yy", "yz", "zz")
_SCALARS = (
    (Role("time"), r"t|time|((gps|utc|unix|imu|rec|sample|relative|logging|log|system)_?)?(time|sec(onds?)?)(_fine)?|f_?time|fid(ucial)?"),
    (Role("time"), r"time_?(gps|utc|1980|day|startup)|x_?value|(time_?)?stamp|elapsed(_?time)?|zeit|m?jd|julian_?da(y|te)|millis|micros"),
    (Role("line"), r"line|line_?(no|num|number|id|index)|(flight_?)?line"),
    (Role("week"), r"(gps_?)?w(ee)?k(_?no|_?number)?"),
    (Role("second_of_week"), r"(gps_?)?(sow|tow|sec(onds?)?_?(of|in)_?week|week_?sec(onds?)?|seconds_of_gps_week)|gps_?seconds?|seconds"),
    (Role("date"), r"date|y{2,4}m{2}d{2}|utc_?date|gps_?date|datum"),
    (Role("clock"), r"hhmmss(_?s+)?|utc|clock|time|time_?of_?day|utc_?time|gps_?time|uhrzeit"),
    (Role("G_out"), r"[guv]_?out|(ggi_?)?(out(put)?|sum)(_?(volt(age)?|sum))?|ggi|volt(age)?_?out(put)?"),
    (Role("cross"), r"cross(_?raw)?"),
    (Role("inline", scale=2.0, why=_HALF), r"in_?line(_?raw)?"),
    (Role("spin_angle"), r"spin_?(angle|phase)|encoder(_?angle)?|disc_?angle"),
    (Role("temperature"), r"([a-z]+_|[a-z])?temp(eratur(e)?)?(_?[a-z0-9]+)?"),
    (Role("pressure"), r"((air|baro|ambient|static)_?)?pres(s(ure)?)?|baro"),
    *((Role(n), n) for n in ("roll", "pitch", "yaw")),
    *((Role(f"Gamma_{x}"), rf"(gamma|gradient|gg)_?({x}|{x[::-1]})") for x in _PAIRS),
    *((Role(f"Gamma_{x}", "guess", why="known beforehand?"), rf"[tg]_?({x}|{x[::-1]})") for x in _PAIRS),
    *((Role(f"V_{k}"), rf"v_?{k}|volt(age)?_?{k}|a(cc(el)?)?_?{k}_?v(olt(age)?)?") for k in range(1, 5)),
    *((Role(f"inline_{d}", scale=2.0, why=_HALF), rf"(ggi_?)?in_?line_?{d}(_?raw)?|ggi_?{d}_?in_?line") for d in _DISCS),
    *((Role(f"cross_{d}"), rf"(ggi_?)?cross_?{d}(_?raw)?|ggi_?{d}_?cross") for d in _DISCS),
    *((Role(f"inline_{d}", scale=2.0, why=_HALF), rf"{d}_?uv(_\w+)?") for d in "AB"),
    *((Role(f"cross_{d}"), rf"{d}_?ne(_\w+)?") for d in "AB"),
)  # fmt: skip
"""Channels without a direction, and the usual names of a column of each."""

_ANGULAR = r"(?:ang(?:ular)?|body|gyro)_?"
_VECTORS = (
    ("omegadot", "likely", rf"omega_?dot|alpha|{_ANGULAR}acc(?:el(?:eration)?)?"),
    ("omega", "likely", rf"{_ANGULAR}(?:rate|vel(?:ocity)?)|gyr(?:o(?:scopes?)?)?|rate|rot(?:ation)?|omg|omega|w"),
    ("a", "likely", r"(?:linear_?)?acc(?:n|l|el(?:eration|erometer)?s?)?|specific_?force|sf|f|a"),
    ("B", "guess", r"mag(?:net(?:ic|ometer)?)?(?:_?field)?|field|b"),
    ("omega", "guess", r"g"),
)  # fmt: skip
"""Channels of three components, how sure their names are, and the names. A single letter must begin the column's name."""

_FRAMES = (
    ("north", "east", "down"),
    ("east", "north", "up"),
    ("forward", "right", "down"),
    ("forward", "left", "up"),
    ("right", "forward", "up"),
    ("longitudinal", "lateral", "vertical"),
    ("roll", "pitch", "yaw"),
    ("p", "q", "r"),
    ("xv1", "xv2", "xv3"),
    ("1", "2", "3"),
    ("0", "1", "2"),
)
"""Directions that stand for x, y, z where a table has all three: right-handed axes of vehicles and of navigation."""

_SHORT = {"n": "north", "e": "east", "d": "down", "u": "up", "fwd": "forward", "vert": "vertical", "lat": "lateral",
          "long": "longitudinal", "xv": "x", "yv": "y", "zv": "z", "p": "roll", "q": "pitch", "r": "yaw"}  # fmt: skip
_LONG = "|".join(
    dict.fromkeys([*"xyz", *(d for f in _FRAMES for d in f if len(d) > 1), "xv_?[123]", "[0-9]"])
)
_DIRECTION = rf"(?:{_LONG}|{'|'.join(_SHORT)})"

_UNITS = (
    ("m/s^2", r"m_?p?_?s_?2|m_?p?_?s_s"),
    ("ft/s^2", r"ft_?s(?:ec)?_?2"),
    ("deg/s", r"dps|deg_?p?_?s(?:ec)?"),
    ("rad/s", r"rad_?p?_?s(?:ec)?|rps"),
    ("mdeg/s", r"mdps"),
    ("deg/h", r"dph|deg_?p?_?h(?:r|our)?"),
    *((u, u) for u in ("deg", "rad", "us", "ms", "ns", "mg", "ug", "mv", "nt", "ut")),
    ("degC", r"deg_?c"),
    *((u, rf"{u.lower()}$") for u in ("s", "g", "V", "K", "Pa", "hPa", "mbar", "Eo", "T")),
    *((u, rf"{w}$") for u, w in (("s", "sec(?:onds?)?"), ("V", "volts?"), ("degC", "c"), ("us", "micros"), ("ms", "millis"))),
)  # fmt: skip
"""Units and how they stand among the words of a name; single letters only at its end."""

_NEUTRAL = re.compile(
    r"imu|ins|sensor|data|field|msg|body|raw|avg|mean|smp|scaled|cal|comp|mems|linear|out|ib|b|v|frame|vehicle|combined|topic|platform"
    r"|ggi|rec|\d+"
)
_NO_READING = re.compile(
    r"cov(ariance)?|std(dev)?|sigma|var(iance)?|bias|offset|status|flags?|valid|count(er)?|integral|int|dt|err(or)?|delta|vel(ocity)?"
    r"|speed|pos(ition)?|orientation|quat(ernion)?|attitude|uncomp|rms|min|max|scale|factor|seq|id|free|earth|temp(erature)?|setpoint|sp"
    r"|ref|relative|jerk|noise|filt"
)


def find_roles(columns: Sequence[str]) -> dict[str, tuple[Role, ...]]:
    """What the columns of a table may be: column -> its roles, the surest first.

    Parameters
    ----------
    columns
        Names, without the units behind them.
    """
    found = {c: _read_name(c) for c in columns}
    taken = {(r.name, r.direction) for roles in found.values() for r in roles if r.direction}
    axes: dict[tuple[str, str], tuple[str, str]] = {}
    for stem in ("a", "omega", "omegadot", "B"):
        for frame in reversed(_FRAMES):
            four = frame == ("1", "2", "3") and (stem, "4") in taken  # the disc's own accelerometers
            if all((stem, d) in taken for d in frame) and not four:
                axes |= {(stem, d): (x, ", ".join(frame)) for d, x in zip(frame, "xyz", strict=True)}
    return {c: tuple(sorted(_turn(roles, axes), key=lambda r: r.rank)) for c, roles in found.items()}


def _turn(roles: Iterable[Role], axes: dict[tuple[str, str], tuple[str, str]]) -> Iterable[Role]:
    """Roles with directions as those of axes, as far as the table has all three."""
    for r in roles:
        if not r.direction:
            yield r
        elif r.direction in "xyz":
            yield replace(r, name=f"{r.name}_{r.direction}", direction="")
        elif (r.name, r.direction) in axes:
            axis, three = axes[r.name, r.direction]
            yield replace(r, name=f"{r.name}_{axis}", sure="guess", why=f"{three} as x, y, z?")


def find_unit(column: str) -> str:
    """The unit among the words of a name; ``""``: there is none."""
    return _take_unit(_fold(column))[1]


def _read_name(column: str) -> list[Role]:
    """The roles of a column by itself; its own name is certain."""
    if column in SI_UNITS or any(r.name == column != "line" for r, _ in _SCALARS):
        return [Role(column, "certain"), *_read_scalars(column)]
    scale = -1.0 if column.lstrip().startswith("-") else 1.0
    parts = re.split(r"[/.]", column.replace("'", ""))
    inner = ["_".join(parts[k:]) for k in range(len(parts))]
    found: list[Role] = []
    for text in (*inner, re.sub(r"\(.*\)", "", column)):  # perhaps without a remark in brackets
        found += _read_scalars(text) or [replace(r, scale=scale) for r in _read_vectors(text)]
    return found


def _read_scalars(name: str) -> list[Role]:
    folded = _fold(name)
    plain, _ = _take_unit(folded)
    bare = "_".join(w for w in plain.split("_") if w in ("out", "ggi") or not _NEUTRAL.fullmatch(w))
    texts = (folded, plain, bare)
    return [r for r, pattern in _SCALARS if any(re.fullmatch(pattern, t, re.IGNORECASE) for t in texts)]


def _read_vectors(name: str) -> list[Role]:
    """The component that a name says: ``AccX``, ``gyro_fwd_dps``, ``X-Acceleration``."""
    text, _ = _take_unit(_fold(name))
    if (m := re.fullmatch(r"([pqr])(?:_(?:body|b))?", text)) is not None:
        return [Role("omega", "guess", direction=m[1])]
    for stem, sure, words in _VECTORS:
        glued = rf"(?:({_LONG})_?|({_DIRECTION})_)?({words})(?:_?({_LONG})|_({_DIRECTION}))?"
        for m in re.finditer(rf"(?:^|(?<=_)){glued}(?=_|$)", text):
            if len(m[3]) == 1 and m.start() > 0 and not (m[1] or m[4]):
                continue  # a letter in the middle
            rest = [w for w in f"{text[: m.start()]}_{text[m.end() :]}".split("_") if w]
            rest = [w for w in rest if not re.fullmatch(words, w) and not _NEUTRAL.fullmatch(w)]
            given = [d for d in m.group(1, 2, 4, 5) if d]
            given += [w for w in rest if re.fullmatch(_LONG, w) or w in ("xv", "yv", "zv")]
            rest = [w for w in rest if w not in given]
            if len(given) != 1 or any(map(_NO_READING.fullmatch, rest)):
                continue
            direction = _SHORT.get(given[0], given[0].replace("_", ""))
            return [Role(stem, "guess" if rest else sure, direction=direction)]
    return []


def _fold(name: str) -> str:
    """The words of a name in small letters, divided by ``_``."""
    words = re.sub(r"(?<=[a-z]{2})(?=[A-Z])|(?<=[A-Z]{2})(?=[A-Z][a-z])", "_", name)
    return re.sub(r"[\W_]+", "_", words).strip("_").lower()


def _take_unit(folded: str) -> tuple[str, str]:
    """The words without the unit among them, and the unit."""
    for unit, pattern in _UNITS:
        if (m := re.search(rf"(?<=[a-z0-9])_(?:{pattern})(?=_|$)", folded)) is not None:
            return (folded[: m.start()] + folded[m.end() :]), unit
    return folded, {"millis": "ms", "micros": "us"}.get(folded, "")
