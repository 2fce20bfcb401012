"""Sheets of instruments with other layouts than the paper's, as a user writes them, and their flights."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.scenario import draw_gradient, draw_motion, perturb
from ragg_runtime.reference.simulate import eotvos_noise, simulate
from tests.simulated import RATE


def accelerometer(name: str, angle: float, sign: int, output: str = "G_out", further: str = "") -> str:
    return (
        f'[[disc.accelerometer]]\nname = "{name}"\nangle = "{angle!r} deg"\nsign = {sign}\noutput = "{output}"\n'
        + further
    )


def disc(
    name: str, accelerometers: Sequence[str], axis: Sequence[float] = (0, 0, 1), spin: float = 0.25
) -> str:
    head = f'[[disc]]\nname = "{name}"\nradius = "0.1 m"\nspin_frequency = "{spin!r} Hz"\n'
    return head + f"axis = {list(axis)}\n" + "".join(accelerometers)


def four(prefix: str, output: str, offset: float = 0.0) -> list[str]:
    """A complement: the paper's four, turned by ``offset`` degrees."""
    places = ((0.0, 1), (180.0, 1), (90.0, -1), (270.0, -1))
    return [accelerometer(f"{prefix}{k + 1}", a + offset, s, output) for k, (a, s) in enumerate(places)]


def sheet(discs: Sequence[str], count: int, head: str = "", seed: int = 1, size: float = 1.0) -> str:
    """A whole model.toml; errors drawn at a usual size."""
    rng = np.random.default_rng(seed)

    def values(scale: float, mean: float = 0.0) -> str:
        return str([float(f"{mean + size * scale * x:.6g}") for x in rng.standard_normal(count)])

    lines = [f'dR = {{ value = {values(20)}, unit = "um" }}']
    lines += [
        f'{n} = {{ value = {values(30)}, unit = "arcsec" }}'
        for n in ("beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z")
    ]
    lines += [f'K0 = {{ value = {values(30)}, unit = "ug" }}']
    lines += [f'K1 = {{ value = {values(1e-3, 10.0)}, unit = "mA/g" }}']
    lines += [f'K{n} = {{ value = {values(10)}, unit = "ug/g^2" }}' for n in (2, 4, 5, 6, 7, 8)]
    lines += ['k_VI = { value = 1e9, unit = "ohm" }']
    return "\n".join(
        ['effects = []\ng0 = "9.8 m/s^2"', head + "".join(discs) + "[accelerometers]", *lines, ""]
    )


FULL = '[model]\nkinematics = "full"\n'
EXACT = '[model]\nkinematics = "full"\norder = "exact"\n'

TILT = float(np.sqrt(2.0 / 3.0))
UMBRELLA = tuple(
    (TILT * float(np.cos(a)), TILT * float(np.sin(a)), float(np.sqrt(1.0 / 3.0)))
    for a in (0.0, 2 * np.pi / 3, 4 * np.pi / 3)
)
"""Three axes at right angles to each other, equally steep (an umbrella)."""


def two() -> list[str]:
    """Two accelerometers, opposite each other."""
    return [disc("A", [accelerometer("A1", 0.0, 1), accelerometer("A2", 180.0, 1)])]


def three() -> list[str]:
    """Three at 120 degrees, which see the gradient in no sum: each by itself is what counts."""
    return [disc("A", [accelerometer(f"A{k + 1}", 120.0 * k, 1, f"G_out_{k + 1}") for k in range(3)])]


def complements() -> list[str]:
    """Eight as two complements of four on one disc, an eighth of a turn apart."""
    return [disc("A", [*four("A", "G_out_A"), *four("B", "G_out_B", 45.0)])]


def umbrella(spin: float = 0.25) -> list[str]:
    """Three discs of four with axes at right angles."""
    return [disc(n, four(n, f"G_out_{n}"), axis, spin) for n, axis in zip("ABC", UMBRELLA, strict=True)]


def oblique() -> list[str]:
    """The paper's four on a vertical disc, a twelfth of a turn on: cosines and sines that differ in their rounding."""
    return [disc("A", four("A", "G_out", 30.0), (1, 0, 0))]


def leaning(axis: Sequence[float], output: str = "G_out", spin: float = 0.25) -> str:
    """A disc with heights and directions."""
    places = [
        accelerometer("A1", 10.0, 1, output, 'height = "0.03 m"\ndirection = [0.2, 0.9, 0.3]\n'),
        accelerometer("A2", 200.0, 1, output, 'radius = "0.12 m"\n'),
        accelerometer("A3", 100.0, -1, output, "direction = [0, -1, 0]\n"),
    ]
    return disc("A", places, axis, spin)


def odd() -> list[str]:
    """A vertical disc with heights and directions, and a disc that stands still beside it."""
    beside = accelerometer("B1", 30.0, 1, "G_out_B", 'direction = [1, 0, 0]\nheight = "-0.2 m"\n')
    return [leaning((1.0, 0.1, 0.0), "G_out_A", 0.3), disc("B", [beside], (0, 0, -1), 0.0)]


def flown_by(sheet: Instrument, duration: float, effects: EffectValues = MappingProxyType({})) -> Flight:
    """``duration`` s of an instrument that the sheet knows to a third of its errors, with white noise of 2 Eo/sqrt(Hz)."""
    s = simulate(
        perturb(sheet, np.random.default_rng(5), 0.3),
        draw_motion(np.random.default_rng(3), duration),
        duration,
        RATE,
        gravity=draw_gradient(np.random.default_rng(4)),
        noise=eotvos_noise(2e-9, 0.1),
        kinematics="full",
        effects={"second-order-misalignment": {"kappa": 0.0}, **effects},
    )
    return s.flight()
