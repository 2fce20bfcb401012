"""The frozen result of the derivation: the only thing that emitters see.

Two products of one derivation. :class:`Harmonic` is the paper's form (amplitudes of harmonics, for the
analytical and the simplified model). :class:`ChainProgram` is the same instrument unexpanded, one accelerometer
at a time, with exact derivatives: it holds for any list of effects.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from derive.chain import accelerometer, auxiliary_channel
from derive.effect import Effect, EffectParameter
from derive.folded import Folded
from derive.layout import PAPER as FOUR
from derive.layout import PAPERS, SymbolicForm, SymbolicLayout, instrument_parameters
from derive.names import channel_of
from derive.propagation import COEFFICIENT_PARAMETERS, Collected, monomial, motion_numbers, part, readable
from derive.symbols import ACCELEROMETER, INSTRUMENT, MOTION, Channel, Parameter
from derive.tape import Program, settled


@dataclass(frozen=True)
class Coefficient:
    """An error-propagation coefficient: ``combination`` (D12 ...) of an expression per accelerometer."""

    combination: str
    expression: sp.Expr


@dataclass(frozen=True)
class AmplitudeTerm:
    """Sum of coefficients, times a product of motion numbers (``1`` if empty)."""

    coefficients: tuple[Coefficient, ...]
    motion: sp.Expr


@dataclass(frozen=True)
class Harmonic:
    """A model in the paper's form.

    Attributes
    ----------
    amplitudes
        A_0, A_1c, A_1s ... in order, each a tuple of terms.
    numbers
        T_1 ... by omega, omegadot and Gamma, those that are used.
    basis
        (harmonic, phase, motion monomial) of one accelerometer in its own angle.
    slopes
        d(coefficient)/d(parameter): parameter name -> ((index into ``basis``, expression), ...).
    """

    name: str
    title: str
    amplitudes: tuple[tuple[str, tuple[AmplitudeTerm, ...]], ...]
    numbers: tuple[tuple[str, sp.Expr], ...]
    basis: tuple[tuple[int, str, sp.Expr], ...]
    slopes: tuple[tuple[str, tuple[tuple[int, sp.Expr], ...]], ...]
    inputs: tuple[Channel, ...] = MOTION
    parameters: tuple[Parameter, ...] = INSTRUMENT

    @property
    def highest(self) -> int:
        return max(n for n, _, _ in self.basis)


@dataclass(frozen=True)
class DerivativeRow:
    """One derivative of V_j: by which parameter, and whether that has one value or four."""

    name: str
    shared: bool


@dataclass(frozen=True)
class ChainProgram:
    """One accelerometer as a straight-line program: V_j and its derivatives (``rows``)."""

    name: str
    title: str
    value: Program
    derivatives: Program
    rows: tuple[DerivativeRow, ...]
    inputs: tuple[Channel, ...]
    parameters: tuple[Parameter, ...]
    effects: tuple[Effect, ...]
    layout: SymbolicLayout = FOUR


def harmonic(collected: Collected, name: str, title: str) -> Harmonic:
    """The paper's form of a collected model."""
    amplitudes = []
    for amplitude, terms in collected.amplitudes.items():
        grouped: dict[tuple[int, ...], list[Coefficient]] = {}
        for t in terms:
            grouped.setdefault(t.motion, []).extend(
                Coefficient(t.combination, readable(p))
                for p in (part(t.coefficient, nominal) for nominal in (True, False))
                if p
            )
        amplitudes.append(
            (amplitude, tuple(AmplitudeTerm(tuple(c), monomial(m)) for m, c in grouped.items()))
        )
    basis: list[tuple[int, str, sp.Expr]] = []
    slopes: dict[str, list[tuple[int, sp.Expr]]] = {p: [] for p in COEFFICIENT_PARAMETERS}
    for (n, phase), terms_of in collected.generic.items():
        for motion in sorted(terms_of, reverse=True):
            for p, generator in zip(COEFFICIENT_PARAMETERS, collected.ring.gens, strict=True):
                slope = terms_of[motion].diff(generator)
                if slope:
                    slopes[p].append((len(basis), readable(slope)))
            basis.append((n, phase, monomial(motion)))
    used = {s.name for _, terms in amplitudes for t in terms for s in t.motion.free_symbols}
    numbers = tuple((k, v) for k, v in motion_numbers().items() if k in used)
    return Harmonic(
        name=name,
        title=title,
        amplitudes=tuple(amplitudes),
        numbers=numbers,
        basis=tuple(basis),
        slopes=tuple((p, tuple(s)) for p, s in slopes.items()),
    )


def effect_parameters(effects: Sequence[Effect], count: int = FOUR.size) -> tuple[Parameter, ...]:
    """The parameters that effects bring, under the names they have in a parameter vector."""
    return tuple(
        Parameter(
            name=e.symbol(q).name,
            latex=q.latex,
            unit=q.unit,
            meaning=f"{e.title}: {q.meaning}",
            shared=q.shared,
            count=count,
        )
        for e in effects
        for q in e.parameters
    )


def chain(
    effects: Sequence[Effect],
    name: str,
    title: str,
    form: SymbolicForm = PAPERS,
    candidates: Sequence[Effect] = (),
) -> ChainProgram:
    """V_j of the instrument with ``effects``, and its derivatives.

    Without ``candidates``: by every fitted parameter. With them: by every parameter of the candidates, at
    their neutral values, that is, the signature that each would leave in this instrument.
    """
    a, layout = accelerometer([*effects, *candidates], form, candidates), form.layout
    neutral = dict(layout.common) | {e.symbol(q): _neutral(e, q) for e in candidates for q in e.parameters}
    at = settled(a.tape.assignments, neutral)
    value = at.program([("V", a.voltage)])
    at, by = a.tape.derivatives(a.voltage, at)
    named = [] if candidates else [(q.symbol, q.name, False) for q in ACCELEROMETER]
    for e in candidates or effects:
        named += [(e.symbol(q), f"{e.id}.{q.name}", q.shared) for q in e.parameters if q.fitted]
    outputs = [(n, by(s)) for s, n, _ in named]
    derivatives = at.program(outputs)
    parameters = (*instrument_parameters(layout), *effect_parameters(effects, layout.size))
    names = {p.name for p in parameters}
    reserved = names | {"cos_phi", "sin_phi", "time", *layout.constants} | {c.name for c in MOTION}
    read = {s.name for program in (value, derivatives) for s in program.inputs}
    extra = sorted(read - reserved)
    return ChainProgram(
        name=name,
        title=title,
        value=value,
        derivatives=derivatives,
        rows=tuple(DerivativeRow(n, shared) for _, n, shared in named),
        inputs=(*MOTION, *(auxiliary_channel(channel_of(n)) for n in extra)),
        parameters=parameters,
        effects=tuple(candidates) or tuple(effects),
        layout=layout.without_common(),
    )


def _neutral(e: Effect, q: EffectParameter) -> sp.Expr:
    """Where a candidate's signature is taken: a step acts all the time (the runtime masks it)."""
    if e.kind == "step" and not q.fitted:
        return -sp.oo
    return sp.Float(q.neutral) if q.neutral else sp.Integer(0)


def manifest_of_model(m: Harmonic | ChainProgram | Folded) -> Mapping[str, object]:
    """The manifest of the generated code: inputs, parameters, outputs."""
    outputs: dict[str, list[str]] = {}
    if isinstance(m, Harmonic):
        outputs = {"amplitudes": [name for name, _ in m.amplitudes]}
    elif isinstance(m, ChainProgram):
        outputs = {"rows": [r.name for r in m.rows]}
    return {
        "title": m.title,
        "inputs": [{"name": i.name, "unit": i.unit, "meaning": i.meaning} for i in m.inputs],
        "parameters": [
            {"name": q.name, "unit": q.unit, "size": q.size, "meaning": q.meaning} for q in m.parameters
        ],
        **outputs,
    }


def manifest_of_effect(e: Effect) -> Mapping[str, object]:
    """What the runtime needs of an effect; what is seldom otherwise than left out is left out then."""
    named = ("id", "title", "physics", "source", "equation", "limits", "channels")
    seldom = {n: v for n in ("either", "switches", "memory") if (v := getattr(e, n))}
    if not e.searched:
        seldom["searched"] = False
    if e.contains:
        seldom["contains"] = e.contains
    parameters = [_manifest_of_parameter(e, q) for q in e.parameters]
    return {**{n: getattr(e, n) for n in named}, **seldom, "kind": e.kind, "parameters": parameters}


def _manifest_of_parameter(e: Effect, q: EffectParameter) -> Mapping[str, object]:
    seldom = ("physical", "largest", "like", "late", "growing", "shape")
    entries = {"name": q.name, "symbol": e.symbol(q).name, **vars(q)}
    entries["neutral"] = q.neutral if math.isfinite(q.neutral) else None
    return {n: v for n, v in entries.items() if v or n not in seldom}
