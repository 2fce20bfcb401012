"""What speaks for a claim, and what against it: synthetic regressions in blocks of time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime.estimation import calibration, whitening
from ragg_runtime.estimation.fitted import FITTED_BLOCKS, fit
from ragg_runtime.estimation.observation import BLOCKS, observe_flights
from ragg_runtime.estimation.regressors import Column, list_base_columns
from ragg_runtime.estimation.scores import DISTINGUISHABLE
from ragg_runtime.identification import claims, likelihood_ratio, omnibus
from ragg_runtime.identification.claims import Regression, Robust
from ragg_runtime.identification.likelihood_ratio import log_bayes
from ragg_runtime.identification.selection import are_alike
from ragg_runtime.identification.uneven import temper_test
from ragg_runtime.model import model
from ragg_runtime.model.derive import with_effects
from ragg_runtime.reference.scenario import scenario

Array = NDArray[np.float64]
ROWS = 200


def regression(sizes: Array, *, further: int = 0) -> Regression:
    """An effect's column of so many sigma in each block (BLOCKS,), ``further`` that nothing excites, and one of the instrument."""
    rng = np.random.default_rng(1)
    blocks = []
    for size in sizes:
        X = np.column_stack([rng.normal(size=(ROWS, 2)), 1e-9 * rng.normal(size=(ROWS, further))])
        y = rng.normal(size=ROWS) + X[:, 1] * size / np.sqrt(ROWS)
        blocks.append(np.linalg.qr(np.column_stack([X, y]), mode="r"))
    effects = (None, *(["e"] * (1 + further)))
    return Regression((tuple(blocks),), np.zeros(2 + further), np.zeros(2 + further), effects)


def test_effects_that_explain_the_same_are_alike_however_uneven_their_scores_seem() -> None:
    plain = likelihood_ratio.Test(
        chi2=110.0, rank=1, log_p=-50.0, which=(0,), log_b=float(log_bayes(110.0, 1))
    )
    first, second = (temper_test(plain, by, 23.0) for by in (1.1, 1.4))
    assert first.log_b > second.log_b + 10.0
    assert are_alike(first, second)
    assert not are_alike(first, replace(plain, chi2=60.0, log_b=float(log_bayes(60.0, 1))))


def test_a_strong_effect_is_tested_with_all_coefficients_that_it_needs() -> None:
    size = np.diag([10.0, 10.0, 1.0])
    own = [(k, Column("e.x", k + 1, 1.0, "1", 1.0, "e")) for k in range(2)]
    for second, needed in ((30.0, (0, 1)), (1.0, (0,))):  # beside a thousand sigma
        size[:, -1] = 1000.0, second, 70.0
        t = likelihood_ratio.test(size, own, np.zeros(3), freedom=1000.0)
        assert (t.which, t.rank, t.chi2) == (needed, len(needed), pytest.approx(1e6 + (second > 1.0) * 900.0))


def test_blocks_that_hardly_carry_an_effect_tell_nothing_of_its_scores() -> None:
    everywhere = regression(np.full(BLOCKS, 2.0))
    (blocks,) = everywhere.flights
    somewhere = tuple(t * [1.0, 1.0 if b % 6 == 0 else 1e-3, 1.0] for b, t in enumerate(blocks))
    assert Robust.of(everywhere).significance("e").carriers == pytest.approx(BLOCKS, abs=1.0)
    of_few = Robust.of(replace(everywhere, flights=(somewhere,))).significance("e")
    assert of_few.carriers == pytest.approx(4.0, abs=0.3)
    assert replace(of_few, inflation=3.0).log_p(-9.0, doubted=False) == -9.0
    assert replace(of_few, inflation=3.0, carriers=24.0).log_p(-9.0, doubted=False) > -9.0


def test_held_out_blocks_speak_for_what_is_there_and_against_what_is_not() -> None:
    fitted = np.isin(np.arange(BLOCKS), FITTED_BLOCKS)
    assert claims.weigh_held_out(regression(np.full(BLOCKS, 2.0)), "e") > 5.0
    assert claims.weigh_held_out(regression(np.where(fitted, 2.0, -2.0)), "e") < -20.0
    assert abs(claims.weigh_held_out(regression(np.zeros(BLOCKS)), "e")) < DISTINGUISHABLE


def test_coefficients_that_nothing_excites_cost_a_claim_nothing() -> None:
    few, many = (claims.weigh_held_out(regression(np.full(BLOCKS, 2.0), further=n), "e") for n in (0, 12))
    assert many == pytest.approx(few, abs=3.0)


def test_coefficients_that_are_held_are_not_fitted_and_large_ones_widen_their_prior() -> None:
    s = scenario(57, duration=10.0)
    extended = with_effects(s.sheet, model.load_packaged(), ["cubic-input"])
    labels = [c.label for c, _ in list_base_columns(extended, s.sheet) if c.effect]
    held = replace(s.sheet, held=frozenset(labels[1:]))
    assert [c.label for c, _ in list_base_columns(extended, held) if c.effect] == labels[:1]
    columns, index = zip(*list_base_columns(extended, s.sheet), strict=True)
    p = calibration.make_vector(extended, s.sheet)
    known = np.array([0.01 if c.effect else 1.0 for c in columns])
    for c, k in zip(columns, index, strict=True):
        p[k] += 40.0 * c.scale * (c.label == labels[0])
    c = calibration.Calibration(
        p, columns, np.array(index), np.diag(known), (), 100, 100.0, 1.0, 1.0, converged=True, reason=""
    )
    assert calibration._estimate_widths(extended, s.sheet, c) == {
        "cubic-input.K_iii": pytest.approx(20.0, rel=0.02)
    }


def test_terms_explain_what_a_joint_fit_with_the_priors_of_the_base_does() -> None:
    rng = np.random.default_rng(3)
    base = np.concatenate([rng.normal(size=(ROWS, 3)), np.eye(3)])  # a prior's rows last
    terms = rng.normal(size=(ROWS, 2)) + base[:ROWS, :2]
    data = base[:ROWS] @ [5.0, -3.0, 0.0] + terms @ [2.0, 0.3] + rng.normal(size=ROWS)
    y = np.concatenate([data, [0.5, -0.5, 0.1]])

    def left(columns: int) -> float:
        X = np.hstack([base, np.concatenate([terms[:, :columns], np.zeros((3, columns))])])
        return float(np.sum((y - X @ np.linalg.lstsq(X, y, rcond=None)[0]) ** 2))

    T = np.linalg.qr(np.column_stack([base[:ROWS], data]), mode="r")
    p = whitening.make_projector([T], 3, (), y[ROWS:])
    Q = base[:ROWS] @ p.to_basis
    along, beside = terms.T @ Q, terms - Q @ (Q.T @ terms)
    found = p.explained(along, beside.T @ beside, beside.T @ data)
    assert found == pytest.approx([left(0) - left(1), left(0) - left(2)], rel=1e-9)
    twice = np.column_stack([beside, beside[:, 1] * (1 + 1e-9)])  # two terms that are nearly the same
    more = p.explained(np.vstack([along, along[1]]), twice.T @ twice - 1e-9, twice.T @ data)
    assert more == pytest.approx([*found, found[1]], rel=1e-3, abs=1.0)


def test_a_strong_term_leaves_but_noise_once_the_model_is_fitted_again_beside_it() -> None:
    s, derived = scenario(3, duration=120.0, rate=8.0, trim="table-v"), model.load_packaged()
    sim = s.simulate()
    flight, rate = sim.flight(), sim.channels["omega_z"]
    size = 100.0 * np.std(sim.G_out - sim.G_out_noise_free) / np.std(rate)
    changed = flight.outputs["G_out"] + size * rate
    f = fit(derived, s.sheet, observe_flights([replace(flight, outputs={"G_out": changed})], s.sheet))
    (searched,) = omnibus.search_residual(f).searches
    term = searched.steady[0]
    assert (term.term.harmonic, term.term.product) == ("const", "omega_z") and term.chi2 > 1e5
    left = claims.fit_beside(f, term)
    assert left is not None and left < 1.15 * len(flight)
