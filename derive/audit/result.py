"""The audit itself: every printed equation against the derivation, with proof and cost of what is wrong."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache

from sympy.polys.rings import PolyElement

from derive.audit import conventions, definitions, direct, experiment, proof
from derive.audit.compare import (
    Change,
    Mistake,
    Rational,
    Reading,
    amplitude,
    classify,
    compare,
    derived_amplitude,
    expand_motion,
    printed_order,
    read,
    select,
    simplified_order,
)
from derive.audit.conventions import CHOSEN, Convention, Score, amplitudes_with
from derive.audit.experiment import Cost
from derive.audit.printed import MOTION, SIMPLIFIED, TRANSDUCER
from derive.audit.reading import MODEL_RING, model_reader, motion_reader, transducer_reader
from derive.propagation import collect

PROOF_POINTS = 10
"""More than the nine functions 1, cos n phi, sin n phi (n to 4) of Eq. 17: equality fixes each amplitude."""
PROOF_SEED = 2018

Amplitudes = Mapping[str, PolyElement]


@dataclass(frozen=True)
class Count:
    """Printed atoms of one equation: how many come out, and derived terms that it lacks."""

    number: str
    left: str
    printed: int
    confirmed: int
    missing: int


@dataclass(frozen=True)
class Erratum:
    """A printed term that is wrong.

    ``right`` is the term as it should be; ``residual`` is what G_out is off by, at the first proof point, if
    this term alone is left as printed (exactly 0 with the right one); ``cost`` is that of printed minus right
    in the dynamic experiment. Both are None for Eq. 5b and 16, whose terms are no terms of G_out.
    """

    number: str
    left: str
    printed: str
    right: PolyElement
    changes: tuple[Change, ...]
    residual: float | None
    cost: Cost | None


@dataclass(frozen=True)
class Beyond:
    """Derived terms of one amplitude and motion number beyond the printed order of counting."""

    amplitude: str
    terms: PolyElement
    cost: Cost


@dataclass(frozen=True)
class Departure:
    """One convention changed alone: what comes out, and by how much G_out moves (None: not at all)."""

    convention: Convention
    score: Score
    cost: Cost | None


@dataclass(frozen=True)
class Neglected:
    """What one rule of Section II.B.1 drops: number of terms, and cost of simplified minus analytical."""

    rule: str
    terms: int
    cost: Cost


@dataclass(frozen=True)
class Audit:
    """Result of the audit.

    ``proved``: every exact check left nothing. ``tilt_after_shift``: what is left of the change of tilt once
    the misalignment angles are shifted to absorb it. ``simplified_amplitudes``: those Eq. 42 must have.
    """

    counts: tuple[Count, ...]
    errata: tuple[Erratum, ...]
    beyond: tuple[Beyond, ...]
    score: Score
    departures: tuple[Departure, ...]
    geometries: tuple[tuple[Convention, Score], ...]
    transducer: tuple[tuple[str, Score], ...]
    motion: tuple[tuple[str, Score], ...]
    tilt_after_shift: Cost
    neglected: tuple[Neglected, ...]
    simplified_amplitudes: tuple[str, ...]
    largest_output: float
    proved: bool

    @property
    def printed(self) -> int:
        """Number of printed atoms audited."""
        return sum(c.printed for c in self.counts)

    @property
    def confirmed(self) -> int:
        """Number of printed atoms that come out."""
        return sum(c.confirmed for c in self.counts)

    @property
    def wrong(self) -> int:
        """Number of printed atoms that are wrong."""
        return self.printed - self.confirmed


@cache
def audit() -> Audit:
    """Audit Eq. 5b, 16, 18, 19 and 43-47 against the derivation as it stands."""
    collected = collect()
    full = {name: derived_amplitude(collected, name) for name in collected.amplitudes}
    analytical = {n: select(p, printed_order) for n, p in full.items()}
    simplified = {n: select(p, simplified_order) for n, p in analytical.items()}
    transducer = definitions.derived_transducer()
    pairs = readings(analytical, simplified, transducer)
    outcomes = [(r, compare(r, p)) for r, p in pairs]
    points = direct.points(PROOF_POINTS, PROOF_SEED)
    dropped = {n: analytical[n] - simplified[n] for n in analytical}
    (_, score), *changed = conventions.departures()
    return Audit(
        counts=tuple(
            Count(r.equation.number, r.equation.left, len(r.atoms), o.confirmed, len(o.missing))
            for r, o in outcomes
        ),
        errata=tuple(_erratum(r, m, points[0]) for r, o in outcomes for m in o.mistakes),
        beyond=tuple(_beyond(full, analytical)),
        score=score,
        departures=tuple(Departure(v, s, _departure_cost(v, analytical)) for v, s in changed),
        geometries=conventions.geometries(),
        transducer=definitions.transducer_scores(),
        motion=definitions.motion_scores(),
        tilt_after_shift=tilt_after_shift(analytical),
        neglected=(*(_neglected(dropped, rule) for rule in "abcdef"), _neglected(dropped, "")),
        simplified_amplitudes=tuple(n for n, p in simplified.items() if p),
        largest_output=max(abs(v) for v in experiment.output(analytical)),
        proved=_proved(analytical, transducer, points)
        and conventions.derive_with(CHOSEN).amplitudes == collected.amplitudes,
    )


def readings(
    analytical: Amplitudes, simplified: Amplitudes, transducer: Mapping[str, PolyElement]
) -> list[tuple[Reading, PolyElement]]:
    """Every printed equation as read, with its derivation."""
    motion = definitions.derived_motion()
    reader, expand = model_reader(), expand_motion()
    pairs = [(r, transducer[r.equation.left]) for r in (read(e, transducer_reader()) for e in TRANSDUCER)]
    for e in MOTION:
        pairs.append((read(e, motion_reader(), definitions.expand_rate), motion[e.left]))
    pairs += [
        (r, analytical[amplitude(r.equation.left)])
        for r in conventions.read_print(CHOSEN.theta, CHOSEN.laplace)
    ]
    return pairs + [(read(e, reader, expand), simplified[amplitude(e.left)]) for e in SIMPLIFIED]


def _proved(
    analytical: Amplitudes, transducer: Mapping[str, PolyElement], points: tuple[direct.Point, ...]
) -> bool:
    outputs = all(direct.output(p) == proof.output(analytical, p) for p in points)
    return outputs and all(
        direct.current(p, j, p.a) == proof.current(transducer, p, j) for p in points[:3] for j in range(4)
    )


def _erratum(r: Reading, m: Mistake, point: direct.Point) -> Erratum:
    residual, cost = None, None
    if r.ring is MODEL_RING:
        difference = {amplitude(r.equation.left): printed_minus_right(m)}
        residual, cost = float(proof.output(difference, point)), experiment.cost(difference)
    printed = r.equation.terms[m.term]
    return Erratum(r.equation.number, r.equation.left, printed, m.right, m.changes, residual, cost)


def printed_minus_right(m: Mistake) -> PolyElement:
    """What a printed term of Eq. 18, 19 or 43-47 has too much, in the independent motion numbers."""
    expand = expand_motion()
    return sum((expand(c.monomial) * (c.printed - c.right) for c in m.changes), MODEL_RING.zero)


def _beyond(full: Amplitudes, kept: Amplitudes) -> list[Beyond]:
    rows = []
    for name in full:
        motions: dict[tuple[int, ...], dict[tuple[int, ...], Rational]] = {}
        for powers, value in (full[name] - kept[name]).terms():
            motions.setdefault(powers[experiment.MOTION_PLACES], {})[powers] = value
        for terms in motions.values():
            p = MODEL_RING.from_dict(terms)
            rows.append(Beyond(name, p, experiment.cost({name: p})))
    return rows


def _departure_cost(v: Convention, base: Amplitudes) -> Cost | None:
    if replace(v, theta=CHOSEN.theta, laplace=CHOSEN.laplace) == CHOSEN:
        return None  # a way of reading the print, not of deriving the model
    return experiment.cost({n: p - base[n] for n, p in amplitudes_with(v).items()})


def tilt_after_shift(base: Amplitudes) -> Cost:
    """What is left of the triad's tilt turned round, once vartheta_y and vartheta_z absorb what they can.

    The tilt enters Eq. 19 as vartheta_z + beta_x vartheta_y and vartheta_y - beta_x vartheta_z: turning its
    sense is undone by shifting vartheta_z by 2 beta_x vartheta_y and vartheta_y by -2 beta_x vartheta_z.
    """
    p = experiment.accelerometers()
    x, y, z = p["beta_x"], p["vartheta_y"], p["vartheta_z"]
    shifted = {
        **p,
        "vartheta_y": tuple(y[j] - 2 * x[j] * z[j] for j in range(4)),
        "vartheta_z": tuple(z[j] + 2 * x[j] * y[j] for j in range(4)),
    }
    turned = experiment.output(amplitudes_with(replace(CHOSEN, tilt="rises")), shifted)
    return experiment.price([u - v for u, v in zip(turned, experiment.output(base), strict=True)])


def _neglected(dropped: Amplitudes, rule: str) -> Neglected:
    def mine(powers: Mapping[str, int]) -> bool:
        return not rule or classify(powers) == rule

    chosen: dict[str, PolyElement] = {n: select(p, mine) for n, p in dropped.items()}
    return Neglected(
        rule, sum(len(p) for p in chosen.values()), experiment.cost({n: -p for n, p in chosen.items()})
    )
