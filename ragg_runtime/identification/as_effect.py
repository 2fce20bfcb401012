"""A generic term as an effect of the user's own: a line for ``effects`` in model.toml, and what the flight must have for it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import comb

from ragg_runtime.base import series_name
from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Relaxation, Series
from ragg_runtime.identification.dictionary import Term
from ragg_runtime.identification.features import OUTPUT
from ragg_runtime.io.record import RATES

_FUNCTIONS = {"abs": "absolute value", "sign": "sign", "square": "square"}
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")


def line(term: Term, centre: Mapping[str, float], unit: str) -> str | None:
    """The effect as one line of model.toml; ``None`` if a channel's name is not possible in an expression, or it is made of the output.

    ``centre`` are the means that auxiliary channels enter less; ``unit`` is that of the term's channels.
    """
    factors: list[str] = []
    if any(series_name.channel(series_name.series(n)) == OUTPUT for n in term.channels):
        return None  # no stage sees the output
    for name in dict.fromkeys(term.channels):
        text = _written(series_name.series(name))
        if text is None:
            return None
        n = term.channels.count(name)
        if n > 1 and name in centre:  # the square of a temperature in K would be all but a multiple of it
            text = f"({text} - {centre[name]:.6g})" if centre[name] > 0 else f"({text} + {-centre[name]:.6g})"
        factors.append(text if n == 1 else f"{text}**{n}")
    product = "*".join(("K_x", *factors, *_carrier(term.harmonic)))
    return f'{{ id = "my-effect", stage = "transducer", add = "{product}", K_x = {{ unit = "{unit}" }} }}'


def columns(term: Term) -> list[str]:
    """In words: the columns that a flight must have for :func:`line`, since an expression has only the values of one instant."""
    found = {}
    for name in term.channels:
        s = series_name.series(name)
        while isinstance(s, Function):
            s = s.of
        if not isinstance(s, ChannelName) and str(s) not in RATES:
            found[_column(s)] = f"{_column(s)} ({in_words(s)})"
    return list(found.values())


def in_words(s: Series) -> str:
    """What a series is."""
    match s:
        case ChannelName(name):
            return name
        case Derivative(of, order):
            return f"{'second ' if order == 2 else ''}time derivative of {of}"
        case Function(name, of):
            return f"{_FUNCTIONS[name]} of {in_words(of)}"
        case Relaxation(of, seconds):
            return f"{in_words(of)} through a relaxation of {seconds} s"


def _column(s: Series) -> str:
    """Name for a column of the flight that holds a series which no expression can form."""
    if isinstance(s, Relaxation):
        return "slow_" + str(s.of).replace("(", "_").replace(")", "")
    return str(s)


def _written(s: Series) -> str | None:
    if isinstance(s, Function):
        inner = _written(s.of)
        return None if inner is None else f"{s.name}({inner})"
    text = _column(s)
    return text if _NAME.fullmatch(text) else None


def _carrier(name: str) -> tuple[str, ...]:
    """A harmonic of the disc angle as a polynomial in cos_phi and sin_phi (de Moivre)."""
    h = series_name.harmonic(name)
    k = h.multiple
    if not k:
        return ()
    terms = []
    # powers of i sin phi: real for cos, imaginary for sin
    for n in range(0 if h.function == "cos" else 1, k + 1, 2):
        factor = comb(k, n) * (-1) ** (n // 2)
        powers = [f"{name}**{e}" if e > 1 else name for name, e in (("cos_phi", k - n), ("sin_phi", n)) if e]
        terms.append("*".join([*([] if factor == 1 else [str(factor)]), *powers]))
    return (terms[0],) if len(terms) == 1 else (f"({' + '.join(terms)})",)
