"""The audit: its result, its exact evaluation, and that it would find a misprint, a missing term, or a wrong derivation."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from sympy import QQ

from derive.audit import audit, direct, result
from derive.audit.compare import (
    ANALYTICAL,
    TRANSDUCER,
    Equation,
    NotReadable,
    amplitude,
    compare,
    derived_amplitude,
    derived_transducer,
    expand_motion,
    in_printed_order,
    model_reader,
    read,
    transducer_reader,
)
from derive.propagation import collect

READER, EXPAND = model_reader(), expand_motion()


def derived(e: Equation):
    return in_printed_order(derived_amplitude(collect(), amplitude(e.left)))


def negated(term: str) -> str:
    """The printed term with its first sign turned."""
    return {"-": "+", "+": "-"}[term[0]] + term[1:] if term[0] in "+-" else "-" + term


def test_every_printed_term_is_confirmed_or_an_erratum():
    a = audit()
    assert a.proved
    assert (a.printed, a.confirmed, a.wrong) == (427, 425, 2)
    assert not any(c.missing for c in a.comparisons)
    assert a.wrong == sum(1 for e in a.errata for c in e.mistake.changes if c.printed)
    assert [(e.equation.number, e.equation.left) for e in a.errata] == [("19", r"A_\Omega^s"), ("19", "A_0")]


def test_errata_are_real_and_small():
    for e in audit().errata:
        assert e.residual != 0
        assert 0 < e.cost.rms < 0.01


@pytest.mark.parametrize("e", [e for e in ANALYTICAL if e.number == "18"], ids=lambda e: e.left)
def test_a_turned_sign_is_found_in_every_term(e):
    for n, term in enumerate(e.terms):
        misprinted = replace(e, terms=(*e.terms[:n], negated(term), *e.terms[n + 1 :]))
        outcome = compare(read(misprinted, READER, EXPAND), derived(e))
        # A sign before a sum turns that term alone; the rest of the equation stays confirmed.
        original = READER.read(term)
        assert [m.term for m in outcome.mistakes] == [n]
        assert outcome.mistakes[0].right == original
        assert not outcome.missing


@pytest.mark.parametrize("e", TRANSDUCER, ids=lambda e: e.left)
def test_a_term_left_out_of_eq_5b_is_found(e):
    reader, right = transducer_reader(), derived_transducer()[e.left]
    for n, term in enumerate(e.terms[1:], 1):
        outcome = compare(read(replace(e, terms=(*e.terms[:n], *e.terms[n + 1 :])), reader), right)
        assert len(outcome.missing) == len(reader.read(term))
        assert not outcome.mistakes


def test_a_wrong_derivation_is_found():
    e = next(e for e in ANALYTICAL if e.left == r"A_{4\Omega}^c")
    assert not compare(read(e, READER, EXPAND), derived(e)).mistakes
    assert len(compare(read(e, READER, EXPAND), derived(e) * QQ(2)).mistakes) == len(e.terms)


@pytest.mark.parametrize(
    "text", ["T_1 D_{k_9 R}^{12}", "T_1)", "D_{k_1,k_2}^{12}", r"\beta_y", "D_{k_1 R^{12}"]
)
def test_reader_refuses_what_is_not_in_the_grammar(text):
    with pytest.raises(NotReadable):
        READER.read(text)


def amplitudes():
    c = collect()
    return {n: in_printed_order(derived_amplitude(c, n)) for n in c.amplitudes}


@pytest.mark.parametrize("seed", [1, 2])
def test_derivation_equals_direct_evaluation_exactly(seed):
    for p in direct.points(3, seed):
        value = direct.output(p)
        assert value != 0
        assert result.output(amplitudes(), p) == value
        for j in range(4):
            assert result.current(derived_transducer(), p, j) == direct.current(p, j, p.a)


def test_signal_costs_what_it_is():
    """k_ggi T_1 sin 2 phi demodulates to 2 mean(T_1): T_1 has no fourth harmonic."""
    c = result.cost({"A_2s": model_reader().read(r"T_1 \sum_{k_1 R}")})
    per_hour = math.pi / 648000
    mean = (1500**2 + 900**2 / 2 - 1000**2 - 700**2 / 2) / 2 * per_hour**2 / 1e-9
    assert c.inline == pytest.approx(2 * mean, rel=1e-12)
    # The harmonics of T_1 (once and twice the spin rate) do not leak into the other channel.
    assert c.cross == pytest.approx(0, abs=1e-6 * mean)
