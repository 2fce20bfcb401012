"""Round-off of the generated code against the same instrument at 50 digits."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from derive.propagation import Collected
from derive.simplify import simplified as simplified_model
from generated import analytical, folded, simplified
from tests.generated import compiled, draws
from tests.generated import fifty_digits as fifty
from tests.generated.draws import Array

SECONDS = (0.0, 1e6)


@pytest.fixture(scope="module")
def library() -> dict[str, compiled.Library]:
    return compiled.committed()


def cases(start: float, seed: int, count: int = 10) -> list[tuple[Array, Array, Array]]:
    """(t, inputs, p): instants of one turn of the disc from ``start``."""
    draw = np.random.default_rng(seed)
    return [
        (start + draw.uniform(0, 4, 6), draws.motion(draw, 6), draws.instrument(draw)) for _ in range(count)
    ]


def error_eotvos(found: Array, true: list[object], p: Array) -> float:
    """Largest difference from the 50-digit value, in Eo of gradient signal."""
    difference = [float(fifty.real(float(g)) - v) for g, v in zip(found, true, strict=True)]
    return float(np.max(np.abs(difference))) / draws.signal(p) / draws.EOTVOS


def true_output(t: Array, inputs: Array, p: Array, model: Collected | None) -> list[object]:
    """At 50 digits: the instrument itself, or a collected model."""
    q = fifty.exact(p)
    found = []
    for n, instant in enumerate(fifty.exact(t)):
        x = fifty.exact(inputs[:, n])
        if model is None:
            found.append(fifty.output(instant, x, q))
        else:
            found.append(fifty.from_amplitudes(fifty.amplitudes(model, x, q), instant, q[1]))
    return found


@pytest.mark.parametrize("start", SECONDS)
def test_analytical_output_within_a_millionth_of_an_eotvos(
    start: float, library: dict[str, compiled.Library]
) -> None:
    outputs = {
        "analytical.py": analytical.output,
        "analytical.c": library["analytical"].output,
        "folded.py": folded.output,
        "folded.c": library["folded"].output,
    }
    worst = dict.fromkeys(outputs, 0.0)
    for t, inputs, p in cases(start, seed=1):
        true = true_output(t, inputs, p, None)
        for name, output in outputs.items():
            worst[name] = max(worst[name], error_eotvos(output(t, inputs, p), true, p))
    assert max(worst.values()) < 1e-6, worst
    assert max(worst["folded.py"], worst["folded.c"]) < 2e-7, worst  # the price of float64 channels is 1e-7


@pytest.mark.parametrize(
    ("processor", "most"), [(compiled.NATIVE, 1.2e-16), ((), 1.4e-16)], ids=["native", "any"]
)
def test_fast_sine_and_cosine_are_good_to_the_last_bit(
    processor: tuple[str, ...], most: float
) -> None:
    """Read off the model itself: a force along x of an instrument whose A1 alone has a gain is -sin or cos.

    Any processor of a family may have to round products before it adds to them.
    """
    model = compiled.committed(processor, ("folded",))["folded"]
    draw, spin = np.random.default_rng(6), 0.2503
    t = np.concatenate([x + draw.uniform(0, 8, 60) for x in (-1e3, 1e6, 2e9)] + [np.arange(-4, 4, 0.5)])
    p = np.zeros(analytical.SIZE)
    at = {name: 2 + 4 * (n - 2) for n, (name, _) in enumerate(analytical.PARAMETERS)}
    p[1], p[at["K1"]], p[at["k_VI"]] = spin, 1.0, 1.0
    for axis, by_encoder in product((0, 1), (False, True)):
        inputs = np.zeros((15, len(t)))
        inputs[axis] = 1.0
        found = model.output(t, inputs, p, t if by_encoder else None)
        for instant, value in zip(t, found, strict=True):
            angle = fifty.real(float(instant))
            if not by_encoder:
                angle *= 2 * fifty.CONTEXT.pi * fifty.real(spin)
            true = (-fifty.CONTEXT.sin(angle), fifty.CONTEXT.cos(angle))[axis]
            assert abs(float(fifty.real(float(value)) - true)) < most


@pytest.mark.parametrize("start", SECONDS)
def test_simplified_output_within_a_millionth_of_an_eotvos(
    start: float, library: dict[str, compiled.Library]
) -> None:
    worst = {"numpy": 0.0, "c": 0.0}
    model = simplified_model()
    for t, inputs, p in cases(start, seed=2):
        true = true_output(t, inputs, p, model)
        for name, output in (("numpy", simplified.output), ("c", library["simplified"].output)):
            worst[name] = max(worst[name], error_eotvos(output(t, inputs, p), true, p))
    assert max(worst.values()) < 1e-6, worst


def test_disc_angle_loses_nothing_with_time() -> None:
    """At a frequency that is no binary fraction the product f t is rounded by 1e-10 turn after 1e6 s."""
    t = 1e6 + np.random.default_rng(3).uniform(0, 4, 200)
    f = 0.2503
    lost = 0.0
    for instant, angle in zip(t, analytical.disc_angle(t, f), strict=True):
        turns = fifty.real(f) * fifty.real(float(instant))
        true = 2 * fifty.CONTEXT.pi * (turns - fifty.CONTEXT.nint(turns))
        lost = max(lost, abs(float(fifty.real(float(angle)) - true)))
    assert lost < 1e-15
    assert np.max(np.abs(analytical.disc_angle(t, f))) <= np.pi


def test_jacobian_is_the_derivative_of_the_instrument(library: dict[str, compiled.Library]) -> None:
    """Against central differences at 50 digits, which are exact to 1e-30."""
    t, inputs, p = cases(1e6, seed=4, count=1)[0]
    q = fifty.exact(p)
    true = np.empty((len(p), len(t)))
    for n, instant in enumerate(fifty.exact(t)):
        x = fifty.exact(inputs[:, n])
        for k in range(len(p)):
            step = fifty.real(10) ** -18 * (abs(q[k]) if q[k] else 1)
            up, down = (fifty.output(instant, x, [*q[:k], q[k] + s, *q[k + 1 :]]) for s in (step, -step))
            true[k, n] = float((up - down) / (2 * step))
    scale = np.max(np.abs(true), axis=1, keepdims=True)
    names = [n for n, size in analytical.PARAMETERS for _ in range(size)]
    zero = [n for n, s in zip(names, scale[:, 0], strict=True) if s == 0]
    assert zero == ["vartheta_x"] * 4  # it turns about the input axis' normal: no first-order effect (Eq. 5a)
    scale[scale == 0] = 1.0
    for jacobian in (analytical.jacobian, library["analytical"].jacobian):
        wrong = np.max(np.abs(jacobian(t, inputs, p) - true) / scale, axis=1)
        assert np.max(wrong) < 1e-11, {n: w for n, w in zip(names, wrong, strict=True) if w >= 1e-11}
