"""Critical motion: up to where a kind of error term may be neglected (Eq. 31-41, Tables I to III)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from derive.simplify.envelope import EOTVOS, Envelope, ranges
from derive.symbols import SECOND_ORDER

MISALIGNMENTS = ("beta_x", "beta_z", "vartheta_y", "vartheta_z")
"""The angles of Section II.B.1."""


@dataclass(frozen=True)
class Kind:
    """A kind of error term: powers of what its basic term is a product of (besides k1 and R)."""

    where: str
    term: str
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

    That is the critical T_n in s^-2 with the ``angular`` motion that it stands for, or the critical
    acceleration in m/s^2 (``angular`` is ``None``). Infinite if the envelope has no such error.
    """

    kind: Kind
    critical: float
    angular: AngularMotion | None


KINDS = (
    Kind("Table I", "k_{jp} T_{n_1} T_{n_2} R_j^2", second_order=1, angular=2),
    Kind("below Eq. 37", "k_{jp} a_{n_1} a_{n_2}", second_order=1, linear=2),
    Kind("below Eq. 37a", "dk_{j1} a_n", imbalance=1, linear=1),
    Kind("Table II", "k_{jp} T_{n_1} R_j a_{n_2}", second_order=1, angular=1, linear=1),
    Kind("Table III, row 1", r"\beta_{jn} k_{j1} T_p R_j", angles=1, angular=1),
    Kind("Table III, row 2", r"\beta_{jn_1} \beta_{jn_2} k_{j1} T_p R_j", angles=2, angular=1),
    Kind("Table III, row 3", r"\beta_{jn_1} \beta_{jn_2} \vartheta_{jm} k_{j1} T_p R_j", angles=3, angular=1),
    Kind("below Eq. 41, one angle", r"\beta_{jn} k_{j1} a_z", angles=1, linear=1),
    Kind("below Eq. 41, two angles", r"\beta_{jn_1} \beta_{jn_2} k_{j1} a_z", angles=2, linear=1),
    Kind(
        "below Eq. 41, three angles",
        r"\beta_{jn_1} \beta_{jn_2} \vartheta_{jm} k_{j1} a_z",
        angles=3,
        linear=1,
    ),
)
"""The kinds of Section II.B.1, in its order."""


def critical_conditions(envelope: Envelope) -> tuple[Condition, ...]:
    """The conditions of Section II.B.1 for an envelope: one for each of :data:`KINDS`.

    A basic term is one accelerometer's share of G_out over k_ggi, 1 / (4 R) of its specific force, as in
    Eq. 32 ("0.25"); it may reach ``envelope.allotted``. Of several parameters of a kind the largest counts.
    """
    return tuple(_condition(envelope, k) for k in KINDS)


def _condition(envelope: Envelope, kind: Kind) -> Condition:
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
