"""Eq. 5a and 5b: the transducer in the accelerometer's nominal frame, angles and second-order terms multiplied.

With C composed of first-order rotations about x, then y, then z (which is what the printed Eq. 5b holds),
I_j/K_j1 is again a quadratic form of f_x, f_y, f_z: its coefficients are the starred ones.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import sympy as sp
from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from derive import stages
from derive.stages import PAPER
from derive.symbols import SECOND_ORDER, symbol

STARRED: Mapping[str, tuple[int, int, int]] = {
    "vartheta_z": (0, 1, 0),
    "vartheta_y": (0, 0, 1),
    "K2": (2, 0, 0),
    "K4": (1, 0, 1),
    "K5": (0, 2, 0),
    "K6": (1, 1, 0),
    "K7": (0, 0, 2),
    "K8": (0, 1, 1),
}
"""Starred quantity of Eq. 5a -> powers of (f_x, f_y, f_z) that it multiplies (vartheta_y with a minus sign)."""


@cache
def starred() -> dict[str, sp.Expr]:
    """Eq. 5b: every starred coefficient by the angles and the second-order coefficients."""
    forces = [symbol(n) for n in ("f_x", "f_y", "f_z")]
    angles = [symbol(f"vartheta_{k}") for k in "xyz"]
    coefficients = [symbol(n) for n in SECOND_ORDER]
    ring = PolyRing([*forces, *angles, *coefficients], QQ, lex)
    x, y, z = (stages.turn(sp.eye(3)[:, n], -a, PAPER.rotation) for n, a in enumerate(angles))
    sensed = z * (y * (x * sp.Matrix(forces)))
    f = stages.SensedForce(*(ring.from_expr(e) for e in sensed))
    k = {s.name: ring.from_expr(s) for s in coefficients} | {"K0": ring.zero}
    by_powers: dict[tuple[int, ...], dict[tuple[int, ...], object]] = {}
    for monomial, c in stages.transducer(f, f, k).terms():
        by_powers.setdefault(monomial[:3], {})[(0, 0, 0, *monomial[3:])] = c
    signs = {"vartheta_y": -1}
    return {
        name: ring.from_dict(by_powers[powers]).as_expr() * signs.get(name, 1)
        for name, powers in STARRED.items()
    }
