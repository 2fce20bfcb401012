"""How far a model is from a flight, and where it fails."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation import fitted, regressors, unknown_gradient
from ragg_runtime.estimation.calibration import OffSheet, list_off_sheet
from ragg_runtime.estimation.fitted import Fitted, Scored, fit, measure_noise_floor, measure_swell
from ragg_runtime.estimation.observation import combine_output, observe_flights
from ragg_runtime.estimation.scores import Error, demodulate_residual, list_errors
from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.identification import selection, series, several_outputs
from ragg_runtime.identification.dictionary import list_harmonics, make_carrier
from ragg_runtime.identification.omnibus import Remainder, list_terms, search_residual
from ragg_runtime.identification.selection import list_testable, make_field
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.evaluate import make_vector
from ragg_runtime.model.model import Model
from ragg_runtime.signals.demodulate import is_demodulable, low_pass
from ragg_runtime.signals.fir import convolve
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import render_notebook

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


LOUD = 2.0
"""Error over the noise from which the residual is not down to noise, whatever the tests of what is left say. Slow noise, most of whose
power is below the lowest frequency at which its spectrum is estimated, is up to 1.4 times as loud as the estimate (random walks).
"""


@dataclass(frozen=True, repr=False)
class Comparison:
    """The result of ``compare``."""

    fitted: Fitted
    nominal: Error
    scored: Scored
    holdout: Error
    noise_floor: float
    adequate: bool
    remainder: Remainder
    complaint: str | None
    remark: str | None
    off_sheet: tuple[OffSheet, ...]
    explained: Explained
    grounds: tuple[str, ...]
    """Tests by which the model is not adequate, in words."""

    @property
    def converged(self) -> bool:
        """Whether the calibration has converged; if not, ``complaint`` has the reason."""
        return self.complaint is None

    @property
    def calibrated(self) -> Error:
        return self.scored.whole

    @cached_property
    def residual(self) -> list[Array]:
        """(N,) V of every flight, calibrated."""
        return self.fitted.residuals()

    def with_nominal(self, instrument: Instrument) -> Comparison:
        """The same, ``nominal`` being these values."""
        p = make_vector(self.fitted.model, instrument)
        (scored,) = self.fitted.score((), lambda x: compute_nominal_residual(self.fitted, p, x)[None], 1)
        return replace(self, nominal=scored.whole)

    def __repr__(self) -> str:
        errors = (
            ("nominal", self.nominal.rms_Eo),
            ("calibrated", self.calibrated.rms_Eo),
            ("held out", self.holdout.rms_Eo),
            ("noise", self.noise_floor),
        )
        return describe.summarize("Comparison", "adequate" if self.adequate else "not adequate", *errors)

    def _repr_html_(self) -> str:
        return render_notebook(
            describe.describe_comparison(self.as_json(), [o.name for o in self.fitted.observations])
        )

    def as_json(self) -> dict[str, object]:
        f = self.fitted
        records = [o.record for o in f.observations]
        return {
            "effects": [e.id for e in f.model.effects],
            "samples": int(sum(len(o.record.time) for o in f.flights)),
            "duration_s": float(sum(o.record.time[-1] + 1 / o.record.rate for o in f.flights)),
            "rate_Hz": float(records[0].rate),
            "error": list_errors(self.nominal, self.calibrated, self.holdout),
            "noise_floor": series.list_noise_floor(f, self.noise_floor),
            "explained": {"share": self.explained.share},
            "converged": self.converged,
            "reason": self.complaint or self.remark,
            "off_sheet": [x.as_json() for x in self.off_sheet],
            "adequate": self.adequate,
            "grounds": list(self.grounds),
            "where": {
                "harmonics": self.harmonics,
                "time": self.by_time(),
                "motion": self.terms(),
            },
            **self._of_outputs(),
        }

    def _of_outputs(self) -> dict[str, object]:
        """Of an instrument with several outputs each of them, and all together."""
        if len(self.fitted.instrument.layout.outputs) == 1:
            return {}
        return {
            "outputs": several_outputs.list_errors_of_outputs(self.fitted, self.residual),
            "together": [t.as_json() for t in several_outputs.compare_outputs(self.fitted)],
        }

    @cached_property
    def harmonics(self) -> list[dict[str, object]]:
        """Slow error at every harmonic of the spin, Eo, largest first (see :func:`measure_harmonics`)."""
        return measure_harmonics(self.fitted, self.fitted.vector(np.zeros(self.fitted.n_base)))

    def terms(self) -> list[dict[str, object]]:
        """Generic terms in the calibrated residual (see :func:`list_terms`)."""
        return list_terms(self.remainder, self.scored.mean_square)

    def by_time(self) -> list[dict[str, object]]:
        """Error in every block of time, Eo, largest first."""
        rows: list[dict[str, object]] = []
        for x, blocks, k_ggi in zip(
            self.fitted.prepared, self.scored.blocks, self.fitted.scales, strict=True
        ):
            time = x.observation.record.time
            for b, volts in enumerate(blocks):
                if np.isfinite(volts):
                    rms = float(volts) / k_ggi
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


def measure_harmonics(f: Fitted, coefficients: Array) -> list[dict[str, object]]:
    """Residual demodulated at const, cos k, sin k, as the demodulator would see it, largest first."""
    turning = any(x.observation.record.turning for x in f.prepared)
    total = dict.fromkeys(list_harmonics() if turning else ("const",), 0.0)
    counted = 0
    for x, k_ggi in zip(f.prepared, f.scales, strict=True):
        rate = x.observation.record.rate
        if not is_demodulable(rate):
            continue
        taps = low_pass(rate)
        if len(x.observation.record.time) < 2 * len(taps):
            continue
        counted += 1
        squares, samples = dict.fromkeys(total, 0.0), 0
        lean, v = x.for_residuals(coefficients[None])
        tail = np.empty((len(total), 0))

        def mix(piece: Piece, v: Array = v, k_ggi: float = k_ggi) -> Array:
            r = piece.observation.record
            e = np.where(r.valid, piece.left(v)[0], 0.0) / k_ggi
            return np.stack([e * make_carrier(r, h) * (1 if h == "const" else 2) for h in total])

        for mixed in lean.each(mix, whitened=False):
            mixed = np.concatenate([tail, mixed], axis=1)
            if mixed.shape[1] >= len(taps):
                low = convolve(mixed, taps)
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
    observations = observe_flights(flights, instrument)
    f = fit(model, instrument, observations)
    calibrated, half, nominal = _score_three(f)
    if calibrated.whole.rms_V > nominal.whole.rms_V:
        # Whitened least squares may leave more of the noise that it counts little; plain ones cannot.
        noise = f.calibration.noise
        f = fit(model, instrument, observations, noise, unweighted=True)
        calibrated, half, nominal = _score_three(f)
    made = conclude(f, nominal.whole, calibrated, half.held_out)
    still = tuple(q.reason for x in flights for q in x.flags if q.kind == "still")
    # an output that exceeds stationary noise, where motion was not recorded, is not explained
    return replace(made, adequate=False, grounds=still) if made.adequate and made.remark and still else made


def _score_three(f: Fitted) -> tuple[Scored, Scored, Scored]:
    """As calibrated, as fitted to half of the record, and with model.toml's values as they are."""
    calibrated, held_out, nominal = score_with_nominal(f, [np.zeros(f.size), f.fit_held_out()])
    return calibrated, held_out, nominal


def score_with_nominal(f: Fitted, vectors: Sequence[Array]) -> list[Scored]:
    """How large the residuals are with these coefficients (size,), and with the nominal values (last)."""
    p = f.sheet
    return f.score(vectors, lambda x: compute_nominal_residual(f, p, x)[None], 1)


def conclude(f: Fitted, nominal: Error, calibrated: Scored, holdout: Error) -> Comparison:
    """Search the residual, and decide whether the model is adequate."""
    rem, available = search_residual(f), list_testable(f)
    choice = selection.choose(make_field(f, available)) if available else None
    complaint = f.calibration.complaint
    noise = measure_noise_floor(f)
    output_explained = measure_explained(f, calibrated)
    doubt = output_explained.complaint
    grounds = _list_grounds(exceeds_noise(f, calibrated, noise), rem, choice)
    return Comparison(
        fitted=f,
        nominal=nominal,
        scored=calibrated,
        holdout=holdout,
        noise_floor=noise,
        adequate=complaint is None and doubt is None and not grounds,
        remainder=rem,
        complaint=complaint,
        remark=doubt or describe_disturbance(f),
        explained=output_explained,
        grounds=tuple(grounds),
        off_sheet=tuple(list_off_sheet(f.model, f.instrument, f.calibration)),
    )


def _list_grounds(exceeds: bool, rem: Remainder, choice: selection.Choice | None) -> list[str]:
    """The tests by which a model is not adequate, in words."""
    found = ["the error is larger than the noise"] if exceeds else []
    if rem.significant:
        p = numbers.equate_probability(rem.log_p / np.log(10.0))
        found.append(f"test of the motion terms: p {p}")
    if choice is not None and choice.chosen:
        found.append(f"test of the catalogue: {choice.chosen[0]} is significant")
    return found


def exceeds_noise(f: Fitted, scored: Scored, noise: float) -> bool:
    """Whether an error is several times the noise (rms, Eo) and its lines."""
    return scored.whole.rms_Eo > LOUD * float(np.hypot(noise * measure_swell(f), fitted.measure_lines(f)))


def describe_disturbance(f: Fitted) -> str | None:
    """Which lines and jumps the record holds, and how its noise changes its level, in words."""
    said = [
        x.noise.disturbed if len(f.prepared) == 1 else f"{x.observation.name}: {x.noise.disturbed}"
        for x in f.prepared
        if x.noise.disturbed is not None
    ]
    return "; ".join(said) or None


def compute_nominal_residual(f: Fitted, p: Array, piece: Piece) -> Array:
    """Residual of G_out, (N,) V, of a piece of a flight with these values; no unknown gradient."""
    o = piece.observation
    predicted = regressors.predict_observed(f.model, o, p)
    (left,) = piece.observed(np.where(o.record.valid, o.data - predicted, 0.0)[None])
    return np.asarray(left)


def demodulate_one(f: Fitted, n: int, x: Array) -> Complex:
    """Inline + i cross (N,), Eo, of any series of an output (N,), V, of observation n; NaN where there is none."""
    return demodulate_residual(x, f.prepared[n].observation.record, f.scales[n])


@dataclass(frozen=True)
class Explained:
    """What a model explains of the output: the share of its power about its mean, and the gain in description over a constant by
    the BIC (G. Schwarz, Ann. Stat. 6, 1978).
    """

    share: float
    gain: float

    @property
    def complaint(self) -> str | None:
        """In words, that the model explains nothing; ``None`` if it explains something."""
        if self.gain > 0.0:
            return None
        return (
            f"the output does not follow the motion: the model explains {100 * self.share:.2g} % of it, no more than its"
            " parameters would of noise; does the output belong to this flight and instrument?"
        )


def measure_explained(f: Fitted, scored: Scored) -> Explained:
    """What a fitted model that leaves a residual so large (``scored``) explains of the flights' outputs."""
    power = left = rows = 0.0
    parameters = float(f.n_base)
    for o, mean_square in zip(f.observations, scored.mean_square, strict=True):
        valid = o.record.valid
        count = float(np.sum(valid))
        G = combine_output(o, o.data)[valid]
        power += float(np.var(G)) * count
        left += mean_square * count
        rows += count
        if unknown_gradient.is_unknown(o):
            span = float(o.record.time[-1] - o.record.time[0])
            parameters += 2 * (span / unknown_gradient.KNOT_SECONDS + 3)
    ratio = left / power if power > 0.0 else 1.0
    gain = -rows * float(np.log(max(ratio, 1e-300))) - parameters * float(np.log(max(rows, 1.0)))
    return Explained(share=max(0.0, 1.0 - ratio), gain=gain)
