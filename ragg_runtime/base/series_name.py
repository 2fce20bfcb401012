"""Names of series and of harmonics: a small expression language, its one parser and its one printer (``str``).

Results name what a generic term is made of by text that a reader can take literally:

- a channel: ``a_x``, ``temperature``, ``time``, or ``f_i``, ``f_o``, the forces that turn with the disc;
- its derivatives by time: ``d_a_x``, ``d2_a_x``;
- ``abs(X)``, ``sign(X)``, ``square(X)``;
- ``slow(X, 20 s)``, ``slow(X Y, 20 s)``: X, or a product, through a relaxation of a time constant, as in creep;
- harmonics of the disc angle: ``const``, ``cos 2``, ``sin 1``.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from functools import cache
from typing import Literal

FunctionName = Literal["abs", "sign", "square"]


@dataclass(frozen=True)
class ChannelName:
    """A recorded channel, time, or a force that turns with the disc."""

    name: str

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Derivative:
    """First or second derivative of a channel by time."""

    of: ChannelName
    order: int

    def __str__(self) -> str:
        return f"{'d' if self.order == 1 else f'd{self.order}'}_{self.of}"


@dataclass(frozen=True)
class Function:
    """A function of another series, instant by instant."""

    name: FunctionName
    of: Series

    def __str__(self) -> str:
        return f"{self.name}({self.of})"


@dataclass(frozen=True)
class Product:
    """A product of series that relaxes as a whole."""

    of: tuple[Series, ...]

    def __str__(self) -> str:
        return " ".join(str(s) for s in self.of)


@dataclass(frozen=True)
class Relaxation:
    """Another series through a relaxation of a time constant, in seconds as they are written."""

    of: Series
    seconds: str

    def __str__(self) -> str:
        return f"slow({self.of}, {self.seconds} s)"


Series = ChannelName | Derivative | Function | Product | Relaxation

_FUNCTION = re.compile(r"(abs|sign|square)\((.+)\)")
_RELAXATION = re.compile(r"slow\((.+), ([0-9.]+) s\)")
_DERIVATIVE = re.compile(r"d(2?)_(.+)")


def series(name: str, channels: Collection[str] = ()) -> Series:
    """The series of a name; ``channels`` are names of channels, whatever they look like."""
    return ChannelName(name) if name in channels else _parse(name, frozenset(channels))


@cache
def _parse(name: str, channels: frozenset[str]) -> Series:
    if name in channels:
        return ChannelName(name)
    if (match := _RELAXATION.fullmatch(name)) is not None:
        return Relaxation(_parse(match[1], channels), match[2])
    if " " in name:
        return Product(tuple(_parse(x, channels) for x in name.split(" ")))
    if (match := _FUNCTION.fullmatch(name)) is not None:
        kind: FunctionName = "abs" if match[1] == "abs" else "sign" if match[1] == "sign" else "square"
        return Function(kind, _parse(match[2], channels))
    if (match := _DERIVATIVE.fullmatch(name)) is not None:
        return Derivative(ChannelName(match[2]), int(match[1] or 1))
    return ChannelName(name)


def list_channels(s: Series) -> tuple[str, ...]:
    """Names of the channels and forces at the bottom of a series."""
    if isinstance(s, Product):
        return tuple(n for x in s.of for n in list_channels(x))
    return (s.name,) if isinstance(s, ChannelName) else list_channels(s.of)


def harmonic(name: str) -> tuple[str, int]:
    """Function (cos, sin) and multiple of the disc angle of a harmonic: ``const`` (cos, 0), ``cos 2``, ``sin 1``."""
    function, _, multiple = name.partition(" ")
    return (function, int(multiple)) if multiple else ("cos", 0)
