"""How far a model is from a flight, and where it fails."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray
from scipy.signal import oaconvolve

from ragg_runtime.base.threads import one_thread
from ragg_runtime.diagnosis.ladder import Rung
from ragg_runtime.evidence import selection
from ragg_runtime.evidence.selection import field_of, testable_effects
from ragg_runtime.fit import columns
from ragg_runtime.fit.fitted import Fitted, Scored, fit, noise_floor
from ragg_runtime.fit.observation import as_output, observe
from ragg_runtime.fit.passes import Piece
from ragg_runtime.fit.score import Error, channels
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.lack_of_fit.dictionary import carrier, harmonics
from ragg_runtime.lack_of_fit.remainder import Remainder, remainder, terms_json
from ragg_runtime.model.evaluate import vector, voltages
from ragg_runtime.model.model import Model
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.wording import notebook

Array = NDArray[np.float64]


@dataclass(frozen=True, repr=False)
class Comparison:
    """The result of ``compare``: the interface's JSON, and what the report draws."""

    fitted: Fitted
    nominal: Error
    scored: Scored
    holdout: Error
    noise_floor: float
    adequate: bool
    remainder: Remainder
    nominal_values: Array
    ladder: tuple[Rung, ...] = ()

    @property
    def calibrated(self) -> Error:
        return self.scored.whole

    @cached_property
    def residual(self) -> list[Array]:
        """(N,) V of every flight, calibrated."""
        return self.fitted.residuals(np.zeros(self.fitted.n_base))

    @cached_property
    def residual_nominal(self) -> list[Array]:
        """(N,) V of every flight, with the values as they were given."""
        f = self.fitted
        return [
            np.concatenate([*lean.each(partial(nominal_residual, f, self.nominal_values), whitened=False)])
            for lean, _ in (x.for_residuals(np.zeros((1, f.size)), f.n_base) for x in f.flown)
        ]

    def with_nominal(self, instrument: Instrument) -> Comparison:
        """The same, ``nominal`` being these values."""
        p = vector(self.fitted.model, instrument)
        (scored,) = self.fitted.score((), lambda x: nominal_residual(self.fitted, p, x)[None], 1)
        return replace(self, nominal=scored.whole, nominal_values=p)

    def __repr__(self) -> str:
        errors = (
            ("nominal", self.nominal.rms_Eo),
            ("calibrated", self.calibrated.rms_Eo),
            ("held out", self.holdout.rms_Eo),
            ("noise", self.noise_floor),
        )
        return notebook.in_one_line("Comparison", "adequate" if self.adequate else "not adequate", *errors)

    def _repr_html_(self) -> str:
        return notebook.comparison(self.as_json(), [o.name for o in self.fitted.observations])

    def as_json(self) -> dict[str, object]:
        f = self.fitted
        records = [o.record for o in f.observations]
        return {
            "effects": [e.id for e in f.model.effects],
            "samples": int(sum(len(r.time) for r in records)),
            "duration_s": float(sum(r.time[-1] + 1 / r.rate for r in records)),
            "rate_Hz": float(records[0].rate),
            "error": {
                "nominal": self.nominal.as_json(),
                "calibrated": self.calibrated.as_json(),
                "holdout": self.holdout.as_json(),
            },
            "noise_floor": {"rms_Eo": self.noise_floor},
            "adequate": self.adequate,
            "where": {
                "harmonics": self.harmonics,
                "time": self.by_time(),
                "motion": self.terms(),
            },
            **({"ladder": [r.as_json() for r in self.ladder]} if self.ladder else {}),
        }

    @cached_property
    def harmonics(self) -> list[dict[str, object]]:
        """Slow error at every harmonic of the spin, Eo, largest first (see :func:`harmonic_errors`)."""
        return harmonic_errors(self.fitted, self.fitted.vector(np.zeros(self.fitted.n_base)))

    def terms(self) -> list[dict[str, object]]:
        """Generic terms in the calibrated residual (see :func:`terms_json`)."""
        return terms_json(self.remainder, self.scored.mean_square)

    def by_time(self) -> list[dict[str, object]]:
        """Error in every block of time, Eo, largest first."""
        rows: list[dict[str, object]] = []
        for x, blocks in zip(self.fitted.flown, self.scored.blocks, strict=True):
            time = x.observation.record.time
            for b, volts in enumerate(blocks):
                if np.isfinite(volts):
                    rms = float(volts) / self.fitted.k_ggi
                    rows.append(
                        {
                            "flight": x.observation.name,
                            "from_s": float(time[x.edges[b]]),
                            "to_s": float(time[x.edges[b + 1] - 1]),
                            "rms_Eo": rms,
                            "over_noise": rms / self.noise_floor,
                        }
                    )
        return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


def harmonic_errors(f: Fitted, coefficients: Array) -> list[dict[str, object]]:
    """Residual demodulated at const, cos k, sin k, as the demodulator would see it, largest first."""
    total = dict.fromkeys(harmonics(), 0.0)
    counted = 0
    for x in f.flown:
        rate = x.observation.record.rate
        taps = low_pass(rate)
        if len(x.observation.record.time) < 2 * len(taps):
            continue
        counted += 1
        squares, samples = dict.fromkeys(total, 0.0), 0
        lean, v = x.for_residuals(coefficients[None], f.n_base)
        tail = np.empty((len(total), 0))

        def mix(piece: Piece, v: Array = v) -> Array:
            r = piece.observation.record
            e = np.where(r.valid, piece.left(v)[0], 0.0) / f.k_ggi
            return np.stack([e * carrier(r, h) * (1 if h == "const" else 2) for h in total])

        for mixed in lean.each(mix, whitened=False):
            mixed = np.concatenate([tail, mixed], axis=1)
            if mixed.shape[1] >= len(taps):
                low = oaconvolve(mixed, taps[None], mode="valid", axes=1)
                samples += low.shape[1]
                for h, y in zip(total, low, strict=True):
                    squares[h] += float(y @ y)
            tail = mixed[:, -len(taps) + 1 :]
        for h in total:
            total[h] += squares[h] / samples
    power = sum(total.values())
    if not counted:
        return []
    rows: list[dict[str, object]] = [
        {"harmonic": h, "rms_Eo": float(np.sqrt(p / counted)), "share": p / power if power else 0.0}
        for h, p in total.items()
    ]
    return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


@one_thread
def compare(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Comparison:
    """Nominal, calibrated and held-out errors of a model on flights, the noise, and where it fails."""
    f = fit(model, instrument, [observe(x, instrument) for x in flights])
    p = vector(model, instrument)
    half, _ = f.coefficients((), held_out=True)
    calibrated, held_out, nominal = f.score(
        [f.vector(np.zeros(f.n_base)), f.vector(half)], lambda x: nominal_residual(f, p, x)[None], 1
    )
    rem = remainder(f)
    available = testable_effects(f)
    choice = selection.choose(field_of(f, available)) if available else None
    adequate = not rem.significant and not (choice and choice.chosen)
    return Comparison(f, nominal.whole, calibrated, held_out.held_out, noise_floor(f), adequate, rem, p)


def nominal_residual(f: Fitted, p: Array, piece: Piece) -> Array:
    """Residual of G_out, (N,) V, of a piece of a flight with these values."""
    o = piece.observation
    predicted = columns.observed(o, voltages(f.model.chain, o.record, p), None)
    return as_output(o, np.where(o.record.valid, o.data - predicted, 0.0))


def demodulated(f: Fitted, residuals: Sequence[Array]) -> list[tuple[Array, Array, Array]]:
    """(time, inline, cross) of every flight's residual, s and Eo."""
    return [demodulated_one(f, n, e) for n, e in enumerate(residuals)]


def demodulated_one(f: Fitted, flight: int, x: Array) -> tuple[Array, Array, Array]:
    """(time, inline, cross) of any series of G_out of one flight, s and Eo."""
    r = f.flown[flight].observation.record
    return channels(x, r, f.k_ggi, r.valid)
