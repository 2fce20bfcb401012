"""Writes docs/simplified.md: Section II.B of the paper, computed. The same bytes for the same derivation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import jinja2

from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Collected, collect
from derive.simplify.bound import certified_bound
from derive.simplify.critical import Condition, critical_conditions
from derive.simplify.envelope import DYNAMIC_EXPERIMENT, EOTVOS, G0, PAPER_ENVELOPE, Envelope
from derive.simplify.extent import extent
from derive.simplify.of_order import order_bound
from derive.simplify.terms import Size, simplified, sizes
from derive.stages import EXACT, PAPER, Order
from derive.symbols import ACCELEROMETER, ANGLES, SECOND_ORDER

Row = tuple[str, ...]

_PRINTED: dict[str, tuple[str, ...]] = {
    "Table I": ("2e8", "12.74", "8.51", "5.424"),
    "below Eq. 37": ("2e-3",),
    "below Eq. 37a": ("4e-8",),
    "Table II": ("4e7", "5.734", "1.72", "1.09"),
    "Table III, row 1": ("4e3", "0.0574", "1.71e-4", ""),
    "Table III, row 2": ("4e7", "5.734", "1.72", ""),
    "Table III, row 3": ("4e11", "5724", "1.72e4", ""),
    "below Eq. 41, one angle": ("4e-8",),
    "below Eq. 41, two angles": ("4e-4",),
    "below Eq. 41, three angles": ("4",),
}
"""As printed: T_n in Eo, rate in deg/s, acceleration in deg/s^2, amplitude in deg/s; or a_n in g."""

_CATEGORIES = {
    "a": ("second-order coefficients, angular motion", "none"),
    "b": ("second-order coefficients, linear motion", "all"),
    "c": ("scale-factor imbalance, linear motion", "all"),
    "d": ("second-order coefficients, linear and angular motion", "none"),
    "e": ("misalignment, angular motion", "one angle"),
    "f": ("misalignment, linear motion", "up to two angles"),
    "": ("the signal, the null bias, and imbalance with angular motion", "all"),
}
"""The kinds of Section II.B.1 a) to f), and what the paper keeps of each."""


def page() -> str:
    """The page on the simplified model, Markdown."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("derive.simplify", "templates"),
        undefined=jinja2.StrictUndefined,
        autoescape=False,
        keep_trailing_newline=True,
    )
    return environment.get_template("simplified.md.j2").render(_context()).rstrip() + "\n"


def _context() -> dict[str, Any]:
    paper = sizes(PAPER_ENVELOPE)
    kept = [s for s in paper if _is_kept(s, PAPER_ENVELOPE)]
    second = Order(rotation=2, misalignment=2)
    dynamic = [
        s for s in sizes(DYNAMIC_EXPERIMENT) if _is_kept(s, DYNAMIC_EXPERIMENT) and not _named(s, kept)
    ]
    return {
        "allotted": number(PAPER_ENVELOPE.allotted),
        "kept": str(len(kept)),
        "all": str(len(paper)),
        "amplitudes": ", ".join(f"${_amplitude(n)}$" for n in simplified().amplitudes),
        "smallest": number(min(s.eotvos for s in kept)),
        "largest": number(max(s.eotvos for s in paper if not _is_kept(s, PAPER_ENVELOPE))),
        "envelope": _bounds(PAPER_ENVELOPE, DYNAMIC_EXPERIMENT),
        "numbers": _numbers(PAPER_ENVELOPE, DYNAMIC_EXPERIMENT),
        "terms": [
            (n, _terms(s for s in kept if s.harmonic == h)) for n, h in (("43", 2), ("45", 1), ("47", 0))
        ],
        "categories": _categories(paper),
        "extents": _extents(),
        "dynamic": _terms(dynamic),
        "dynamic_count": str(len(dynamic)),
        "dynamic_categories": ", ".join(sorted({category(s) for s in dynamic})),
        "acceleration": number(max(DYNAMIC_EXPERIMENT.omegadot)),
        "second": _terms(
            s
            for s in sizes(PAPER_ENVELOPE, collect(second))
            if _is_kept(s, PAPER_ENVELOPE) and not _named(s, kept)
        ),
        "bounds": _bounds_of_models(),
        "paper_bound": number(certified_bound(PAPER_ENVELOPE, simplified()).exact),
        "full": [
            (title, *_bound(e, m))
            for title, e, m in (
                ("paper's, Eq. 42 to 47", _in_full(PAPER_ENVELOPE), simplified()),
                ("paper's, its own model", _in_full(PAPER_ENVELOPE), simplified(_in_full(PAPER_ENVELOPE))),
                (
                    "dynamic experiment, its own model",
                    _in_full(DYNAMIC_EXPERIMENT),
                    simplified(_in_full(DYNAMIC_EXPERIMENT)),
                ),
            )
        ],
        "order": [
            (
                title,
                *(number(order_bound(_in_full(e), o).exact) for e in (PAPER_ENVELOPE, DYNAMIC_EXPERIMENT)),
            )
            for title, o in _LADDER
        ],
        "conditions": [r for c in critical_conditions(PAPER_ENVELOPE) for r in _condition(c)],
    }


_LADDER = (
    ("the paper's", PAPER),
    ("and angles in second-order terms", replace(PAPER, second_order_angles=True)),
    ("and misalignment exact", replace(EXACT, rotation=1)),
    ("and mounting to the second power", replace(EXACT, rotation=2)),
)
"""Orders of a model, each with one simplification less; the next is the exact one, which leaves nothing out."""


def _bounds_of_models() -> list[tuple[str, ...]]:
    models = (
        ("paper's, Eq. 42 to 47", PAPER_ENVELOPE, simplified()),
        ("dynamic experiment, Eq. 42 to 47", DYNAMIC_EXPERIMENT, simplified()),
        ("dynamic experiment, its own model", DYNAMIC_EXPERIMENT, simplified(DYNAMIC_EXPERIMENT)),
    )
    return [(title, *_bound(e, m)) for title, e, m in models]


def number(x: float | Fraction, digits: int = 3) -> str:
    """Significant digits; 4e6, not 4e+06; infinity in words."""
    if math.isinf(x):
        return "any"
    mantissa, e, exponent = f"{float(x):.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _is_kept(s: Size, envelope: Envelope) -> bool:
    return s.eotvos > Fraction(envelope.allotted)


def _named(s: Size, among: Iterable[Size]) -> bool:
    return any((s.harmonic, s.motion, s.parameters) == (o.harmonic, o.motion, o.parameters) for o in among)


def _terms(among: Iterable[Size]) -> list[Row]:
    """Harmonic, combination, product and size; the largest first (equal sizes in the order of derivation)."""
    return [
        (str(s.harmonic), f"${_combination(s)}$", f"${latex(s)}$", number(s.eotvos))
        for s in sorted(among, key=lambda s: -s.eotvos)
    ]


def _combination(s: Size) -> str:
    return {0: "D^{1234}", 2: r"\sum", 4: "D^{1234}"}.get(s.harmonic, "D^{12}, D^{34}")


def latex(s: Size) -> str:
    """Parameters and motion of a term, in the paper's symbols: K_jp k_j1 is its k_jp (Eq. 6a)."""
    symbols = {q.name: q.latex for q in ACCELEROMETER} | {"k1": "k_1", "R": "R"}
    parameters = [
        (symbols[n].lower() if n.startswith("K") else symbols[n], p)
        for n, p in zip(COEFFICIENT_PARAMETERS, s.parameters, strict=True)
        if p
    ]
    if any(n.startswith("k_") and n != "k_1" for n, _ in parameters):
        parameters.remove(("k_1", 1))
    parameters.sort(key=lambda f: (f[0] == "R", not f[0].startswith("\\")))
    motion = [(n, p) for n, p in zip(MOTION_NUMBERS, s.motion, strict=True) if p]
    return " ".join(n if p == 1 else f"{n}^{p}" for n, p in (*parameters, *motion))


def _amplitude(name: str) -> str:
    return "A_0" if name == "A_0" else rf"A_{{{name[2:-1].replace('1', '')}\Omega}}^{name[-1]}"


def category(s: Size) -> str:
    """The category of Section II.B.1 that a term belongs to, "a" to "f"; "" for what it does not discuss."""
    powers = dict(zip(COEFFICIENT_PARAMETERS, s.parameters, strict=True))
    linear, angular = any(s.motion[:3]), any(s.motion[3:])
    if any(powers[n] for n in SECOND_ORDER):
        return "d" if linear and angular else "a" if angular else "b"
    if any(powers[n] for n in ANGLES):
        return "e" if angular else "f"
    return "c" if linear else ""


def _categories(among: Sequence[Size]) -> list[Row]:
    rows: list[Row] = []
    for c, (title, printed) in _CATEGORIES.items():
        of_kind = [s for s in among if category(s) == c]
        kept = [s.eotvos for s in of_kind if _is_kept(s, PAPER_ENVELOPE)]
        left = [s.eotvos for s in of_kind if not _is_kept(s, PAPER_ENVELOPE)]
        share = f"{len(kept)} of {len(of_kind)}"
        least, most = (number(min(kept)) if kept else ""), (number(max(left)) if left else "")
        rows.append((c, title, printed, share, least, most))
    return rows


def _bounds(*envelopes: Envelope) -> list[Row]:
    """The bounds that bear units of their own, one row each."""
    g, ug = G0, 1e-6 * G0
    quantities = (
        (r"$\lvert a_x\rvert, \lvert a_y\rvert, \lvert a_z\rvert$", "g", "a", g),
        (
            r"$\lvert\omega_{imx}\rvert, \lvert\omega_{imy}\rvert, \lvert\omega_{imz}\rvert$",
            "rad/s",
            "omega",
            1.0,
        ),
        (
            r"$\lvert\omega_{imax}\rvert, \lvert\omega_{imay}\rvert, \lvert\omega_{imaz}\rvert$",
            "rad/s^2",
            "omegadot",
            1.0,
        ),
        (r"$\lvert\Gamma_{ik}\rvert$", "Eo", "Gamma", float(EOTVOS)),
        ("$R$", "m", "radius", 1.0),
        (r"$\lvert dR\rvert$", "um", "dR", 1e-6),
        *((rf"$\lvert{q.latex}\rvert$", "rad", q.name, 1.0) for q in ACCELEROMETER if q.name in ANGLES),
        (r"$\lvert K_0\rvert$", "ug", "K0", ug),
        *(
            (rf"$\lvert {q.latex}\rvert$", "ug/g^2", q.name, 1e-6 / g)
            for q in ACCELEROMETER
            if q.name in SECOND_ORDER
        ),
        (r"imbalance $\lvert k_{j1} / k_1 - 1\rvert$", "1", "imbalance", 1.0),
    )
    return [
        (text, unit, *(_bound_text(getattr(e, name), scale) for e in envelopes))
        for text, unit, name, scale in quantities
    ]


def _bound_text(value: float | tuple[float, ...], unit: float) -> str:
    values = value if isinstance(value, tuple) else (value,)
    texts = [number(v / unit) for v in values]
    return texts[0] if len(set(texts)) == 1 else ", ".join(texts)


def _numbers(*envelopes: Envelope) -> list[Row]:
    """T and S at most, Eo."""
    bounds = [e.motion() for e in envelopes]
    return [
        (f"${n}$", *(number(b[n] / EOTVOS) for b in bounds)) for n in MOTION_NUMBERS if not n.startswith("a_")
    ]


def _extents() -> list[Row]:
    """How far each bound of the paper's envelope may move while Eq. 42-47 remain the simplified model."""
    e = PAPER_ENVELOPE
    rows = (
        ("$a$", "g", ("a",), e.a[0] / G0),
        (r"$\omega_{im}$", "rad/s", ("omega",), e.omega[0]),
        (r"$\dot\omega_{im}$", "rad/s^2", ("omegadot",), e.omegadot[0]),
        (r"$\Gamma$", "Eo", ("Gamma",), e.Gamma / float(EOTVOS)),
        (r"all $\beta$ and $\vartheta$", "rad", ANGLES, e.beta_x),
        ("all $K_2$ ... $K_8$", "ug/g^2", SECOND_ORDER, e.K2 * G0 * 1e6),
        ("imbalance", "1", ("imbalance",), e.imbalance),
        ("error allotted", "Eo", ("allotted",), e.allotted),
    )
    result: list[Row] = []
    for text, unit, names, value in rows:
        low, high = extent(e, names)
        result.append(
            (
                text,
                unit,
                number(value),
                *(("any" if f in (0.0, math.inf) else number(value * f)) for f in (low, high)),
            )
        )
    return result


def _in_full(envelope: Envelope) -> Envelope:
    """The envelope of an instrument that feels its disc turn, at a steady rate."""
    return replace(envelope, kinematics="full")


def _bound(envelope: Envelope, model: Collected, full: Collected | None = None) -> Row:
    certificate = certified_bound(envelope, model, full)
    return (*(number(certificate.harmonics.get(n, Fraction(0))) for n in range(5)), number(certificate.exact))


def _condition(c: Condition) -> list[Row]:
    """One row for every critical value: where, term, quantity, printed, computed, unit."""
    printed = _PRINTED[c.kind.where]
    if c.angular is None:
        values = [("$a_n$", c.critical / G0, "g")]
    else:
        values = [
            ("$T_n$", c.critical / float(EOTVOS), "Eo"),
            (r"$\omega_{critical}$", math.degrees(c.angular.omega), "deg/s"),
            (r"$\dot\omega_{critical}$", math.degrees(c.angular.omegadot), "deg/s^2"),
            (r"$A_{\Omega critical}$", math.degrees(c.angular.amplitude), "deg/s"),
        ]
    return [
        (c.kind.where, f"${c.kind.term}$", what, text, number(value), unit)
        for (what, value, unit), text in zip(values, printed, strict=True)
        if text
    ]
