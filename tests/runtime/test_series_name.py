"""Names of series: what is printed is what was parsed."""

from __future__ import annotations

import pytest

from ragg_runtime.base.series_name import Channel, Derivative, Function, Relaxation, harmonic, series
from ragg_runtime.identification.dictionary import generic, harmonics


def test_every_name_of_the_dictionary_is_printed_as_it_was_parsed() -> None:
    names = {n for product in generic(["temperature", "time"]) for n in product}
    assert len(names) > 50
    assert [str(series(n)) for n in sorted(names)] == sorted(names)
    assert [str(harmonic(h)) for h in harmonics()] == list(harmonics())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a_x", Channel("a_x")),
        ("d2_a_x", Derivative(Channel("a_x"), 2)),
        ("abs(d_f_i)", Function("abs", Derivative(Channel("f_i"), 1))),
        ("slow(square(a_z), 20 s)", Relaxation(Function("square", Channel("a_z")), "20")),
        ("slow(a_z)", Channel("slow(a_z)")),
        ("abs(a", Channel("abs(a")),
    ],
)
def test_names_are_read(text: str, expected: object) -> None:
    assert series(text) == expected


def test_a_recorded_channel_stands_for_itself_whatever_its_name() -> None:
    assert series("d_x") == Derivative(Channel("x"), 1)
    assert series("d_x", {"d_x"}) == Channel("d_x")
    assert series("abs(d_x)", {"d_x"}) == Function("abs", Channel("d_x"))
