"""Whitened series of generic terms: the cheap way round agrees with the direct one, and loses nothing."""

from __future__ import annotations

import dataclasses
from functools import cache

import numpy as np
import pytest

from ragg_runtime.estimation import fitted, observation, whitening
from ragg_runtime.identification.omnibus import Scores
from ragg_runtime.identification.whitened_terms import Directions
from ragg_runtime.model import model
from ragg_runtime.reference.scenario import scenario


@cache
def scores_of(gradient_known: bool, samples: int) -> Scores:
    s = scenario(61, duration=320.0)
    flight = s.simulate({}).flight()
    channels = {
        n: x[:samples] for n, x in flight.channels.items() if gradient_known or not n.startswith("Gamma")
    }
    outputs = {"G_out": flight.outputs["G_out"][:samples]}
    flight = dataclasses.replace(
        flight, time=flight.time[:samples], channels=channels, outputs=outputs, valid=flight.valid[:samples]
    )
    f = fitted.fit(model.packaged(), s.sheet, [observation.observe(flight, s.sheet)])
    return Scores(f.prepared[0], whitening.projector(f.triangles[0], f.n_base, ()))


@pytest.mark.parametrize("samples", [5000, 5001])
@pytest.mark.parametrize("gradient_known", [True, False])
def test_the_scores_of_terms_gone_round_are_those_of_their_series(gradient_known: bool, samples: int) -> None:
    """Inner products and norms (transposed filter, Parseval) against the whitened series themselves."""
    s = scores_of(gradient_known, samples)
    (piece,) = s.prepared.each(lambda p: p)
    d = Directions(s.prepared, s.dictionary, piece)
    Q = s.projector.basis(piece)
    right = np.column_stack([s.projector.left(piece, Q), Q])
    terms = s.dictionary.terms[s.dictionary.slow :][::7]
    series = np.concatenate([X for _, _, X in d.periodic(terms)]).astype(np.float64)
    found = [(inner, norm2) for _, _, inner, norm2 in d.scores(terms, right)]
    inner = np.concatenate([i for i, _ in found])
    norm2 = np.concatenate([n for _, n in found])
    assert norm2 == pytest.approx(np.sum(series**2, axis=1), rel=1e-4)
    scale = np.sqrt(norm2)[:, None]
    assert np.max(np.abs(inner - series @ right) / scale) < 1e-3


def test_going_round_loses_next_to_nothing() -> None:
    """A term's score is that of the series through the filter itself, to a small part of a standard deviation
    for each that it has."""
    s = scores_of(True, 5000)
    (piece,) = s.prepared.each(lambda p: p)
    d = Directions(s.prepared, s.dictionary, piece)
    terms = s.dictionary.terms[s.dictionary.slow :]
    straight = np.concatenate([X for _, _, X in d.whitened(terms)])
    around = np.concatenate([X for _, _, X in d.periodic(terms)])
    cosine = np.einsum("ij,ij->i", straight, around) / np.sqrt(
        np.einsum("ij,ij->i", straight, straight) * np.einsum("ij,ij->i", around, around)
    )
    assert np.quantile(cosine, 0.01) > 0.98
    assert np.median(cosine) > 0.999


def test_terms_do_not_go_round_past_gaps() -> None:
    s = scores_of(True, 5000)
    (piece,) = s.prepared.each(lambda p: p)
    r = piece.observation.record
    valid = r.valid.copy()
    valid[100] = False
    gap = dataclasses.replace(piece.observation, record=dataclasses.replace(r, valid=valid))
    assert Directions(s.prepared, s.dictionary, piece).may_be_periodic
    assert not Directions(
        s.prepared, s.dictionary, dataclasses.replace(piece, observation=gap)
    ).may_be_periodic
