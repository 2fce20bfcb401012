"""The audit itself: every printed equation against the derivation, with proof and cost of what is wrong."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from sympy.polys.rings import PolyElement

from derive.audit import direct, experiment, proof
from derive.audit.compare import (
    ANALYTICAL,
    MOTION,
    SIMPLIFIED,
    TRANSDUCER,
    Equation,
    EquationComparison,
    Mistake,
    Rational,
    Reading,
    amplitude,
    compare,
    derived_amplitude,
    derived_motion,
    derived_transducer,
    expand_motion,
    expand_rate,
    printed_order,
    read,
    select,
)
from derive.audit.experiment import Cost
from derive.audit.reading import MODEL_RING, model_reader, motion_reader, transducer_reader
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, collect
from derive.simplify.terms import simplified as simplified_model

PROOF_POINTS = 10
"""More than the nine functions 1, cos n phi, sin n phi (n to 4) of Eq. 17: equality fixes each amplitude."""
PROOF_SEED = 2018

Amplitudes = Mapping[str, PolyElement]

MOTION_PLACES = slice(len(COEFFICIENT_PARAMETERS), len(COEFFICIENT_PARAMETERS) + len(MOTION_NUMBERS))
"""Of the motion numbers in :data:`MODEL_RING`."""


@dataclass(frozen=True)
class Erratum:
    """A printed term that is wrong.

    ``residual`` is what G_out is off by, at the first proof point, if this term alone is left as printed (exactly 0 with the
    right one); ``cost`` is that of printed minus right in the dynamic experiment. Both are None for Eq. 5b and 16, whose terms
    are no terms of G_out.
    """

    equation: Equation
    mistake: Mistake
    residual: float | None
    cost: Cost | None


@dataclass(frozen=True)
class Beyond:
    """Derived terms of one amplitude and motion number beyond the printed order of counting."""

    amplitude: str
    terms: PolyElement
    cost: Cost


@dataclass(frozen=True)
class Audit:
    """Result of the audit.

    ``proved``: every exact check left nothing. ``neglected``: cost of simplified minus analytical model.
    ``simplified_amplitudes``: those Eq. 42 must have.
    """

    comparisons: tuple[EquationComparison, ...]
    errata: tuple[Erratum, ...]
    beyond: tuple[Beyond, ...]
    neglected: Cost
    simplified_amplitudes: tuple[str, ...]
    proved: bool

    @property
    def printed(self) -> int:
        """Number of printed atoms audited."""
        return sum(c.printed for c in self.comparisons)

    @property
    def confirmed(self) -> int:
        """Number of printed atoms that come out."""
        return sum(c.confirmed for c in self.comparisons)

    @property
    def wrong(self) -> int:
        """Number of printed atoms that are wrong."""
        return self.printed - self.confirmed


@cache
def audit() -> Audit:
    """Audit Eq. 5b, 16, 18, 19 and 43-47 against the current derivation."""
    collected, simple = collect(), simplified_model()
    full = {name: derived_amplitude(collected, name) for name in collected.amplitudes}
    analytical = {n: select(p, printed_order) for n, p in full.items()}
    simplified = {n: derived_amplitude(simple, n) for n in simple.amplitudes}
    transducer = derived_transducer()
    outcomes = [(r, compare(r, p)) for r, p in readings(analytical, simplified, transducer)]
    points = direct.points(PROOF_POINTS, PROOF_SEED)
    return Audit(
        comparisons=tuple(o for _, o in outcomes),
        errata=tuple(_erratum(r, m, points[0]) for r, o in outcomes for m in o.mistakes),
        beyond=tuple(_beyond(full, analytical)),
        neglected=experiment.cost(
            {n: simplified.get(n, MODEL_RING.zero) - analytical[n] for n in analytical}
        ),
        simplified_amplitudes=tuple(n for n, p in simplified.items() if p),
        proved=_proved(analytical, transducer, points),
    )


def readings(
    analytical: Amplitudes, simplified: Amplitudes, transducer: Mapping[str, PolyElement]
) -> list[tuple[Reading, PolyElement]]:
    """Every printed equation as read, with its derivation."""
    motion = derived_motion()
    reader, expand = model_reader(), expand_motion()
    pairs = [(read(e, transducer_reader()), transducer[e.left]) for e in TRANSDUCER]
    pairs += [(read(e, motion_reader(), expand_rate), motion[e.left]) for e in MOTION]
    pairs += [(read(e, reader, expand), analytical[amplitude(e.left)]) for e in ANALYTICAL]
    return pairs + [(read(e, reader, expand), simplified[amplitude(e.left)]) for e in SIMPLIFIED]


def _proved(
    analytical: Amplitudes, transducer: Mapping[str, PolyElement], points: tuple[direct.NumericPoint, ...]
) -> bool:
    outputs = all(direct.output(p) == proof.output(analytical, p) for p in points)
    return outputs and all(
        direct.current(p, j, p.a) == proof.current(transducer, p, j) for p in points[:3] for j in range(4)
    )


def _erratum(r: Reading, m: Mistake, point: direct.NumericPoint) -> Erratum:
    residual, cost = None, None
    if r.ring is MODEL_RING:
        difference = {amplitude(r.equation.left): printed_minus_right(m)}
        residual, cost = float(proof.output(difference, point)), experiment.cost(difference)
    return Erratum(r.equation, m, residual, cost)


def printed_minus_right(m: Mistake) -> PolyElement:
    """What a printed term of Eq. 18, 19 or 43-47 has too much, in the independent motion numbers."""
    expand = expand_motion()
    return sum((expand(c.monomial) * (c.printed - c.right) for c in m.changes), MODEL_RING.zero)


def _beyond(full: Amplitudes, kept: Amplitudes) -> list[Beyond]:
    rows = []
    for name in full:
        motions: dict[tuple[int, ...], dict[tuple[int, ...], Rational]] = {}
        for powers, value in (full[name] - kept[name]).terms():
            motions.setdefault(powers[MOTION_PLACES], {})[powers] = value
        for terms in motions.values():
            p = MODEL_RING.from_dict(terms)
            rows.append(Beyond(name, p, experiment.cost({name: p})))
    return rows
