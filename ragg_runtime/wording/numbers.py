"""Numbers, units and names as a reader wants them: few digits, true minus signs, powers of ten, no markup."""

from __future__ import annotations

import math
import re
import unicodedata
from collections import Counter
from collections.abc import Sequence

from ragg_runtime.base.series_name import (
    ChannelName,
    Derivative,
    Function,
    Product,
    Relaxation,
    Series,
    series,
)

THIN = "\u202f"
NO_BREAK = "\u00a0"
MINUS = "\u2212"
ABSENT = "\u2013"

_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_FORBIDDEN = frozenset(("Cc", "Cs", "Co", "Cn"))
_DIRECTION = frozenset("\u200e\u200f\u061c\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")


def clean(text: str) -> str:
    """``text`` from files without control characters, half surrogates and marks that reverse the line."""
    return "".join(
        "\ufffd" if (unicodedata.category(c) in _FORBIDDEN and c not in "\n\t") or c in _DIRECTION else c
        for c in text
    )


def short(text: str, length: int = 40) -> str:
    """One clean line of at most ``length`` characters, for labels inside a figure."""
    line = " ".join(clean(text).split())
    return line if len(line) <= length else line[: length - 1] + "…"


def power(exponent: int) -> str:
    """10 to an integer power."""
    return "10" + str(exponent).translate(_SUPERSCRIPTS)


def number(x: float | None, digits: int = 3) -> str:
    """``digits`` significant digits; an en dash for NaN and None."""
    if x is None or math.isnan(x):
        return ABSENT
    if math.isinf(x):
        return "∞" if x > 0 else f"{MINUS}∞"
    if x == 0.0:
        return "0"
    x = float(f"{x:.{digits - 1}e}")
    exponent = math.floor(math.log10(abs(x)))
    if -3 <= exponent < 6:
        return fixed(x, max(0, digits - 1 - exponent))
    return f"{fixed(x / 10.0**exponent, digits - 1)}{THIN}×{THIN}{power(exponent)}"


def fixed(x: float, decimals: int) -> str:
    """Fixed-point text with groups of three before the point from 10 000 on."""
    text = f"{abs(x):.{decimals}f}"
    if abs(x) >= 1e4:
        integer, _, rest = text.partition(".")
        text = f"{int(integer):,}".replace(",", THIN) + (f".{rest}" if rest else "")
    return (MINUS if x < 0 and float(text.replace(THIN, "")) != 0.0 else "") + text


def plus_minus(value: float, std: float) -> str:
    """Value and uncertainty to two digits of the latter: 12.3 ± 4.5, or 12.345678(45) where many digits are known."""
    if not (math.isfinite(value) and math.isfinite(std) and std > 0.0):
        return number(value, 4)
    exponent = math.floor(math.log10(max(abs(value), std)))
    scale = 0 if -3 <= exponent < 6 else exponent
    v, s = value / 10.0**scale, float(f"{std / 10.0**scale:.1e}")
    decimals = min(max(0, 1 - math.floor(math.log10(s))), 15)
    if decimals >= 6:
        text = f"{fixed(v, decimals)}({s * 10.0**decimals:.0f})"
    else:
        text = f"{fixed(v, decimals)}{THIN}±{THIN}{fixed(s, decimals)}"
        text = f"({text})" if scale else text
    return f"{text}{THIN}×{THIN}{power(scale)}" if scale else text


LEAST_P = -16.0  # log10 of the least p-value that is written: below it the figure says no more


def probability(log10_p: float | None) -> str:
    """A p-value from its decimal logarithm: ``0.03``, ``2 × 10⁻⁷``, ``< 10⁻¹⁶``; of ``None`` (certain) as well."""
    if log10_p is None or log10_p < LEAST_P:
        return f"<{THIN}{power(round(LEAST_P))}"
    return number(10.0**log10_p, 2) if log10_p > -3.0 else number(10.0**log10_p, 1)


def equate_probability(log10_p: float | None) -> str:
    """The same after its symbol, in one line: ``p = 0.03``, ``p < 10⁻¹⁶``."""
    text = probability(log10_p)
    return f"p{NO_BREAK}{'' if text.startswith('<') else f'={NO_BREAK}'}{text}"


def plain(x: float, digits: int = 6) -> str:
    """At most ``digits`` significant digits, without trailing zeros."""
    if not math.isfinite(x):
        return number(x)
    text = f"{x:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa.replace('-', MINUS)}{THIN}×{THIN}{power(int(exponent))}"
    return text.replace("-", MINUS)


def percent(share: float) -> str:
    return f"{number(100.0 * share, 2)}{THIN}%"


_ASCII = str.maketrans(
    {
        MINUS: "-", THIN: " ", ABSENT: "-", "±": "+-", "×": "x", "·": "*", "→": "->", "µ": "u", "∞": "inf", "…": "...", "’": "'",
        NO_BREAK: " ", "σ": " sigma", "Σ": "Sigma", "ω": "omega", "Ω": "Omega", "χ": "chi", "ϑ": "vartheta", "β": "beta", "Γ": "Gamma",
        **{c: f"^{n}" for n, c in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")},
    }
)  # fmt: skip


def to_ascii(text: str) -> str:
    """The same text as a terminal shows it: ``(5.98 ± 0.05) × 10⁻⁸`` is ``(5.98 +- 0.05)e-8``."""

    def exponent(match: re.Match[str]) -> str:
        digits = "".join("-" if c == "⁻" else str("⁰¹²³⁴⁵⁶⁷⁸⁹".index(c)) for c in match[2])
        return f"{'' if match[1] else '1'}e{digits}"

    text = re.sub(rf"({THIN}×{THIN})?(?<![\d.])10([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)", exponent, text)
    text = re.sub(rf"(?<=\d){THIN}(?=\d{{3}}(?!\d))", "", text)
    text = (
        re.sub(r"√(\w+)", r"sqrt(\1)", text).replace("Ωt", "Ω t").replace(f"{THIN}σ", "σ").replace(" σ", "σ")
    )
    return re.sub(r"(?<=\d)(?=Ω)", " ", text).translate(_ASCII)


def unit(text: str) -> str:
    """A unit as printed: µ, superscripts, centred dots; nothing for dimension one."""
    if text in ("1", ""):
        return ""
    text = re.sub(r"\bu(?=(g|m|s|V|rad)\b)", "µ", clean(text))
    text = re.sub(r"(?:\^|\*\*)(-?\d+)", lambda m: m[1].translate(_SUPERSCRIPTS), text)
    return text.replace("*", "·")


def unit_of_term(text: str) -> str:
    """A unit such as ``V/(m/s^2*((m/s^2)^2)*K)`` with equal factors gathered: V/((m/s²)³·K)."""
    match = re.fullmatch(r"V/\((.*)\)", text)
    if match is None:
        return unit(text)
    squared = re.sub(r"\(([^()]*)\)\^2", r"\1*\1", match[1])
    factors, parts = Counter(x for x in re.sub("[()]", "", squared).split("*") if x != "1"), []
    for factor, n in factors.items():
        symbol, several = unit(factor), n > 1 or len(factors) > 1
        power = str(n).translate(_SUPERSCRIPTS) if n > 1 else ""
        parts.append(f"({symbol}){power}" if "/" in symbol and several else f"{symbol}{power}")
    product = "·".join(parts)
    if not parts:
        return "V"
    bare = len(parts) == 1 and ("/" not in product or product[0] == "(")
    return f"V/{product}" if bare else f"V/({product})"


def with_unit(text: str, unit_: str) -> str:
    symbol = unit(unit_)
    return f"{text}{THIN}{symbol}" if symbol else text


def harmonic(name: str) -> str:
    """``cos 2`` as cos 2Ωt."""
    kind, _, k = name.partition(" ")
    if kind == "line":
        return f"line at {k}"
    return "constant" if not k else f"{kind} {'' if k == '1' else k}Ωt"


def product(name: str) -> str:
    """``a_x*omegadot_y`` as a_x · dω_y/dt, ``f_i*f_i`` as f_i²; ``1`` as it is."""
    factors = clean(name).split("*")
    powers = [(c, factors.count(c)) for c in dict.fromkeys(factors)]
    return " · ".join(
        _write_channel(series(c)) + ("" if n == 1 else str(n).translate(_SUPERSCRIPTS)) for c, n in powers
    )


def _write_channel(s: Series) -> str:
    match s:
        case Product(factors):
            return f"({' · '.join(_write_channel(x) for x in factors)})"
        case Relaxation(of, seconds):
            return f"{_write_channel(of)} relaxing in {seconds}{THIN}s"
        case Function(name, of):
            inner = _write_channel(of)
            return {"abs": f"|{inner}|", "sign": f"sign({inner})", "square": f"{inner}²"}[name]
        case Derivative(of, order):
            return _write_derivative(of.name, order)
        case ChannelName(name):
            return _write_derivative(name, 0)


def _write_derivative(name: str, order: int) -> str:
    """A derivative of a channel by time; the angular acceleration is itself one of the angular rate."""
    match = _MOTION.fullmatch(name)
    if match is None:
        text = name
    else:
        text = f"{'ω' if match[1].startswith('omega') else match[1]}_{match[2]}"
        order += match[1] == "omegadot"
    return text if not order else f"d{text}/dt" if order == 1 else f"d²{text}/dt²"


_MOTION = re.compile(r"(a|omega|omegadot|f)_([xyzio])")


def join_names(names: Sequence[str], conjunction: str = "and") -> str:
    """``a, b and c``."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {conjunction} {names[-1]}"


def seconds(x: float) -> str:
    """A duration in the unit that suits it."""
    if x < 120.0:
        return f"{number(x)}{THIN}s"
    return f"{number(x / 60.0)}{THIN}min" if x < 7200.0 else f"{number(x / 3600.0)}{THIN}h"


def hertz(x: float) -> str:
    """A sampling rate or a spin rate, the same wherever it is shown: ``16 Hz``, ``99.998 Hz``."""
    return f"{plain(x, 5)}{THIN}Hz"


def parameter(name: str) -> str:
    """A parameter of model.toml as it is written: ``dK1_dT`` is dK1/dT."""
    return re.sub(r"^(d[A-Za-z0-9]+)_(d[A-Za-z])", r"\1/\2", clean(name))


_OPERATORS = {
    "leftarrow": " <- ", "times": " x ", "cdot": " . ", "ge": " >= ", "to": " -> ", "partial": "d", "langle": "<", "rangle": ">",
}  # fmt: skip


def equation(latex: str) -> str:
    """An equation of the catalogue as a line of plain text: ``K_1 <- K_1 (1 + d_T K_1 (T - 293.15 K))``; dots are primes."""
    text = re.sub(r"(?<=[A-Za-z0-9)}])\\(?=[a-zA-Z])", r" \\", clean(latex))
    text = re.sub(r"\\(?:bm|mathrm|operatorname|text)\b\s*", "", text)
    text = re.sub(r"\\mathrel\{(.)\}", r"\1", text)
    text = re.sub(r"\\tfrac(\d)(\d)", r"\1/\2", text)
    dotted = r"\\(d?dot)\s*(\{[^}]*\}|\\[a-zA-Z]+|\w)"
    text = re.sub(dotted, lambda m: m[2] + ("''" if m[1] == "ddot" else "'"), text)
    text = re.sub(r"\\([A-Za-z]+)", lambda m: _OPERATORS.get(m[1], m[1]), text)
    return " ".join(re.sub(r"\\.|[{}]", lambda m: "" if m[0] in "{}" else " ", text).split())
