"""`ragg compensate` of other instruments than the paper's: channels of every output, and the tensor of three discs."""

from __future__ import annotations

import dataclasses
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.channel import OutputChannel
from ragg_runtime.compensation.compensate import (
    Kind,
    PreparedFlights,
    make_channel,
    make_columns,
    prepare,
)
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.signals.demodulators import Demodulator
from ragg_runtime.signals.tensor import COMPONENTS
from tests.layouts import sheets
from tests.layouts.flown import flown_by
from tests.rate import RATE

DURATION = 600.0
DISCS = {
    "umbrella": (sheets.umbrella(), 12),
    "complements": (sheets.complements(), 8),
    "odd": (sheets.odd(), 4),
}


@cache
def flown(which: str) -> tuple[Instrument, Flight]:
    """A flight by the reference over a gradient that varies; the sheet knows the instrument to a third of its errors."""
    discs, count = DISCS[which]
    sheet = parse_instrument(sheets.sheet(discs, count, sheets.FULL))
    return sheet, flown_by(sheet, DURATION)


@cache
def compensated(
    which: str, kind: Kind
) -> tuple[PreparedFlights, list[OutputChannel], dict[str, NDArray[Any]]]:
    sheet, flight = flown(which)
    model, _ = derive.derived((), (), sheet.form, sheet.layout)
    p = prepare(model, sheet, [flight], kind)
    channels = [make_channel(p, n, "fir") for n in p.of_flight(0)]
    return p, channels, make_columns(sheet, channels, [c.compensate() for c in channels])


def low_passed(d: Demodulator, x: NDArray[np.float64]) -> NDArray[np.float64]:
    return d.low_passed(x.astype(np.complex128)).real


def true_tensor(flight: Flight) -> NDArray[np.float64]:
    """(3, 3, N) Eo."""
    six = {c: flight.channels[f"Gamma_{c}"] / 1e-9 for c in COMPONENTS}
    return np.array([[six["".join(sorted((i, k)))] for k in "xyz"] for i in "xyz"])


@pytest.mark.parametrize(("which", "kind"), [("umbrella", "self"), ("complements", "crossed")])
def test_channels_of_every_output_are_as_sure_as_they_say(which: str, kind: Kind) -> None:
    """Against the gradient that was flown over, by axes that are computed here."""
    _, flight = flown(which)
    p, channels, found = compensated(which, kind)
    assert p.converged
    G = true_tensor(flight)
    scores = []
    for x in channels:
        disc = p.instrument.layout.discs[x.observation.output.disc]
        end = f"_{disc.name}"
        first = np.array(disc.zero)
        second = np.cross(disc.axis, first)
        inline = np.einsum("i,ijn,j->n", first, G, first) - np.einsum("i,ijn,j->n", second, G, second)
        cross = np.einsum("i,ijn,j->n", first, G, second)
        good = found[f"quality{end}"] == 0
        assert np.mean(good) > 0.9
        for name, true in (("inline", inline), ("cross", cross)):
            z = (found[f"{name}{end}"] - low_passed(x.demodulator, true)) / found[f"{name}{end}_std"]
            scores.append(z[good][:: int(2 * RATE)])
    z = np.concatenate(scores)
    assert 0.6 < np.mean(np.abs(z) < 1.0) < 0.76  # of some 1,100 values, half of them independent
    assert 0.91 < np.mean(np.abs(z) < 1.96) < 0.98


def test_three_discs_give_the_tensor() -> None:
    _, flight = flown("umbrella")
    _, channels, found = compensated("umbrella", "self")
    assert [c for c in found if c.startswith("Gamma_x")] == [
        "Gamma_xx", "Gamma_xy", "Gamma_xz", "Gamma_xx_std", "Gamma_xy_std", "Gamma_xz_std",
    ]  # fmt: skip
    G = true_tensor(flight)
    good = np.isfinite(found["Gamma_xx"])
    scores = []
    for c in COMPONENTS:
        true = low_passed(channels[0].demodulator, G["xyz".index(c[0]), "xyz".index(c[1])])
        scores.append(((found[f"Gamma_{c}"] - true) / found[f"Gamma_{c}_std"])[good][:: int(2 * RATE)])
    z = np.concatenate(scores)
    assert 0.6 < np.mean(np.abs(z) < 1.0) < 0.76
    trace = found["Gamma_xx"] + found["Gamma_yy"] + found["Gamma_zz"]
    assert np.nanmax(np.abs(trace)) < 1e-6
    assert 0.7 < np.std(found["closure"][good]) < 1.4


def test_two_complements_give_no_tensor() -> None:
    assert list(compensated("complements", "crossed")[2]) == [
        "inline_A", "cross_A", "inline_A_std", "cross_A_std", "quality_A",
        "inline_B", "cross_B", "inline_B_std", "cross_B_std", "quality_B",
    ]  # fmt: skip


def test_a_disc_that_stands_still_is_left_out_and_alone_refused() -> None:
    p, _, found = compensated("odd", "self")
    assert len(p.observations) == 2
    assert [n for n in found if n.startswith("inline")] == ["inline_A", "inline_A_std"]
    still = parse_instrument(
        sheets.sheet([sheets.disc("B", [sheets.accelerometer("B1", 0.0, 1)], spin=0.0)], 1)
    )
    model, _ = derive.derived((), (), still.form, still.layout)
    _, flight = flown("odd")
    outputs = {"G_out": flight.outputs["G_out_B"]}
    with pytest.raises(UserError, match="no output of a spinning disc"):
        prepare(model, still, [dataclasses.replace(flight, outputs=outputs)], "self")
