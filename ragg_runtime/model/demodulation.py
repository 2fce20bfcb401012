"""The low-pass that inline and cross have passed, as a kernel at the record's rate."""

from __future__ import annotations

from functools import cache

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.signals import demodulators
from ragg_runtime.signals.demodulate import CUTOFF
from ragg_runtime.signals.demodulators import Demodulator

UNEVEN = 1e-3
"""How far the rate at which channels were made may be from a multiple of the record's, relatively: clocks are that good."""


@cache
def kernel(d: Demodulation, rate: float) -> Demodulator:
    """Of a record at ``rate``, Hz; where the channels were made at a higher rate, thinned out as they were."""
    every = 1 if d.rate is None else round(d.rate / rate)
    if d.rate is not None and (every < 1 or abs(d.rate / (every * rate) - 1) > UNEVEN):
        raise UserError(
            "the demodulator's rate is no multiple of the record's",
            where="[demodulator] rate",
            found=f"{d.rate:.6g} Hz, the record at {rate:.6g} Hz",
            expected="the rate at which the channels were made, of which the record keeps every second, third ... sample",
        )
    made = _at(d, rate * every)
    made = made.thinned(every) if every > 1 else made
    return made.delayed(d.delay) if d.delay else made


def _at(d: Demodulation, rate: float) -> Demodulator:
    if d.kind == "none":
        return demodulators.none(rate)
    if d.kind == "fir" or (d.cutoff is None and d.length is None):
        return demodulators.fir(rate, CUTOFF if d.cutoff is None else d.cutoff)
    if d.length is not None:
        return demodulators.average(rate, d.length, centred=d.kind == "average")
    build = demodulators.butterworth if d.kind == "butterworth" else demodulators.causal
    return build(rate, d.order or demodulators.ORDER, d.cutoff or demodulators.CUTOFF)
