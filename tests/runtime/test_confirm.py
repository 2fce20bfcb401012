"""Effects that linear tests choose, once they are in the model: what they do not do there they are not needed for."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ragg_runtime.diagnosis import confirm
from ragg_runtime.evidence.selection import Choice, Field
from ragg_runtime.fit.columns import Column


def chosen_of_three() -> tuple[Field, Choice]:
    """Three effects of a column each, which explain 400, 100 and 25 of what is left, 1,000 besides."""
    T = np.diag([1e3, 1e3, 1e3, 1.0])
    T[:, 3] = [20.0, 10.0, 5.0, np.sqrt(1000.0)]
    names = ("first", "second", "third")
    columns = {
        e: ((n, Column(name=e, accelerometer=None, scale=1.0, unit="1", unit_factor=1.0, effect=e)),)
        for n, e in enumerate(names)
    }
    field = Field(T, 0, columns, rows=1000)
    blocks = {e: (n,) for n, e in enumerate(names)}
    return field, Choice(names, blocks, field.tests(), field.tests(names), 525.0)


@pytest.mark.parametrize(
    ("final", "worth", "kept"),
    [
        (1005.0, {"third": 1.0}, ("first", "second", "third")),  # what was promised: nothing is fitted anew
        (1020.0, {"third": 4.0}, ("first", "second")),
        (1020.0, {"third": 20.0}, ("first", "second", "third")),
        (1090.0, {"third": 4.0, "second": 8.0}, ("first",)),
        (1500.0, {"third": 0.0, "second": 0.0, "first": 0.0}, ()),
    ],
)
def test_effects_are_left_out_that_the_model_does_as_well_without(
    final: float, worth: dict[str, float], kept: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    field, choice = chosen_of_three()
    asked: list[tuple[str, ...]] = []

    def left(f: Any, blocks: Sequence[tuple[Field, str, Any]], *further: Any) -> SimpleNamespace:
        asked.append(tuple(e for _, e, _ in blocks))
        gone = [e for e in choice.chosen if e not in asked[-1]]
        return SimpleNamespace(chi2=final + sum(worth.get(e, 100.0) for e in gone))

    monkeypatch.setattr(confirm, "left_with", left)
    f: Any = SimpleNamespace(calibration=SimpleNamespace(noise=()))
    in_model: Any = SimpleNamespace(calibration=SimpleNamespace(chi2=final))
    extend: Any = None
    found = confirm._needed(f, field, choice, in_model, extend)
    assert found.chosen == kept
    assert bool(asked) == (final > 1009.0)
    assert set(found.blocks) == set(kept)
    assert found.chi2 == pytest.approx(sum({"first": 400, "second": 100, "third": 25}[e] for e in kept))
