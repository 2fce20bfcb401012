"""Several outputs of one instrument together: the error of each, the tensor of all, and where they disagree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.scores import find_whole, measure_error
from ragg_runtime.estimation.unknown_gradient import Block, ModelledOutput
from ragg_runtime.signals.demodulators import Tensor, find_demodulator, tensor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Seen:
    """The gradient as one output saw it: time (N,) s, inline and cross (N,) Eo, and the noise of cross, Eo: that of inline is twice."""

    place: int
    time: Array
    inline: Array
    cross: Array
    cross_std: float


@dataclass(frozen=True)
class Together:
    """One flight's outputs side by side: its name, and the gradient by each output of a turning disc."""

    name: str
    fitted: Fitted
    seen: tuple[Seen, ...]

    @cached_property
    def common(self) -> Array:
        """(N,) s: where all outputs have a value."""
        found = self.seen[0].time
        for s in self.seen[1:]:
            found = np.intersect1d(found, s.time)
        return np.asarray(found)

    def at(self, s: Seen) -> tuple[Array, Array]:
        """Inline and cross of an output where all have a value."""
        here = np.isin(s.time, self.common)
        return s.inline[here], s.cross[here]

    @cached_property
    def tensor(self) -> Tensor | None:
        """The gravity gradient tensor in the measurement frame, Eo; ``None`` where the discs do not determine it."""
        layout = self.fitted.instrument.layout
        if not len(self.common):
            return None
        rows: list[Array] = []
        std: list[float] = []
        axes = []
        for s in self.seen:
            rows.extend(self.at(s))
            std += [2 * s.cross_std, s.cross_std]
            axes.append(layout.discs[layout.outputs[s.place].disc].across)
        try:
            return tensor(axes, np.array(rows), np.array(std))
        except UserError:
            return None

    def differences(self) -> list[dict[str, object]]:
        """Complements on one disc: what differs between them is noise, half of its variance of each."""
        layout = self.fitted.instrument.layout
        found: list[dict[str, object]] = []
        for a, b in combinations(self.seen, 2):
            if layout.outputs[a.place].disc != layout.outputs[b.place].disc or not len(self.common):
                continue
            inline, cross = (x - y for x, y in zip(self.at(a), self.at(b), strict=True))
            expected = float(np.hypot(a.cross_std, b.cross_std) / np.sqrt(2))
            found.append(
                {
                    "outputs": [layout.outputs[a.place].name, layout.outputs[b.place].name],
                    "inline_Eo": float(np.std(inline) / np.sqrt(2)),
                    "cross_Eo": float(np.std(cross) / np.sqrt(2)),
                    "expected_inline_Eo": 2 * expected,
                    "expected_cross_Eo": expected,
                }
            )
        return found

    def as_json(self) -> dict[str, object]:
        figures: dict[str, object] = {"flight": self.name, "noise_between_complements": self.differences()}
        t = self.tensor
        if t is not None:
            figures["tensor"] = {
                "mean_Eo": [float(x) for x in np.mean(t.gamma, axis=1)],
                "std_Eo": [float(x) for x in t.std],
                "closure": t.quality,
            }
        return figures


def compare_outputs(f: Fitted) -> list[Together]:
    """Of every flight with several turning outputs what they saw."""
    found = []
    for first, last in pairwise([*f.first, len(f.observations)]):
        records = {n: f.observations[n].record for n in range(first, last)}
        own = [n for n, r in records.items() if r.turning]
        seen = tuple(s for s in (estimate_gradient(f, n) for n in own) if len(s.time))
        if len(seen) > 1:
            found.append(Together(name=f.observations[first].flight_name, fitted=f, seen=seen))
    return found


def estimate_gradient(f: Fitted, n: int) -> Seen:
    """What an observation's output saw of the gradient: all that the calibrated model explains is taken out but it."""
    o, p, k_ggi = f.observations[n], f.calibration.p, f.scales[n]
    r = o.record
    d = find_demodulator("fir", r.rate)
    g = ModelledOutput(f.model, o, p, (Block(slice(0, len(r.time)), p),), d).estimate_gradient()
    there = find_whole(np.ones_like(r.valid), r.valid, d)
    cross = float(np.sqrt(d.pass_power(f.prepared[n].noise_psd, 2 * abs(r.spin_frequency)))) / k_ggi
    return Seen(o.place, r.time[there], g[there].real, g[there].imag, cross)


def list_errors_of_outputs(f: Fitted, residuals: Sequence[Array]) -> list[dict[str, object]]:
    """The error object of every output of every flight."""
    return [
        {"observation": o.name, "output": o.output.name, **measure_error(e, o.record, k).as_json()}
        for o, e, k in zip(f.observations, residuals, f.scales, strict=True)
    ]
