"""Writes the page on the simplified model, for the documentation: Section II.B of the paper, computed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from derive.emit.render import number, render_page
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Collected
from derive.simplify import (
    DYNAMIC_EXPERIMENT,
    EOTVOS,
    G0,
    PAPER_ENVELOPE,
    Envelope,
    Size,
    certified_bound,
    ranges,
    simplified,
    sizes,
)
from derive.symbols import ACCELEROMETER, ANGLES, SECOND_ORDER

Row = tuple[str, ...]


def page() -> str:
    """The page on the simplified model, Markdown."""
    return render_page("derive.simplify", "simplified.md.j2", _context())


def _context() -> dict[str, Any]:
    terms = sizes(PAPER_ENVELOPE)
    kept = [s for s in terms if s.eotvos > PAPER_ENVELOPE.allotted]
    in_dynamic = [s for s in sizes(DYNAMIC_EXPERIMENT) if s.eotvos > DYNAMIC_EXPERIMENT.allotted]
    paper, dynamic = (replace(e, kinematics="full") for e in (PAPER_ENVELOPE, DYNAMIC_EXPERIMENT))
    models = (
        ("paper's, Eq. 42 to 47", PAPER_ENVELOPE, simplified()),
        ("dynamic experiment, Eq. 42 to 47", DYNAMIC_EXPERIMENT, simplified()),
        ("dynamic experiment, its own model", DYNAMIC_EXPERIMENT, simplified(DYNAMIC_EXPERIMENT)),
        ("full kinematics: paper's, Eq. 42 to 47", paper, simplified()),
        ("full kinematics: paper's, its own model", paper, simplified(paper)),
        ("full kinematics: dynamic experiment, its own model", dynamic, simplified(dynamic)),
    )
    return {
        "allotted": number(PAPER_ENVELOPE.allotted),
        "kept": str(len(kept)),
        "all": str(len(terms)),
        "smallest": number(min(s.eotvos for s in kept)),
        "largest": number(max(s.eotvos for s in terms if s.eotvos <= PAPER_ENVELOPE.allotted)),
        "envelope": _bounds(PAPER_ENVELOPE, DYNAMIC_EXPERIMENT),
        "terms": [
            (n, _terms(s for s in kept if s.harmonic == h)) for n, h in (("43", 2), ("45", 1), ("47", 0))
        ],
        "more": str(len(in_dynamic) - len(kept)),
        "bounds": [(title, *_bound(e, m)) for title, e, m in models],
        "paper_bound": number(sum(certified_bound(PAPER_ENVELOPE, simplified()).values())),
        "conditions": [r for c in critical_conditions(PAPER_ENVELOPE) for r in _condition(c)],
    }


def _terms(among: Iterable[Size]) -> list[Row]:
    """Combination, product and size; the largest first (equal sizes in the order of derivation)."""
    return [
        (f"${_combination(s)}$", f"${latex(s)}$", number(s.eotvos))
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


def _bounds(*envelopes: Envelope) -> list[Row]:
    """The bounds that bear units of their own, one row each."""
    g = G0
    quantities = (
        ("$a_x, a_y, a_z$", "g", "a", g),
        (r"$\omega_{imx}, \omega_{imy}, \omega_{imz}$", "rad/s", "omega", 1.0),
        (r"$\omega_{imax}, \omega_{imay}, \omega_{imaz}$", "rad/s^2", "omegadot", 1.0),
        (r"$\Gamma_{ik}$", "Eo", "Gamma", float(EOTVOS)),
        ("$R$", "m", "radius", 1.0),
        ("$dR$", "um", "dR", 1e-6),
        *((f"${q.latex}$", "rad", q.name, 1.0) for q in ACCELEROMETER if q.name in ANGLES),
        ("$K_0$", "ug", "K0", 1e-6 * g),
        *((f"${q.latex}$", "ug/g^2", q.name, 1e-6 / g) for q in ACCELEROMETER if q.name in SECOND_ORDER),
        ("imbalance $k_{j1} / k_1 - 1$", "1", "imbalance", 1.0),
    )
    return [
        (text, unit, *(_bound_text(getattr(e, name), scale) for e in envelopes))
        for text, unit, name, scale in quantities
    ]


def _bound_text(value: float | tuple[float, ...], unit: float) -> str:
    values = value if isinstance(value, tuple) else (value,)
    texts = [number(v / unit) for v in values]
    return texts[0] if len(set(texts)) == 1 else ", ".join(texts)


def _bound(envelope: Envelope, model: Collected) -> Row:
    shares = certified_bound(envelope, model)
    return (*(number(shares.get(n, 0.0)) for n in range(5)), number(sum(shares.values())))


def _condition(c: Condition) -> list[Row]:
    """One row for every critical value: where, term, quantity, printed, computed, unit."""
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
        for (what, value, unit), text in zip(values, c.kind.printed, strict=True)
        if text
    ]


MISALIGNMENTS = ("beta_x", "beta_z", "vartheta_y", "vartheta_z")
"""The angles of Section II.B.1."""


@dataclass(frozen=True)
class TermKind:
    """A kind of error term: powers of what its basic term is a product of (besides k1 and R).

    ``printed`` are the critical values as the paper has them: T_n in Eo, rate in deg/s, acceleration in deg/s^2, amplitude in
    deg/s; or a_n in g.
    """

    where: str
    term: str
    printed: tuple[str, ...]
    second_order: int = 0
    imbalance: int = 0
    angles: int = 0
    angular: int = 0
    linear: int = 0


@dataclass(frozen=True)
class AngularMotion:
    """Critical rate (rad/s), angular acceleration (rad/s^2) and amplitude of a rate at the spin frequency."""

    omega: float
    omegadot: float
    amplitude: float


@dataclass(frozen=True)
class Condition:
    """A kind of error term may be neglected while its motion stays below ``critical``.

    That is the critical T_n in s^-2 with the ``angular`` motion that it represents, or the critical
    acceleration in m/s^2 (``angular`` is ``None``). Infinite if the envelope has no such error.
    """

    kind: TermKind
    critical: float
    angular: AngularMotion | None


_ONE, _TWO, _THREE = r"\beta_{jn}", r"\beta_{jn_1} \beta_{jn_2}", r"\beta_{jn_1} \beta_{jn_2} \vartheta_{jm}"
_OF_T, _OF_A = "k_{j1} T_p R_j", "k_{j1} a_z"

KINDS = (
    TermKind(
        "Table I",
        "k_{jp} T_{n_1} T_{n_2} R_j^2",
        ("2e8", "12.74", "8.51", "5.424"),
        second_order=1,
        angular=2,
    ),
    TermKind("below Eq. 37", "k_{jp} a_{n_1} a_{n_2}", ("2e-3",), second_order=1, linear=2),
    TermKind("below Eq. 37a", "dk_{j1} a_n", ("4e-8",), imbalance=1, linear=1),
    TermKind(
        "Table II",
        "k_{jp} T_{n_1} R_j a_{n_2}",
        ("4e7", "5.734", "1.72", "1.09"),
        second_order=1,
        angular=1,
        linear=1,
    ),
    TermKind("Table III, row 1", f"{_ONE} {_OF_T}", ("4e3", "0.0574", "1.71e-4", ""), angles=1, angular=1),
    TermKind("Table III, row 2", f"{_TWO} {_OF_T}", ("4e7", "5.734", "1.72", ""), angles=2, angular=1),
    TermKind("Table III, row 3", f"{_THREE} {_OF_T}", ("4e11", "5724", "1.72e4", ""), angles=3, angular=1),
    TermKind("below Eq. 41, one angle", f"{_ONE} {_OF_A}", ("4e-8",), angles=1, linear=1),
    TermKind("below Eq. 41, two angles", f"{_TWO} {_OF_A}", ("4e-4",), angles=2, linear=1),
    TermKind("below Eq. 41, three angles", f"{_THREE} {_OF_A}", ("4",), angles=3, linear=1),
)
"""The kinds of Section II.B.1, in its order."""


def critical_conditions(envelope: Envelope) -> tuple[Condition, ...]:
    """The conditions of Section II.B.1 for an envelope: one for each of :data:`KINDS`.

    A basic term is one accelerometer's share of G_out over k_ggi, 1 / (4 R) of its specific force, as in
    Eq. 32 ("0.25"); it may reach ``envelope.allotted``. Of several parameters of a kind the largest counts.
    """
    return tuple(_condition_of(envelope, k) for k in KINDS)


def _condition_of(envelope: Envelope, kind: TermKind) -> Condition:
    share = (
        max(getattr(envelope, n) for n in SECOND_ORDER) ** kind.second_order
        * max(getattr(envelope, n) for n in MISALIGNMENTS) ** kind.angles
        * envelope.imbalance**kind.imbalance
        * envelope.radius**kind.angular
        / (4 * envelope.radius)
    )
    degree = kind.linear
    if kind.angular:
        share *= max(envelope.a) ** kind.linear
        degree = kind.angular
    allotted = envelope.allotted * float(EOTVOS)
    critical = (allotted / share) ** (1 / degree) if share else math.inf
    return Condition(kind, critical, critical_motion(critical, envelope) if kind.angular else None)


def critical_motion(T: float, envelope: Envelope) -> AngularMotion:
    """Eq. 33 solved for equal components, with T_1 ... T_6 of Eq. 16 without gradients; then Eq. 36, k = 1.

    The rate comes first: the largest at which no T_n exceeds ``T`` (s^-2) while it is steady. The angular
    acceleration is what may then be added.
    """
    of_omega, of_omegadot = dict(_unit("omega")), dict(_unit("omegadot"))
    if math.isinf(T):
        return AngularMotion(T, T, T)
    omega = min(math.sqrt(T / c) for c in of_omega.values() if c)
    omegadot = min((T - of_omega[n] * omega**2) / d for n, d in of_omegadot.items() if d)
    return AngularMotion(omega, omegadot, min(omega, omegadot / (2 * math.pi * envelope.spin_frequency)))


def _unit(kind: str) -> Iterator[tuple[str, float]]:
    """Largest T_1 ... T_6 while the components of one kind of motion are 1 and all else is at rest."""
    bounds = ranges(lambda channel: 1 if channel.partition("_")[0] == kind else 0)
    return ((n, float(b)) for n, b in bounds.items() if n.startswith("T_"))
