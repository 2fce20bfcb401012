"""Units as people write them, turned into units as :mod:`ragg_runtime.instrument.units` reads them."""

from __future__ import annotations

import re
from collections.abc import Iterator

_NAMED = {
    spelling: unit
    for unit, spellings in {
        # EU would be an exa-enzyme-unit, gal a gallon and E nothing at all.
        "Eo": ("E", "EU", "EO", "Eö", "EOTVOS", "Eötvös", "eötvös", "Eoetvoes", "eotvoes", "eotvos"),
        "mEo": ("mE",),
        "uEo": ("uE", "µE", "μE"),
        "Gal": ("gal", "gals", "GAL"),
        "mGal": ("mgal", "mgals", "MGAL", "milligal", "milliGal"),
        "uGal": ("ugal", "µgal", "μgal", "microgal"),
        "deg/s": ("dps", "DPS", "°/s", "deg/sec"),
        "deg/h": ("dph", "°/h", "°/hr"),
        "degC": ("deg C", "° C", "deg.C", "Celsius", "CELSIUS", "DEGC"),
        "deg": ("DEG", "degs", "DEGREES", "Degrees"),
        "rad": ("RAD", "rads"),
        "s": ("SEC", "Seconds", "SECONDS"),
        "m": ("METRES", "METERS"),
        "V": ("VOLT", "VOLTS", "Volts"),
        "1": ("unitless",),
    }.items()
    for spelling in spellings
}
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def spellings(text: str) -> Iterator[str]:
    """What ``text`` may stand for, in the order in which it is to be tried.

    A spelling of the field comes before what the same letters mean elsewhere; exponents without a sign of
    power (``m/s2``, ``m s-2``, ``m/s²``) are tried last, since the names of some units hold digits.
    """
    yield _NAMED.get(text, text)
    plain = re.sub(r"[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda m: "^" + m[0].translate(_SUPERSCRIPTS), text)
    plain = re.sub(r"(?<=[^\W\d_])(-?\d+)(?![\w.])", r"^\1", plain)
    plain = re.sub(r"(?<=[^\W_])\.(?=[^\W\d_])", "*", plain)  # m.s-2
    if plain != text:
        yield plain
