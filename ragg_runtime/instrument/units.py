"""Units: pint, with the field's own words and with g the model's own g0.

In this project ``g`` is the specific force g0 of the model file (9.8 m/s^2 in the paper), never the gram:
``ug``, ``mg``, ``mA/g``, ``ug/g^2`` all follow. ``kg`` stays the kilogram. ``Eo`` is 1e-9 s^-2.
"""

from __future__ import annotations

import contextlib
import math
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError

if TYPE_CHECKING:
    import pint


Value = TypeVar("Value", float, NDArray[np.float64])

EOTVOS = 1e-9  # 1 Eo in s^-2
STANDARD_G0 = 9.8  # what g means in a model.toml with [[disc]] that does not say it, m/s^2: the paper's value

DIMENSIONLESS = ("1", "", "-", "dimensionless")

_EXAMPLES = "a unit such as m, um, rad, arcsec, ug, ug/g^2, mA/g, ohm, deg/h, Eo, 1/K, s^-2, or 1 for none"

_ROTATIONS = ("revolutions_per_minute", "revolutions_per_second")
# Units that count angle though their dimension is one: 1 Hz is one turn a second, not one radian a second.
_ANGLES = frozenset(
    ("radian", "degree", "arcminute", "arcsecond", "milliarcsecond", "turn", "grade", "mil", *_ROTATIONS)
)
_CYCLES = frozenset(("hertz", "counts_per_second"))

# pint evaluates powers of numbers in a unit ("9**9**9" never returns) and drops unknown characters ("m;s"): only
# products and quotients of names with small exponents reach it, in brackets at most once.
_POWER = r"(?:\s*(?:\^|\*\*)\s*[+-]?(?:\d|1[012])(?:\.\d+)?)?"
_NAME = rf"(?:°?[^\W\d]\w*|°|%){_POWER}"
_BY = r"(?:\s*[*/·]\s*|\s+)"
_TERM = rf"(?:{_NAME}|\(\s*{_NAME}(?:{_BY}{_NAME})*\s*\){_POWER})"
_UNIT = re.compile(rf"\s*(?:1\s*[*/]\s*)?{_TERM}(?:{_BY}{_TERM})*\s*")
_LONGEST = 100


@dataclass(frozen=True)
class RawQuantity:
    """A number, or one for each of the four accelerometers, with the unit that the user wrote."""

    value: float | tuple[float, ...]
    unit: str

    def __str__(self) -> str:
        text = repr(self.value) if isinstance(self.value, float) else repr(list(self.value))
        return f"{text} {self.unit}"


class Units:
    """Units of one model: parses and converts, with g := ``g0`` in m/s^2. :func:`units` shares instances."""

    def __init__(self, g0: float) -> None:
        if not (math.isfinite(g0) and g0 > 0):
            raise UserError("g0 must be a positive acceleration", found=g0, expected="such as 9.8 m/s^2")
        self.g0 = float(g0)
        self._parsed: dict[str, Any] = {}

    @cached_property
    def _registry(self) -> pint.UnitRegistry[Any]:
        import pint  # slow to import, and messages do without it

        registry: pint.UnitRegistry[Any] = pint.UnitRegistry(on_redefinition="ignore")
        registry.define(f"standard_g = {self.g0!r} * meter / second ** 2 = g")
        registry.define("kilogram_mass = 1000 * gram = kg")
        registry.define("eotvos = 1e-9 / second ** 2 = Eo = Eotvos")
        registry.define("gauss_in_si = 1e-4 * tesla = G = gauss")  # pint's own is of CGS
        return registry

    def parse(self, unit: str, where: str | None = None) -> Any:
        """The pint unit written as ``unit``; UserError if it is none."""
        text = unit.strip()
        if text not in self._parsed:
            self._parsed[text] = self._parse(text, where)
        return self._parsed[text]

    def _parse(self, text: str, where: str | None) -> Any:
        import pint

        if text in DIMENSIONLESS:
            return self._registry.dimensionless
        remedy = "join names of units by * or /, with exponents up to 12; a number belongs in the value"
        for spelling in list_spellings(text) if len(text) <= _LONGEST else ():
            if _UNIT.fullmatch(spelling) is None:
                continue
            try:
                return self._registry.parse_units(spelling.replace("·", "*"))
            except pint.UndefinedUnitError as error:
                names = (error.unit_names,) if isinstance(error.unit_names, str) else error.unit_names
                remedy = f"{', '.join(map(str, names))} is not a known unit"
            except Exception:  # what pint raises for a malformed expression is not documented
                continue
        raise UserError("not a unit", where=where, found=repr(text), expected=_EXAMPLES, remedy=remedy)

    def divide(self, unit: str, by: Iterable[str]) -> str:
        """An SI unit over some others, products of products too, each symbol once: ``1/K`` for m/s^2 over m/s^2 and K."""
        quotient = self._registry.parse_units(unit)
        for other in by:
            quotient /= self._registry.parse_units(other)
        return f"{quotient:~C}".replace("**", "^") or "1"

    def to_si(self, value: Value, unit: str, si_unit: str, where: str | None = None) -> Value:
        """``value`` in ``unit``, converted to ``si_unit``; UserError if dimensions differ. rpm and rad/s become turns a second."""
        source, target, turns = self._prepare(unit, si_unit, where)
        try:
            with np.errstate(over="ignore"):  # callers look whether what comes out is finite
                result: Value = self._registry.convert(value, source, target)
        except (OverflowError, ZeroDivisionError):
            raise UserError("the unit is too large or too small", where=where, found=repr(unit)) from None
        return result / (2 * math.pi) if turns else result

    def from_si(self, value: Value, si_unit: str, unit: str) -> Value:
        """``value`` in ``si_unit``, converted to ``unit``; the inverse of :meth:`to_si`."""
        target, source, turns = self._prepare(unit, si_unit, None)
        result: Value = self._registry.convert(value * (2 * math.pi) if turns else value, source, target)
        return result

    def _prepare(self, unit: str, si_unit: str, where: str | None) -> tuple[Any, Any, bool]:
        """Both units, of one dimension, and whether angles of the first are turns of the other; else UserError."""
        unit = self.find_meant(unit, si_unit) or unit
        source, target = self.parse(unit, where), self.parse(si_unit)
        if source.dimensionality != target.dimensionality:
            raise UserError(
                "the unit has the wrong dimension",
                where=where,
                found=f"{unit!r} ({_describe(source)})",
                expected=f"a unit of {_describe(target)}, which {si_unit!r} has",
                remedy=f"g is the specific force {self.g0:g} m/s^2 here, not the gram"
                if "[mass]" in str(target.dimensionality) + str(source.dimensionality)
                else None,
            )
        if self._has_factor(source, _CYCLES) and self._has_factor(target, _ANGLES):
            raise UserError(
                "a frequency is given where an angular rate is needed",
                where=where,
                found=repr(unit),
                expected=si_unit,
                remedy="write rad/s, deg/s, deg/h or rpm",
            )
        return source, target, self._has_factor(target, _CYCLES) and self._has_factor(source, _ANGLES)

    def base_unit(self, unit: str, where: str | None = None) -> str:
        """The SI base unit for ``unit``, as text that :meth:`parse` reads (``K``, ``m/s**2``)."""
        base = self._registry.get_base_units(self.parse(unit, where))[1]
        return f"{base:~C}" or "1"

    def fits(self, unit: str, si_unit: str) -> bool:
        """Whether ``unit`` is a unit and has the dimension of ``si_unit``."""
        return self.find_meant(unit, si_unit) is not None

    def find_meant(self, unit: str, si_unit: str) -> str | None:
        """The reading that has the dimension: ``g`` for G of an acceleration, ``degC`` for C of a temperature, ``m/s2`` for M/S2."""
        dimension = self.parse(si_unit).dimensionality
        for reading in (unit, _LETTERS.get(unit.strip(), unit), unit.casefold()):
            with contextlib.suppress(UserError):
                if self.parse(reading).dimensionality == dimension:
                    return reading
        return None

    def _has_factor(self, unit: Any, names: frozenset[str]) -> bool:
        """Whether one of these units, with any prefix, is a factor of a unit."""
        return any(self._registry.parse_unit_name(name)[0][1] in names for name in unit._units)


@lru_cache(maxsize=32)
def units(g0: float) -> Units:
    """The shared :class:`Units` of this ``g0`` (m/s^2)."""
    return Units(g0)


_AMOUNT = re.compile(r"\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*(\S.*)?")
# a decimal comma, but not what may be a comma between thousands
_COMMA = re.compile(r"^(\s*[+-]?(?:0+,\d+|\d+,(?!\d{3}(?!\d))\d+))")


def read_quantity(raw: object, where: str, *, count: int) -> RawQuantity:
    """Read ``"0.1 m"`` or ``{ value = 0.1, unit = "m" }``, or with a list of ``count`` values; UserError for anything else."""
    value: object = None
    unit: object = None
    if isinstance(raw, str):
        match = _AMOUNT.fullmatch(_COMMA.sub(lambda m: m[0].replace(",", "."), raw))
        if match is not None:
            with contextlib.suppress(ValueError):
                value, unit = float(match[1]), match[2]
    elif isinstance(raw, Mapping):
        value, unit = (raw.get("value"), raw.get("unit")) if raw.keys() <= {"value", "unit"} else (None, None)
    elif isinstance(raw, int | float) and not isinstance(raw, bool):
        value = raw
    if value is None:
        expected = '"0.1 m", { value = 0.1, unit = "m" }'
        expected += f' or {{ value = [{_count_up(count)}], unit = "m" }}' if count > 1 else ""
        raise UserError("not a quantity", where=where, found=repr(raw), expected=expected)
    if not isinstance(unit, str):
        raise UserError(
            "the unit is missing" if unit is None else "the unit is not a text",
            where=where,
            found=repr(raw),
            expected='"0.1 m" or { value = 0.1, unit = "m" }',
            remedy='write the unit; a pure number has the unit "1"; none is guessed',
        )
    if not isinstance(value, list | tuple):
        return RawQuantity(_read_number(value, where), unit.strip())
    if len(value) != count:
        raise UserError(
            "wrong number of values",
            where=where,
            found=f"{len(value)} values",
            expected=f"one number, or {count} ({_count_up(count, 'A')})" if count > 1 else "one number",
        )
    return RawQuantity(tuple(_read_number(v, where) for v in value), unit.strip())


def _read_number(value: object, where: str | None) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UserError("not a number", where=where, found=repr(value), expected="a number")
    if not abs(value) <= sys.float_info.max:
        text = value if isinstance(value, float) else "a whole number too large for a float"
        raise UserError("the value is not finite", where=where, found=text, expected="a finite number")
    return float(value)


def read_si(quantity: RawQuantity, si_unit: str, g0: float, where: str) -> NDArray[np.float64]:
    """The numbers of a quantity, (1,) or (n,), in ``si_unit``; UserError if one is not finite there."""
    numbers = np.atleast_1d(np.asarray(quantity.value, dtype=np.float64))
    value = np.asarray(units(g0).to_si(numbers, quantity.unit, si_unit, where))
    if not np.all(np.isfinite(value)):
        raise UserError("the value is not finite in SI", where=where, found=value, expected="finite numbers")
    return value


def _count_up(count: int, before: str = "") -> str:
    """1, 2, 3 or 1 ... 8, each with what stands ``before`` it."""
    labels = [f"{before}{k + 1}" for k in range(count)]
    return ", ".join(labels) if count <= 4 else f"{labels[0]} ... {labels[-1]}"


def _describe(unit: Any) -> str:
    return "dimension one" if unit.dimensionless else str(unit.dimensionality)


_NAMED = {
    spelling: unit
    for unit, spellings in {
        # EU would be an exa-enzyme-unit, gal a gallon and E nothing at all.
        "Eo": ("E", "EU", "EO", "Eö", "EOTVOS", "Eötvös", "eötvös", "Eötvos", "Eoetvoes", "eotvoes"),
        "mEo": ("mE",),
        "uEo": ("uE", "µE", "μE"),
        "Gal": ("gal", "gals", "GAL"),
        "mGal": ("mgal", "mgals", "MGAL", "milligal"),
        "uGal": ("ugal", "µgal", "μgal", "microgal"),
        "deg/s": ("dps", "DPS"),
        "deg/h": ("dph", "degph"),
        "mdeg/s": ("mdps", "MDPS"),
        "degC": ("\u2103", "Celsius", "CELSIUS", "degrees_celsius", "degrees_Celsius"),
        "degF": ("\u2109",),
        "rad": ("rads",),
        "V": ("Vdc", "VDC", "V DC"),
        "mV": ("mVolt", "mVolts"),
        "g": ("g's", "G's", "gs", "gee", "gees"),
        "mbar": ("mb",),
        "gauss": ("Gs",),
        "1": ("unitless",),
    }.items()
    for spelling in spellings
}
_DEGREES = re.compile(r"(?:deg(?:rees?)?|°|o)[ ._]*([CFK])", re.IGNORECASE)  # of temperature: Deg. C, °K.
# usual abbreviations, read so if only this reading has the dimension
_LETTERS = {"C": "degC", "F": "degF", "k": "K", "ms-2": "m s-2", "ms^-2": "m s-2", "mps2": "m s-2", "gn": "g"}

_WORDS = frozenset((
    "deg", "degs", "degree", "degrees", "rad", "rads", "radian", "radians", "s", "sec", "secs", "second", "seconds", "h",
    "hr", "hrs", "hour", "hours", "min", "minute", "volt", "volts", "m", "meter", "meters", "metres", "kelvin",
))  # fmt: skip
"""Words of units that programs write in capitals, and that mean the same then."""

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def list_spellings(text: str) -> Iterator[str]:
    """Readings of ``text`` in the order to try: the field's spellings first."""
    text = re.sub("degrees?_?(north|east|true|[NE])", "deg", text.replace("º", "°"))  # CF writes latitudes so
    if degrees := _DEGREES.fullmatch(text):
        text = {"C": "degC", "F": "degF", "K": "K"}[degrees[1].upper()]
    yield _NAMED.get(text, text)
    text = re.sub(r"°(?=[^\W\d])", "deg ", text).replace("_per_", "/")
    plain = re.sub(r"[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda m: "^" + m[0].translate(_SUPERSCRIPTS), text)
    plain = re.sub(r"(?<=[^\W\d_])(-?\d+)(?![\w.])", r"^\1", plain)
    plain = re.sub(r"(?<=[^\W_])\.(?=[^\W\d_])", "*", plain)  # m.s-2
    yield plain
    words = re.findall(r"[^\W\d_]+", plain)
    if words and all(w.casefold() in _WORDS for w in words):
        yield plain.casefold()
