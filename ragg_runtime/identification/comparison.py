"""How far a model is from a flight, and where it fails."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread
from ragg_runtime.estimation import fitted, regressors, unknown_gradient
from ragg_runtime.estimation.calibration import OffSheet, list_off_sheet
from ragg_runtime.estimation.fitted import (
    Fitted,
    Scored,
    fit,
    list_noise_floor,
    measure_noise_floor,
    measure_swell,
)
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import Observation, combine_output, observe_flights
from ragg_runtime.estimation.scores import Error, find_whole, list_errors, measure_error
from ragg_runtime.estimation.unknown_gradient import Block, ModelledOutput
from ragg_runtime.identification import selection
from ragg_runtime.identification.dictionary import list_harmonics, make_carrier
from ragg_runtime.identification.omnibus import Remainder, list_terms, search_residual
from ragg_runtime.identification.selection import make_problem
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.io import Flight
from ragg_runtime.model.model import Model, make_vector
from ragg_runtime.signals.demodulators import Tensor, find_demodulator, is_demodulable, low_pass, solve_tensor
from ragg_runtime.signals.fir import convolve
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import render_notebook

Array = NDArray[np.float64]


# error over the noise from which the residual is not down to noise, whatever the tests of what is left say: slow noise may be 1.4
# times as loud as estimated
LOUD = 2.0


@dataclass(frozen=True, repr=False)
class Comparison:
    """The result of ``compare``."""

    fitted: Fitted
    nominal: Error
    scored: Scored
    holdout: Error
    remainder: Remainder
    grounds: tuple[str, ...]
    """Tests by which the model is not adequate, in words."""

    @property
    def adequate(self) -> bool:
        return not (self.complaint or self.explained.complaint or self.grounds)

    @property
    def converged(self) -> bool:
        """Whether the calibration has converged; if not, ``complaint`` has the reason."""
        return self.complaint is None

    @property
    def complaint(self) -> str | None:
        """What speaks against the fit, in words."""
        return self.fitted.calibration.complaint

    @cached_property
    def remark(self) -> str | None:
        """What is wrong with the record, or how it is disturbed, in words."""
        return self.explained.complaint or describe_disturbance(self.fitted)

    @cached_property
    def explained(self) -> Explained:
        return measure_explained(self.fitted, self.scored)

    @cached_property
    def noise_floor(self) -> float:
        """rms of the noise before demodulation, Eo."""
        return measure_noise_floor(self.fitted)

    @property
    def off_sheet(self) -> list[OffSheet]:
        f = self.fitted
        return list_off_sheet(f.model, f.instrument, f.calibration)

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
        return replace(self, nominal=self.fitted.score_residuals(compute_residuals(self.fitted, p)).whole)

    def __repr__(self) -> str:
        errors = {"nominal": self.nominal, "calibrated": self.calibrated, "held out": self.holdout}
        sizes = (*((name, e.rms_Eo) for name, e in errors.items()), ("noise", self.noise_floor))
        return describe.summarize("Comparison", "adequate" if self.adequate else "not adequate", *sizes)

    def _repr_html_(self) -> str:
        return render_notebook(
            describe.describe_comparison(self.as_json(), [o.name for o in self.fitted.observations])
        )

    def errors_json(self) -> dict[str, object]:
        """The ``error`` of the JSON: nominal, calibrated, holdout."""
        return list_errors(self.nominal, self.calibrated, self.holdout)

    def as_json(self) -> dict[str, object]:
        f = self.fitted
        records = [o.record for o in f.observations]
        return {
            "effects": [e.id for e in f.model.effects],
            "samples": int(sum(len(o.record.time) for o in f.flights)),
            "duration_s": float(sum(o.record.time[-1] + 1 / o.record.rate for o in f.flights)),
            "rate_Hz": float(records[0].rate),
            "error": self.errors_json(),
            "noise_floor": list_noise_floor(f, self.noise_floor),
            "explained": {"share": self.explained.share},
            "converged": self.converged,
            "reason": self.complaint or self.remark,
            "off_sheet": [x.as_json() for x in self.off_sheet],
            "adequate": self.adequate,
            "grounds": list(self.grounds),
            "where": {
                "harmonics": measure_harmonics(f, self.residual),
                "time": self.by_time(),
                "motion": self.terms(),
            },
            **self._of_outputs(),
        }

    def _of_outputs(self) -> dict[str, object]:
        """Of an instrument with several outputs: each of them, and all together."""
        f = self.fitted
        if len(f.instrument.layout.outputs) == 1:
            return {}
        return {
            "outputs": [
                {"observation": o.name, "output": o.output.name, **measure_error(e, o.record, k).as_json()}
                for o, e, k in zip(f.observations, self.residual, f.scales, strict=True)
            ],
            "together": [t.as_json() for t in compare_outputs(f)],
        }

    def terms(self) -> list[dict[str, object]]:
        """Generic terms in the calibrated residual (see :func:`list_terms`)."""
        return list_terms(self.remainder, self.scored.mean_square)

    def by_time(self) -> list[dict[str, object]]:
        """Error in every block of time, Eo, largest first."""
        rows: list[dict[str, object]] = []
        for x, blocks, k in zip(self.fitted.prepared, self.scored.blocks, self.fitted.scales, strict=True):
            name, time = x.observation.name, x.observation.record.time
            for first, last, volts in zip(x.edges, x.edges[1:], blocks, strict=False):
                if np.isfinite(volts):
                    rms, ends = float(volts) / k, (float(time[first]), float(time[last - 1]))
                    row = {"flight": name, "from_s": ends[0], "to_s": ends[1], "rms_Eo": rms}
                    rows.append(row | {"over_noise": rms / self.noise_floor})
        return sorted(rows, key=lambda x: -float(str(x["rms_Eo"])))


def measure_harmonics(f: Fitted, residuals: Sequence[Array]) -> list[dict[str, object]]:
    """Residuals (N,), V, demodulated at const, cos k, sin k, as the demodulator would see it, largest first."""
    turning = any(o.record.turning for o in f.observations)
    powers: dict[str, list[float]] = {h: [] for h in (list_harmonics() if turning else ("const",))}
    for o, e, k_ggi in zip(f.observations, residuals, f.scales, strict=True):
        r = o.record
        if not is_demodulable(r.rate) or len(r.time) < 2 * len(low_pass(r.rate)):
            continue
        e = np.where(r.valid, e, 0.0) / k_ggi
        for h, power in powers.items():
            low = convolve(e * make_carrier(r, h) * (1 if h == "const" else 2), low_pass(r.rate))
            power.append(float(np.mean(low**2)))
    mean = {h: float(np.mean(power)) for h, power in powers.items() if power}
    whole = sum(mean.values()) or 1.0
    ordered = sorted(mean.items(), key=lambda x: -x[1])
    return [{"harmonic": h, "rms_Eo": float(np.sqrt(p)), "share": p / whole} for h, p in ordered]


@one_thread
def compare(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Comparison:
    """Nominal, calibrated and held-out errors of a model on flights, the noise, and where it fails."""
    observations = observe_flights(flights, instrument)
    f = fit(model, instrument, observations)
    calibrated, half, nominal = score_with_nominal(f, [np.zeros(f.size), f.fit_held_out()])
    if calibrated.whole.rms_V > nominal.whole.rms_V:
        # Whitened least squares may leave more of the noise that it counts little; plain ones cannot.
        f = fit(model, instrument, observations, f.calibration.noise, unweighted=True)
        calibrated, half, nominal = score_with_nominal(f, [np.zeros(f.size), f.fit_held_out()])
    result = conclude(f, nominal.whole, calibrated, half.held_out)
    still = tuple(q.reason for x in flights for q in x.flags if q.kind == "still")
    # an output that exceeds stationary noise, where motion was not recorded, is not explained
    return replace(result, grounds=still) if result.adequate and result.remark and still else result


def score_with_nominal(f: Fitted, vectors: Sequence[Array]) -> list[Scored]:
    """Scores of the residuals with each of these coefficients (size,), and, last, with the nominal values."""
    return [*f.score(vectors), f.score_residuals(compute_residuals(f, f.sheet))]


def conclude(f: Fitted, nominal: Error, calibrated: Scored, holdout: Error) -> Comparison:
    """Search the residual: by which tests the model is not adequate."""
    rem = search_residual(f)
    chosen = [*selection.choose(make_problem(f))]
    grounds = []
    if exceeds_noise(f, calibrated, measure_noise_floor(f)):
        grounds.append("the error is larger than the noise")
    if rem.significant:
        grounds.append(f"test of the motion terms: {numbers.equate_probability(rem.log_p / np.log(10.0))}")
    if chosen:
        grounds.append(f"test of the catalogue: {chosen[0]} is significant")
    return Comparison(f, nominal, calibrated, holdout, rem, tuple(grounds))


def exceeds_noise(f: Fitted, scored: Scored, noise: float) -> bool:
    """Whether an error is several times the noise (rms, Eo) and its lines."""
    return scored.whole.rms_Eo > LOUD * float(np.hypot(noise * measure_swell(f), fitted.measure_lines(f)))


def describe_disturbance(f: Fitted) -> str | None:
    """Which lines and jumps the record holds, and how its noise changes its level, in words."""
    texts = [
        x.noise.disturbed if len(f.prepared) == 1 else f"{x.observation.name}: {x.noise.disturbed}"
        for x in f.prepared
        if x.noise.disturbed is not None
    ]
    return "; ".join(texts) or None


def compute_residuals(f: Fitted, p: Array) -> list[Array]:
    """Residual of G_out, (N,) V, of every flight with these values; no unknown gradient."""
    return [compute_residual(f.model, x.observation, p, x.noise) for x in f.prepared]


def compute_residual(model: Model, o: Observation, p: Array, noise: NoiseModel) -> Array:
    """The same of one flight, an unknown gradient projected out."""

    def of_segment(rows: slice) -> Array:
        part = o.part(rows)
        windows = unknown_gradient.make_windows(o, rows, noise, whitened=False)
        valid = part.record.valid
        e = np.where(valid, part.data - regressors.predict_observed(model, part, p), 0.0)[None]
        return np.asarray(combine_output(o, unknown_gradient.take_out(e, windows, valid))[0])

    return np.concatenate([of_segment(rows) for rows in o.segments])


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


# --- several outputs of one instrument together: the error of each, the tensor of all, and where they disagree


@dataclass(frozen=True)
class Together:
    """One flight's outputs of turning discs side by side, by their ``places`` in the layout.

    ``seen`` (outputs, N): inline + i cross, Eo, as each saw it, at the ``time`` (N,), s, at which all have a value; ``std`` (outputs,), Eo:
    the noise of cross; that of inline is twice.
    """

    name: str
    layout: Layout
    places: tuple[int, ...]
    time: Array
    seen: NDArray[np.complex128]
    std: Array

    @cached_property
    def tensor(self) -> Tensor | None:
        """The gravity gradient tensor in the measurement frame, Eo; ``None`` where the discs do not determine it."""
        if not self.seen.size:
            return None
        axes = [self.layout.discs[self.layout.outputs[n].disc].across for n in self.places]
        rows = np.stack([self.seen.real, self.seen.imag], axis=1).reshape(2 * len(axes), -1)
        try:
            return solve_tensor(axes, rows, np.outer(self.std, [2.0, 1.0]).ravel())
        except UserError:
            return None

    def differences(self) -> list[dict[str, object]]:
        """Complements on one disc: what differs between them is noise, half of its variance of each."""
        outputs, rows = [self.layout.outputs[n] for n in self.places], list[dict[str, object]]()
        for a, b in combinations(range(len(outputs)), 2):
            if outputs[a].disc == outputs[b].disc and self.seen.size:
                z = (self.seen[a] - self.seen[b]) / np.sqrt(2)
                expected = float(np.hypot(self.std[a], self.std[b]) / np.sqrt(2))
                spreads = {"inline_Eo": float(np.std(z.real)), "cross_Eo": float(np.std(z.imag))}
                predictions = {"expected_inline_Eo": 2 * expected, "expected_cross_Eo": expected}
                rows.append({"outputs": [outputs[a].name, outputs[b].name], **spreads, **predictions})
        return rows

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
    """What the outputs of every flight with several turning discs saw."""
    groups = []
    for first, last in pairwise([*f.first, len(f.observations)]):
        estimates = (
            (n, *_estimate_gradient(f, n)) for n in range(first, last) if f.observations[n].record.turning
        )
        finite = [(n, g, std) for n, g, std in estimates if np.isfinite(g).any()]
        if len(finite) > 1:
            gradients = np.array([g for _, g, _ in finite])
            places = tuple(f.observations[n].place for n, *_ in finite)
            std = np.array([std for *_, std in finite])
            present, o = np.isfinite(gradients).all(axis=0), f.observations[first]
            time, layout = o.record.time[present], f.instrument.layout
            groups.append(Together(o.flight_name, layout, places, time, gradients[:, present], std))
    return groups


def _estimate_gradient(f: Fitted, n: int) -> tuple[NDArray[np.complex128], float]:
    """What an observation's output saw of the gradient, inline + i cross (N,), Eo: all that the calibrated model explains is taken out
    but it (NaN: no value); and the noise of cross, Eo.
    """
    o, p, r = f.observations[n], f.calibration.p, f.observations[n].record
    d = find_demodulator("fir", r.rate)
    g = ModelledOutput(f.model, o, p, (Block(slice(0, len(r.time)), p),), d).estimate_gradient()
    present = find_whole(np.ones_like(r.valid), r.valid, d)
    std = float(np.sqrt(d.pass_power(f.prepared[n].noise_psd, 2 * abs(r.spin_frequency)))) / f.scales[n]
    return np.where(present, g, np.nan), std
