"""A generic term as an effect of the user's own: a line for ``effects`` in model.toml, and what the flight must have for it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import comb

from ragg_runtime.lack_of_fit import features
from ragg_runtime.lack_of_fit.dictionary import Term

_FUNCTIONS = {"abs": "absolute value", "sign": "sign", "square": "square"}
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")


def line(term: Term, centre: Mapping[str, float], unit: str) -> str | None:
    """The effect as one line of model.toml; ``None`` if a channel's name cannot stand in an expression.

    ``centre`` are the means that auxiliary channels enter less; ``unit`` is that of the term's channels.
    """
    factors: list[str] = []
    for name in dict.fromkeys(term.channels):
        text = _written(name)
        if text is None:
            return None
        n = term.channels.count(name)
        if n > 1 and name in centre:  # the square of a temperature in K would be all but a multiple of it
            text = f"({text} - {centre[name]:.6g})" if centre[name] > 0 else f"({text} + {-centre[name]:.6g})"
        factors.append(text if n == 1 else f"{text}**{n}")
    product = "*".join(("K_x", *factors, *_carrier(term.harmonic)))
    return f'{{ id = "my-effect", stage = "transducer", add = "{product}", K_x = {{ unit = "{unit}" }} }}'


def columns(term: Term) -> list[str]:
    """In words: the columns that a flight must have for :func:`line`, since an expression knows only the moment."""
    found = {}
    for name in term.channels:
        for inner in _inner(name):
            if (own := _column(inner)) is not None:
                found[own] = f"{own} ({in_words(inner)})"
    return list(found.values())


def in_words(name: str) -> str:
    """What a series is, of any name in :mod:`ragg_runtime.lack_of_fit.features`."""
    if (slow := features.SLOW.fullmatch(name)) is not None:
        return f"{in_words(slow['of'])} through a relaxation of {slow['seconds']} s"
    if (call := features.FUNCTION.fullmatch(name)) is not None:
        return f"{_FUNCTIONS[call[1]]} of {in_words(call['of'])}"
    if (rate := features.DERIVATIVE.fullmatch(name)) is not None:
        return f"{'second ' if name.startswith('d2_') else ''}time derivative of {rate['of']}"
    return name


def _inner(name: str) -> Sequence[str]:
    call = features.FUNCTION.fullmatch(name)
    return (name,) if call is None else _inner(call["of"])


def _column(name: str) -> str | None:
    """Name for a column of the flight that holds a series which no expression can form."""
    if (slow := features.SLOW.fullmatch(name)) is not None:
        return "slow_" + slow["of"].replace("(", "_").replace(")", "")
    return name if features.DERIVATIVE.fullmatch(name) else None


def _written(name: str) -> str | None:
    if (call := features.FUNCTION.fullmatch(name)) is not None:
        inner = _written(call["of"])
        return None if inner is None else f"{call[1]}({inner})"
    text = _column(name) or name
    return text if _NAME.fullmatch(text) else None


def _carrier(harmonic: str) -> tuple[str, ...]:
    """A harmonic of the disc angle as a polynomial in cos_phi and sin_phi (de Moivre)."""
    if harmonic == "const":
        return ()
    kind, multiple = harmonic.split()
    k = int(multiple)
    terms = []
    # powers of i sin phi: real for cos, imaginary for sin
    for n in range(0 if kind == "cos" else 1, k + 1, 2):
        factor = comb(k, n) * (-1) ** (n // 2)
        powers = [f"{name}**{e}" if e > 1 else name for name, e in (("cos_phi", k - n), ("sin_phi", n)) if e]
        terms.append("*".join([*([] if factor == 1 else [str(factor)]), *powers]))
    return (terms[0],) if len(terms) == 1 else (f"({' + '.join(terms)})",)
