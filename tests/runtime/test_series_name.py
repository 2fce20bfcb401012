"""Names of series: what is printed is what was parsed."""

from __future__ import annotations

import pytest

from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Relaxation, harmonic, series
from ragg_runtime.identification.dictionary import harmonics, list_generic


def test_every_name_of_the_dictionary_is_printed_as_it_was_parsed() -> None:
    names = {n for product in list_generic(["temperature", "time"]) for n in product}
    assert len(names) > 50
    assert [str(series(n)) for n in sorted(names)] == sorted(names)
    assert [str(harmonic(h)) for h in harmonics()] == list(harmonics())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a_x", ChannelName("a_x")),
        ("d2_a_x", Derivative(ChannelName("a_x"), 2)),
        ("abs(d_f_i)", Function("abs", Derivative(ChannelName("f_i"), 1))),
        ("slow(square(a_z), 20 s)", Relaxation(Function("square", ChannelName("a_z")), "20")),
        ("slow(a_z)", ChannelName("slow(a_z)")),
        ("abs(a", ChannelName("abs(a")),
    ],
)
def test_names_are_read(text: str, expected: object) -> None:
    assert series(text) == expected


def test_a_recorded_channel_stands_for_itself_whatever_its_name() -> None:
    assert series("d_x") == Derivative(ChannelName("x"), 1)
    assert series("d_x", {"d_x"}) == ChannelName("d_x")
    assert series("abs(d_x)", {"d_x"}) == Function("abs", ChannelName("d_x"))
