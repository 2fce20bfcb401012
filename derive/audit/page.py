"""Writes the audit as a page of Markdown, for the documentation: the same bytes for the same derivation."""

from __future__ import annotations

from typing import Any

import jinja2

from derive.audit.experiment import Cost
from derive.audit.notation import amplitude, latex, rational
from derive.audit.result import PROOF_POINTS, Audit, Erratum, audit

Row = tuple[str, ...]


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
    costs = [max(e.cost.rms, abs(e.cost.inline), abs(e.cost.cross)) for e in a.errata if e.cost]
    return {
        "summary": _summary(a),
        "confirmed": str(a.confirmed),
        "printed": str(a.printed),
        "wrong": str(a.wrong),
        "worst_erratum": _number(max(costs, default=0.0)),
        "neglected": _cost(a.neglected),
        "proof_points": str(PROOF_POINTS),
        "proof_verdict": "All differences are exactly 0." if a.proved else "**A difference is not 0.**",
        "errata": [_erratum(e) for e in a.errata],
        "beyond": [
            (f"${amplitude(b.amplitude)}$", f"${latex(b.terms)}$", *_cost(b.cost).values()) for b in a.beyond
        ],
        "simplified": ", ".join(f"${amplitude(n)}$" for n in a.simplified_amplitudes),
    }


def _number(x: float, digits: int = 3) -> str:
    """Significant digits; 4e6, not 4e+06; 0 for zero."""
    if x == 0:
        return "0"
    mantissa, e, exponent = f"{x:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _cost(c: Cost | None) -> dict[str, str]:
    return {} if c is None else {n: _number(getattr(c, n)) for n in ("rms", "inline", "cross")}


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


def _erratum(e: Erratum) -> dict[str, Any]:
    one = e.right.ring.domain.one
    return {
        "number": e.number,
        "left": e.left,
        "printed": e.printed,
        "right": latex(e.right),
        "residual": "" if e.residual is None else _number(e.residual, 6),
        "cost": _cost(e.cost),
        "changes": [
            (
                f"${latex(e.right.ring.from_dict({c.monomial: one}))}$",
                f"${rational(c.printed)}$",
                f"${rational(c.right)}$",
            )
            for c in e.changes
        ],
    }
