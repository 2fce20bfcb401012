"""Units that nearly every record and sheet is written in, as pint converts them: pint takes 0.3 s to come, these come at once.

Held against pint, to the bit, by ``tests/runtime/test_units.py``.
"""

from __future__ import annotations

from collections.abc import Mapping

FACTORS: Mapping[tuple[str, str], float] = {
    ("1", "1"): 1.0,
    ("1/(K/min)", "s/K"): 60.0,
    ("1/K", "1/K"): 1.0,
    ("1/s", "1/s"): 1.0,
    ("1/s^2", "s^-2"): 1.0,
    ("Eo", "1/s**2"): 1e-09,
    ("Eo", "s^-2"): 1e-09,
    ("Eo/m", "1/m/s**2"): 1e-09,
    ("Eo/m^2", "1/m**2/s**2"): 1e-09,
    ("Eo/rad", "1/rad/s**2"): 1e-09,
    ("K", "K"): 1.0,
    ("Pa", "Pa"): 1.0,
    ("T", "T"): 1.0,
    ("V", "V"): 1.0,
    ("arcsec", "rad"): 4.84813681109536e-06,
    ("deg", "rad"): 0.017453292519943295,
    ("deg/h", "rad/s"): 4.84813681109536e-06,
    ("deg/s", "rad/s"): 0.017453292519943295,
    ("deg/s^2", "rad/s^2"): 0.017453292519943295,
    ("hPa", "Pa"): 100.0,
    ("kPa", "Pa"): 1000.0,
    ("km", "m"): 1000.0,
    ("m", "m"): 1.0,
    ("m/s2", "m/s^2"): 1.0,
    ("m/s^2", "m/s^2"): 1.0,
    ("mT", "T"): 0.001,
    ("mV", "V"): 0.001,
    ("mm", "m"): 0.001,
    ("ms", "s"): 0.001,
    ("nT", "T"): 1e-09,
    ("ohm", "V/A"): 1.0,
    ("rad", "rad"): 1.0,
    ("rad/s", "rad/s"): 1.0,
    ("rad/s^0.5", "rad/s**0.5"): 1.0,
    ("rad/s^2", "rad/s^2"): 1.0,
    ("s", "s"): 1.0,
    ("s^-2", "s^-2"): 1.0,
    ("s^2", "s**2"): 1.0,
    ("uT", "T"): 1e-06,
    ("uV", "V"): 1e-06,
    ("um", "m"): 1e-06,
    ("urad", "rad"): 1e-06,
}
"""Unit and SI unit -> the number of these in one of those."""

G0 = 9.8
"""m/s^2: the specific force that is called g unless a sheet says otherwise."""

FACTORS_OF_G: Mapping[tuple[str, str], float] = {
    ("deg/h/g", "rad*s/m"): 4.947078378668734e-07,
    ("g", "m/s^2"): 9.8,
    ("g^2", "m**2/s**4"): 96.04000000000002,
    ("mA/g", "A*s**2/m"): 0.0001020408163265306,
    ("mA/g", "A/(m/s^2)"): 0.0001020408163265306,
    ("mg", "m/s^2"): 0.009800000000000001,
    ("rad/g", "rad*s**2/m"): 0.1020408163265306,
    ("ug", "m/s**2"): 9.800000000000001e-06,
    ("ug", "m/s^2"): 9.800000000000001e-06,
    ("ug/(K/min)", "m/K/s"): 0.0005880000000000001,
    ("ug/(rad/s)^2", "m/rad**2"): 9.800000000000001e-06,
    ("ug/(rad/s^2)", "m/rad"): 9.800000000000001e-06,
    ("ug/K", "m/K/s**2"): 9.800000000000001e-06,
    ("ug/g^2", "1/(m/s^2)"): 1.020408163265306e-07,
    ("ug/g^2", "s**2/m"): 1.020408163265306e-07,
    ("ug/g^3", "s**4/m**2"): 1.0412328196584754e-08,
    ("ug/kPa", "m**2/kg"): 9.800000000000002e-09,
    ("ug/mT", "A*m/kg"): 0.009800000000000001,
    ("ug/s", "m/s**3"): 9.800000000000001e-06,
    ("um/g", "s**2"): 1.020408163265306e-07,
}
"""The same of units that are made with g."""

BASE: Mapping[str, str] = {
    "1": "1",
    "1/(K/min)": "s/K",
    "1/K": "1/K",
    "1/s": "1/s",
    "Eo": "1/s**2",
    "Eo/m": "1/m/s**2",
    "Eo/m^2": "1/m**2/s**2",
    "Eo/rad": "1/rad/s**2",
    "arcsec": "rad",
    "deg/h": "rad/s",
    "deg/h/g": "rad*s/m",
    "g^2": "m**2/s**4",
    "m": "m",
    "mA/g": "A*s**2/m",
    "rad": "rad",
    "rad/g": "rad*s**2/m",
    "rad/s^0.5": "rad/s**0.5",
    "s": "s",
    "s^2": "s**2",
    "ug": "m/s**2",
    "ug/(K/min)": "m/K/s",
    "ug/(rad/s)^2": "m/rad**2",
    "ug/(rad/s^2)": "m/rad",
    "ug/K": "m/K/s**2",
    "ug/g^2": "s**2/m",
    "ug/g^3": "s**4/m**2",
    "ug/kPa": "m**2/kg",
    "ug/mT": "A*m/kg",
    "ug/s": "m/s**3",
    "um": "m",
    "um/g": "s**2",
}
"""Unit -> the SI base unit for it."""
