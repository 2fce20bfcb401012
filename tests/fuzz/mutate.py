"""Seeded mutations of texts and files, for where no coverage-guided fuzzer is at hand."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Sequence

_TEXT = """
    K K_x c f_i f_o f_p a_x omega_z temperature time cos_phi + - * / ** ( ) [ ] { } , . = : ; # " ' \\ | & % @ ~
    abs( sin( exp( sqrt( sign( tanh( **2 **8 **9 1e30 1e-30 1e308 1e-400 0x10 1_0 0 -0 00 .5 5. inf -inf nan NaN
    9223372036854775808 123456789012345678901234567890 True None lambda if else not in and __class__ __import__
    effects effects_folder disc accelerometers radius spin_frequency g0 K0 K1 K2 k_VI dR [[effects]] [disc]
    [accelerometers] id stage add params value unit plausible shared lag gain-step transducer "mine" "9.8 m/s^2"
    "1 g" ug/g^2 mA/g 1/K Eo deg/h degC delta_degC m**2 m^99 "m/s" "" '''x''' \"\"\" 1979-05-27T07:32:00Z 0b1 0o7
    [s] [g] [V] [Eo] [rad/s] [] [1] time, ,, ;; G_out V_1 inline spin_angle null NA -1 1e400 PAR1 units \u00e9 \u202e
    \ud800 \U0001f4a9 true false null {} [] -1 1e999 "steps" "removed" "../victim" "/etc/passwd" "model.toml/x" "." ".." "a/../b"
    "version" 1.5 99 [time] [columns] [axes] [file] [demodulator] column format origin sign scale offset "seconds" "iso" "clock"
    "gps" "?" 2026-03-01 23:59:60 9999-12-31T23:59:59+14:00 0001-01-01T00:00:00Z "kind" "ragg" "verdict" "calibrations"
    """
WORDS: tuple[bytes, ...] = (
    *(word.encode("utf-8", "surrogatepass") for word in re.findall(r"\S+", _TEXT)),
    *(
        b"\n",
        b"\r",
        b"\t",
        b"\0",
        b"\xff",
        b"\xef\xbb\xbf",
        b"\x1f\x8b",
        b"1" * 5000,
        b"(" * 300,
        b"[" * 3000,
        b"9" * 700,
    ),
)
_NUMBERS = (b"0", b"-1", b"255", b"65536", b"2147483648", b"1e999", b"-0.0", b"1e-320", b"nan")


def mutants(seeds: Sequence[bytes], seed: int, *, longest: int = 1 << 16) -> Iterator[bytes]:
    """Endless mutants of the seeds, the same for the same ``seed``."""
    chance = random.Random(seed)
    while True:
        data = bytearray(chance.choice(seeds))
        for _ in range(1 + min(int(chance.expovariate(0.6)), 12)):
            _mutate(data, chance, seeds)
        yield bytes(data[:longest])


def _mutate(data: bytearray, chance: random.Random, seeds: Sequence[bytes]) -> None:
    at = chance.randrange(len(data) + 1)
    size = min(1 + int(chance.expovariate(0.1)), len(data) - at)
    kind = chance.randrange(9)
    if kind == 0:
        del data[at : at + size]
    elif kind == 1:
        data[at:at] = data[at : at + size] * chance.randrange(1, 4)
    elif kind in (2, 3):
        data[at:at] = chance.choice(WORDS)
    elif kind == 4:
        data[at : at + size] = chance.choice(WORDS)
    elif kind == 5 and at < len(data):
        data[at] ^= 1 << chance.randrange(8)
    elif kind == 6 and at < len(data):
        data[at] = chance.choice((0, 1, 127, 128, 255, chance.randrange(256)))
    elif kind == 7:
        other = chance.choice(seeds)
        start = chance.randrange(len(other) + 1)
        data[at : at + size] = other[start : start + 1 + int(chance.expovariate(0.02))]
    elif kind == 8:
        _number(data, at, chance)


def _number(data: bytearray, at: int, chance: random.Random) -> None:
    """Put another number in the place of the next one."""
    digits = b"0123456789"
    while at < len(data) and data[at] not in digits:
        at += 1
    end = at
    while end < len(data) and data[end] in digits:
        end += 1
    data[at:end] = chance.choice(_NUMBERS)
