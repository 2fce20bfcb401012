"""Writes the audit as a page (docs/errata.md): Markdown, the same bytes for the same derivation."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import fields
from typing import Any

import jinja2

from derive.audit import numbers, text
from derive.audit.conventions import CHOSEN, Convention, Score
from derive.audit.experiment import EOTVOS, TABLE_VI, Cost
from derive.audit.notation import amplitude, latex, rational
from derive.audit.result import PROOF_POINTS, Audit, Erratum, audit

Row = tuple[str, ...]

_TITLES = {
    "tilt": "tilt of the triad where $\\beta_x$ lifts the position",
    "axial": "direction of $\\tau_z$",
    "composition": "composition of the mounting rotations",
    "rotation": "order of the rotations",
    "powers": "powers of $\\beta_z$ kept",
    "matrix": "matrix C in Eq. 18 and 19",
    "theta": "meaning of $\\theta$",
    "laplace": "Laplace's equation, for $\\omega_{im}^2$ in $A_0$",
}
_WORDS = {
    "dips": "$\\tau_y = e_r' - \\beta_x e_z$, against the position",
    "rises": "$\\tau_y = e_r' + \\beta_x e_z$, with the position",
    "none": "$\\tau_y = e_r'$",
    "down": "$-e_z$: right-handed, x tangential, y radial",
    "up": "$+e_z$",
    "beta_z outermost": "$\\beta_z$ outermost",
    "beta_x outermost": "$\\beta_x$ outermost",
    "second order, multiplied out": "second order, multiplied out, all powers",
    "beta_z once": "the first only",
    "composed": "composed, as in Eq. 5b",
    "k1 vartheta": "$k_1\\vartheta$ (Eq. 6a)",
    "vartheta": "$\\vartheta$",
    "Gamma_ij": "$\\Gamma_{xx}$, $\\Gamma_{xy}$ ...",
    "-Gamma_ij": "$-\\Gamma_{xx}$, $-\\Gamma_{xy}$ ...",
}
_RULES = {
    "a": "second-order coefficients with angular motion",
    "d": "second-order coefficients with linear and angular motion",
    "e": "misalignment with angular motion, more than one angle",
    "f": "misalignment with linear motion, more than two angles",
    "": "all of them",
}
QUOTED_DIFFERENCE = (-2.9 + 0.72, -0.99 - 0.56)
"""Section III.B: simplified minus analytical, inline and cross, Eo."""


def page() -> str:
    """The page of errata, Markdown."""
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("derive.audit", "templates"),
        undefined=jinja2.StrictUndefined,
        autoescape=False,
        keep_trailing_newline=True,
        trim_blocks=False,
    )
    rendered = environment.get_template("errata.md.j2").render(_context(audit()))
    return rendered.rstrip() + "\n"


def _context(a: Audit) -> dict[str, Any]:
    tilt = next(d.cost for d in a.departures if d.convention.tilt == "rises")
    second = next(d.cost for d in a.departures if d.convention.rotation.startswith("second"))
    cost = {n.rule: n.cost for n in a.neglected}
    rate = math.radians(sum(TABLE_VI["omega_y"][1:]) / 3600) * numbers.SPIN
    return {
        "summary": _summary(a),
        "confirmed": str(a.confirmed),
        "printed": str(a.printed),
        "wrong": str(a.wrong),
        "worst_erratum": _number(
            max(
                (max(e.cost.rms, abs(e.cost.inline), abs(e.cost.cross)) for e in a.errata if e.cost),
                default=0.0,
            )
        ),
        "tilt": _cost(tilt),
        "second": _cost(second),
        "shifted": _cost(a.tilt_after_shift),
        "rule_d": _cost(cost["d"]),
        "proof_points": str(PROOF_POINTS),
        "proof_verdict": "All differences are exactly 0." if a.proved else "**A difference is not 0.**",
        "chosen": [(_TITLES[f.name], _words(getattr(CHOSEN, f.name))) for f in fields(Convention)],
        "departures": _departures(a),
        "geometry_count": str(len(a.geometries)),
        "geometries": [
            (_words(v.tilt), _words(v.axial), _words(v.composition), v.rotation, *_score(s))
            for v, s in a.geometries[:6]
        ],
        "transducer": [(n, *_score(s)) for n, s in a.transducer],
        "motion": [(_words(n), *_score(s)) for n, s in a.motion],
        "errata": [_erratum(e) for e in a.errata],
        "beyond": [(f"${amplitude(b.amplitude)}$", f"${latex(b.terms)}$", *_costs(b.cost)) for b in a.beyond],
        "simplified": ", ".join(f"${amplitude(n)}$" for n in a.simplified_amplitudes),
        "neglected": [
            (n.rule, _RULES[n.rule], str(n.terms), *_costs(n.cost)) for n in a.neglected if n.terms
        ],
        "simplified_cost": _cost(cost[""]),
        "length": _number(math.hypot(cost[""].inline / 2, cost[""].cross)),
        "quoted_length": _number(math.hypot(QUOTED_DIFFERENCE[0] / 2, QUOTED_DIFFERENCE[1])),
        "quoted_halved": _number(math.hypot(*QUOTED_DIFFERENCE)),
        "right_T": _number(numbers.T_D / EOTVOS),
        "limit": _number(math.degrees(numbers.T_D)),
        "reached": _number(math.degrees(rate)),
        "slips": _remarks(text.slips()),
        **_numbers(a),
        "remarks": _remarks(text.remarks()),
    }


def _numbers(a: Audit) -> dict[str, Any]:
    """Limits and other numbers that the paper prints, beside ours."""
    return {
        "limits": [
            (
                m.where,
                m.what,
                m.printed,
                _number(m.as_print_implies, 4),
                _yes(m.rounding.confirmed),
                _number(m.right, 4),
                m.unit,
            )
            for m in numbers.limits()
        ],
        "numbers": [
            (
                n.where,
                n.what,
                n.printed,
                _number(n.computed, 4),
                n.unit,
                "confirmed" if n.confirmed else "**wrong**",
            )
            for n in numbers.numbers(a.largest_output)
        ],
    }


def _number(x: float, digits: int = 3) -> str:
    """Significant digits; 4e6, not 4e+06; 0 for zero."""
    if x == 0:
        return "0"
    mantissa, e, exponent = f"{x:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _yes(b: bool) -> str:
    return "yes" if b else "**no**"


def _costs(c: Cost | None) -> Row:
    return ("", "", "") if c is None else (_number(c.rms), _number(c.inline), _number(c.cross))


def _cost(c: Cost | None) -> dict[str, str]:
    return dict(zip(("rms", "inline", "cross"), _costs(c), strict=True))


def _words(option: str) -> str:
    return _WORDS.get(option, option)


def _score(s: Score) -> Row:
    return f"{s.reproduced} of {s.printed}", str(s.unprinted)


def _summary(a: Audit) -> list[Row]:
    groups: dict[str, list[int]] = {}
    for c in a.counts:
        row = groups.setdefault(c.number, [0, 0, 0, 0])
        for n, v in enumerate((c.printed, c.confirmed, c.printed - c.confirmed, c.missing)):
            row[n] += v
    total = [sum(r[n] for r in groups.values()) for n in range(4)]
    return [
        (name, *map(str, row))
        for name, row in ({f"Eq. {n}": r for n, r in groups.items()} | {"all": total}).items()
    ]


def _departures(a: Audit) -> list[Row]:
    rows: list[Row] = [("**as found**", "", *_score(a.score), "", "", "")]
    for d in a.departures:
        name = next(
            f.name for f in fields(Convention) if getattr(d.convention, f.name) != getattr(CHOSEN, f.name)
        )
        rows.append((_TITLES[name], _words(getattr(d.convention, name)), *_score(d.score), *_costs(d.cost)))
    return rows


def _erratum(e: Erratum) -> dict[str, Any]:
    ring = e.right.ring
    one = ring.domain.one
    return {
        "number": e.number,
        "left": e.left,
        "printed": e.printed,
        "right": latex(e.right),
        "kind": _kind(e),
        "residual": "" if e.residual is None else _number(e.residual, 6),
        "cost": _cost(e.cost),
        "changes": [
            (
                f"${latex(ring.from_dict({c.monomial: one}))}$",
                f"${rational(c.printed)}$",
                f"${rational(c.right)}$",
            )
            for c in e.changes
        ],
    }


def _kind(e: Erratum) -> str:
    at = (
        [s.name for s in e.right.ring.symbols].index("k1") if "k1" in map(str, e.right.ring.symbols) else None
    )
    if at is not None and any(c.printed and c.monomial[at] > 1 for c in e.changes):
        return "$\\theta$ for $\\vartheta$, so that $k_1$ is counted twice and the unit is wrong"
    if all(c.right == -c.printed for c in e.changes):
        return "the sign"
    return "the coefficient"


def _remarks(rows: Iterable[text.Remark]) -> list[Row]:
    return [(r.where, r.printed, r.right, r.why) for r in rows]
