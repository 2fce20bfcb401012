"""What the studio asks of the fitting room, and how it sends long series."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from serving import DEMO, new

from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.evidence import foresee
from ragg_runtime.evidence.selection import field_of
from ragg_runtime.lack_of_fit import heat
from ragg_runtime.model_dir.history import Step
from ragg_runtime.studio.maths import mathml
from ragg_runtime.studio.pyramid import HEAD, pyramid
from ragg_runtime.studio.session import branches
from ragg_runtime.workflow import loop


@pytest.fixture(scope="module")
def diagnosis(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    model = tmp_path_factory.mktemp("m") / "model"
    new(model)
    m = loop.load(model)
    return loop.diagnose(m, loop.read_flights(m, [DEMO]))


@pytest.mark.parametrize(
    "effects", [(), ("thermal-scale",), ("gain-step",), ("lag", "cubic-cross", "magnetic-bias")]
)
def test_what_is_foreseen_is_what_a_pass_over_the_flight_finds(
    diagnosis: Diagnosis, effects: tuple[str, ...]
) -> None:
    f = diagnosis.fitted
    field = field_of(f, [r.effect for r in diagnosis.ranking])
    found = foresee.foreseen(f, foresee.plain(f), field, effects)
    vectors = [foresee.coefficients(f, field, effects, held_out=h) for h in (False, True)]
    whole, half = f.score(vectors)
    assert found.rms_Eo == pytest.approx(whole.whole.rms_Eo, rel=1e-9)
    assert found.holdout_Eo == pytest.approx(half.held_out.rms_Eo, rel=1e-9)


def test_a_signature_is_the_residual_that_goes(diagnosis: Diagnosis) -> None:
    f = diagnosis.fitted
    v = foresee.coefficients(f, field_of(f, ["thermal-scale"]), ["thermal-scale"])
    rows, taken = foresee.signature(f, 0, v)
    assert rows == slice(0, 11520)
    before, after = (f.residuals_of(x)[0] for x in (np.zeros(f.size), v))
    assert np.allclose(taken, before - after, atol=1e-12 * np.max(np.abs(before)))


def test_the_map_of_terms_has_the_search_s_own_best(diagnosis: Diagnosis) -> None:
    from ragg_runtime.lack_of_fit import remainder

    f = diagnosis.fitted
    h = heat.heat(f.flown[0], f.triangles[0], f.n_base)
    best = remainder.remainder(f).searches[0].terms[0]
    at = h.harmonics.index(best.term.harmonic), h.products.index(best.term.product)
    assert h.z[at] == pytest.approx(best.z, rel=1e-6)
    assert abs(best.z) > h.level
    field = field_of(f, ["thermal-scale"])
    given = heat.heat(f.flown[0], f.triangles[0], f.n_base, foresee.columns_of(field, ["thermal-scale"]))
    assert np.nanmax(np.abs(given.z)) < h.level


def test_a_pyramid_loses_no_extreme_and_no_gap() -> None:
    n = 200_003
    x = np.random.default_rng(3).normal(size=n)
    x[77_777], x[123_456] = 50.0, -60.0
    x[10_000:11_000] = np.nan
    p = pyramid(5.0, 0.01, n, lambda s: x[s])
    for first, last, points in (
        (5.0, 2005.03, 700),
        (700.0, 1300.0, 300),
        (781.0, 784.0, 400),
        (0.0, 1e9, 100),
    ):
        data = p.window(first, last, points)
        mark, count, start, step, kind = HEAD.unpack_from(data)
        values = np.frombuffer(data, "<f4", offset=HEAD.size).reshape(1 + kind, count)
        assert mark == b"RAGG"
        assert count <= 8 * points
        half = 0.5 * step if kind else 0.0
        a, b = (
            int(np.clip(np.round((t - 5.0) / 0.01), 0, n))
            for t in (start - half + 0.005 * kind, start + (count - 1) * step + half + 0.005)
        )
        inside = x[a : b + 1].astype(np.float32)
        assert np.nanmax(values) == np.nanmax(inside)
        assert np.nanmin(values) == np.nanmin(inside)
    assert struct.calcsize("<4sIddI") == HEAD.size == 28
    gap = np.frombuffer(p.window(106.0, 114.0, 400), "<f4", offset=HEAD.size)
    assert np.isnan(gap).all()


def test_undo_and_redo_walk_along_a_branch() -> None:
    actions = ["new", "add", "add", "undo", "undo", "redo", "edit", "undo", "redo"]
    steps = [Step(a, "2026-01-01", text=str(n)) for n, a in enumerate(actions)]
    assert branches(steps[:3]) == ([0, 1, 2], [])
    assert branches(steps[:5]) == ([0], [2, 1])
    assert branches(steps[:6]) == ([0, 1], [2])
    assert branches(steps[:7]) == ([0, 1, 6], [])
    assert branches(steps[:8]) == ([0, 1], [6])
    assert branches(steps) == ([0, 1, 6], [])


def test_every_equation_of_the_catalogue_is_typeset() -> None:
    from derive.effects import catalogue

    for e in catalogue():
        for text in (e.equation, *(q.latex for q in e.parameters)):
            assert mathml(text).startswith("<math"), (e.id, text)
    assert mathml("K_x*f_i**2") == "<code>K_x*f_i**2</code>"
    assert "<script" not in mathml("\\text{<script>alert(1)</script>}")
