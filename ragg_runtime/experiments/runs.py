"""The derived models over a simulated record, their errors against the numerical model, and the angle that Table V omits."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from generated import analytical, simplified
from ragg_runtime.experiments.paper import ARCSEC
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.reference import Simulation, disc_angle
from ragg_runtime.reference.scenario import table_v
from ragg_runtime.signals.demodulators import demodulate

Array = NDArray[np.float64]

DERIVED: dict[str, Any] = {"analytical": analytical, "simplified": simplified}
"""Eq. 17-19 and Eq. 42-47, as derived."""

LARGEST = 30.0
"""arcsec: the largest misalignment angle of Table V."""

DRAWS = 1000


class Channels(NamedTuple):
    """Demodulated: (M,) Eo each, at ``time`` (M,) s."""

    time: Array
    inline: Array
    cross: Array


def predict(name: str, run: Simulation) -> Array:
    """G_out, (N,) V, of the ``analytical`` or ``simplified`` model, given the motion and gradients of a run."""
    model, known = DERIVED[name], run.instrument
    values = {"radius": [known.radius], "spin_frequency": [known.spin_frequency], **known.accelerometers}
    p = np.concatenate([values[q] for q, _ in model.PARAMETERS])
    return np.asarray(model.output(run.time, np.stack([run.channels[x] for x in model.INPUTS]), p))


def find_error(name: str, run: Simulation) -> Array:
    """Model error, (N,) V: output of the numerical model *minus* that of a derived one, which gives the paper's signs."""
    return np.asarray(run.G_out - predict(name, run))


def demodulate_run(G: Array, run: Simulation, attenuation: float = 100.0) -> Channels:
    """Inline and cross channel, Eo, of an output or an error (N,) V; ``attenuation`` of the filter, dB."""
    rate = float(1 / (run.time[1] - run.time[0]))
    phi = disc_angle(run.instrument.spin_frequency, run.time)
    d = demodulate(G, phi, rate, run.instrument.scale_factor, attenuation=attenuation)
    return Channels(run.time[d.valid], d.inline / EOTVOS, d.cross / EOTVOS)


def average_turns(G: Array, run: Simulation) -> tuple[float, float]:
    """Inline and cross channel, Eo, by ideal demodulation: the mean over the whole turns of a record."""
    turn = round(1 / (run.instrument.spin_frequency * (run.time[1] - run.time[0])))
    whole = slice(0, run.time.size // turn * turn)
    phi = disc_angle(run.instrument.spin_frequency, run.time[whole])
    g = G[whole] / (run.instrument.scale_factor * EOTVOS)
    return float(np.mean(4 * g * np.sin(2 * phi))), float(-np.mean(2 * g * np.cos(2 * phi)))


def largest(*x: Array) -> float:
    """The largest magnitude."""
    return float(max(np.abs(v).max() for v in x))


def bounds(x: Array) -> tuple[float, float]:
    """Least and greatest."""
    return float(x.min()), float(x.max())


def respond(measure: Callable[[Instrument], Array]) -> tuple[Array, Array]:
    """A measured array without vartheta_x, shape (...), and its change per arcsec of each, (4, ...)."""
    angles = LARGEST * np.eye(4)
    base, *changed = (measure(table_v().replace(vartheta_x=x * ARCSEC)) for x in (np.zeros(4), *angles))
    return base, np.stack([(x - base) / LARGEST for x in changed])


def draw_angles() -> Array:
    """Four vartheta_x, uniform within +-``LARGEST``, (DRAWS, 4) arcsec; the corners of that cube first."""
    corners = LARGEST * np.array(list(product((1.0, -1.0), repeat=4)))
    inside = np.random.default_rng(0).uniform(-LARGEST, LARGEST, (DRAWS - len(corners), 4))
    return np.concatenate([corners, inside])
