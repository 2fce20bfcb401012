"""The figures of one line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality import galileo
from ragg_runtime.survey.quality.discs import Discs, channel, combinations, crossed, ne, uv
from ragg_runtime.survey.quality.limits import Limit
from ragg_runtime.survey.quality.lines import SurveyLine
from ragg_runtime.survey.quality.spectra import BRIDGED, filled, in_band
from ragg_runtime.survey.quality.track import Track
from ragg_runtime.survey.quality.turbulence import Turbulence, turbulence

IN_BAND = (0.03, 0.1)
"""Hz: where densities are averaged. At 50 m/s it is 0.5 to 1.7 km, the wavelengths a survey is flown for; the in-line
sum is filtered to it by custom (galileoQC, ilsNoiseAnalysis)."""

HIGH = {"orthogonal": (0.1, 0.48), "complements": (0.15, 3.6), "single": (0.15, 3.6)}
"""Hz: bands of noise above the signal's, as galileoQC recommends them for FTG and for Falcon (checkHighFreq)."""

_BLOCKS = 8  # of a line, left out in turn for the uncertainty of a phase


@dataclass(frozen=True, eq=False)
class LineFigures:
    """What is found of a line.

    Attributes
    ----------
    line, track, rough
        The line, where it was flown, how rough it was.
    densities
        Name of a channel (UV and NE of a disc) or combination -> Eo/sqrt(Hz) in :data:`IN_BAND`.
    noise
        Name of a combination -> its standard deviation, Eo.
    levels
        Name of a channel or combination -> its mean, Eo.
    figures
        Name of a limit -> the figure that it limits; absent where the record does not give it.
    phase
        Demodulation phase between complements, rad, and its standard deviation.
    galileo
        Figures as galileoQC computes them.
    failed
        Names of the limits that are exceeded.
    """

    line: SurveyLine
    track: Track | None
    rough: Turbulence | None
    densities: Mapping[str, float]
    noise: Mapping[str, float]
    levels: Mapping[str, float]
    figures: Mapping[str, float]
    phase: tuple[float, float] | None
    galileo: Mapping[str, float]
    failed: tuple[str, ...]

    def as_json(self) -> dict[str, Any]:
        x = self.line
        return {
            "line": x.name,
            "file": x.flight,
            "begins": None if x.origin is None else begins(x),
            "samples": len(x),
            "missing": x.missing,
            "duration_s": len(x) / x.rate,
            "rate_Hz": x.rate,
            "length_m": None if self.track is None else self.track.length,
            "heading_deg": None if self.track is None else float(np.degrees(self.track.direction)),
            "altitude_m": mean(x, "altitude"),
            "temperature_K": mean(x, "temperature"),
            "turbulence_m_s2": None if self.rough is None else self.rough.size,
            "density_Eo_per_rtHz": _numbers(self.densities),
            "noise_Eo": _numbers(self.noise),
            "mean_Eo": _numbers(self.levels),
            "figures": _numbers(self.figures),
            "phase_deg": None if self.phase is None else float(np.degrees(self.phase[0])),
            "phase_std_deg": None if self.phase is None else float(np.degrees(self.phase[1])),
            "galileo": _numbers(self.galileo),
            "failed": list(self.failed),
        }


def figures_of(
    line: SurveyLine, discs: Discs, track: Track | None, limits: Mapping[str, Limit]
) -> LineFigures:
    """All figures of one line."""
    rough = turbulence(line)
    named = _named(line, discs)
    made = {c.name: c.values for c in combinations(line, discs)}
    noise = {n: _std(v) for n, v in made.items()}
    found = _limited(line, discs, noise, rough)
    return LineFigures(
        line=line,
        track=track,
        rough=rough,
        densities={n: in_band(v, line.rate, IN_BAND) for n, v in {**named, **made}.items()},
        noise=noise,
        levels={n: float(np.nanmean(v)) for n, v in {**named, **made}.items() if np.isfinite(v).any()},
        figures=found,
        phase=_phase(line, discs),
        galileo=_as_galileo(line, discs),
        failed=tuple(n for n, v in found.items() if v > limits[n].value),
    )


def names(found: Sequence[LineFigures], of: str) -> list[str]:
    """Names of ``densities``, ``noise``, ``levels`` or ``figures`` that any line has."""
    return list(dict.fromkeys(n for f in found for n in getattr(f, of)))


def begins(line: SurveyLine) -> str | None:
    """The instant of the first sample, ISO 8601."""
    from datetime import timedelta

    if line.origin is None:
        return None
    instant = line.origin + timedelta(seconds=float(line.time[0]))
    return instant.isoformat(timespec="milliseconds").replace("+00:00", "Z")


def mean(line: SurveyLine, name: str) -> float | None:
    """The mean of a channel, in its unit; ``None`` where there is none."""
    values = line.channels.get(name)
    return None if values is None or not np.isfinite(values).any() else float(np.nanmean(values))


def _named(line: SurveyLine, discs: Discs) -> dict[str, Array]:
    """UV and NE of every disc."""
    found = {}
    for d in discs.names:
        for what, kind, of in (("UV", "inline", uv), ("NE", "cross", ne)):
            if channel(kind, d) in line.channels:
                found[f"{what} {d}".strip()] = of(line, d)
    return found


def _limited(
    line: SurveyLine, discs: Discs, noise: Mapping[str, float], rough: Turbulence | None
) -> dict[str, float]:
    """Figures that have a limit."""
    found: dict[str, float] = {}
    if "in-line sum" in noise:
        found["in-line-sum"] = noise["in-line sum"]
    if "difference NE" in noise:
        found["difference-noise"] = (noise["difference UV"] + noise["difference NE"]) / 2.0
    kind = "orthogonal" if discs.arrangement == "orthogonal" else "complements"
    low, high = HIGH[discs.arrangement]
    channels = [w for v in _named(line, discs).values() if (w := filled(v)) is not None]
    peaks = [galileo.high_frequency(v, line.rate, low, min(high, 0.48 * line.rate)) for v in channels]
    found[f"high-frequency-{kind}"] = max((p for p in peaks if np.isfinite(p)), default=float("nan"))
    if rough is not None:
        found["vertical-acceleration"] = rough.size
    if discs.arrangement == "complements":
        a, b = (filled(uv(line, d)) for d in discs.names)
        if a is not None and b is not None and np.std(a) > 0 and np.std(b) > 0:
            found["lag"] = abs(galileo.phase_lag(a, b, line.rate))
    if discs.arrangement == "orthogonal":
        six = _six(line, discs)
        if six is not None:
            found["frobenius"] = galileo.frobenius_centred(*six, line.rate)
    return {n: v for n, v in found.items() if np.isfinite(v)}


def _six(line: SurveyLine, discs: Discs) -> tuple[list[Array], list[Array]] | None:
    """UV and NE of three discs without gaps, if they are all there."""
    if not crossed(line, discs):
        return None
    first, second = ([w for d in discs.names if (w := filled(of(line, d))) is not None] for of in (uv, ne))
    return (first, second) if len(first) == len(second) == 3 else None


def _phase(line: SurveyLine, discs: Discs) -> tuple[float, float] | None:
    """Difference of demodulation phase of two complements, rad: half the angle between NE + i UV of both.

    Whether the phases agree shows in what both measure, the gradient; the uncertainty is that of eight blocks of the
    line, left out one by one.
    """
    if discs.arrangement != "complements" or not crossed(line, discs):
        return None
    parts = []
    for d in discs.names:
        z = ne(line, d) + 1j * uv(line, d)
        if not np.isfinite(z).any():
            return None
        parts.append(z - np.nanmean(z))
    product = parts[0] * np.conj(parts[1])
    product = product[np.isfinite(product)]
    if len(product) < 10 * _BLOCKS:
        return None
    blocks = np.array([np.sum(b) for b in np.array_split(product, _BLOCKS)])
    whole = np.angle(np.sum(blocks)) / 2.0
    left = np.angle((np.sum(blocks) - blocks) * np.exp(-2j * whole)) / 2.0
    spread = np.sqrt((_BLOCKS - 1) / _BLOCKS * np.sum((left - np.mean(left)) ** 2))
    return float(whole), float(spread)


def _as_galileo(line: SurveyLine, discs: Discs) -> dict[str, float]:
    found: dict[str, float] = {}
    if discs.arrangement == "orthogonal":
        parts = [w for d in discs.names if (w := filled(uv(line, d))) is not None]
        if len(parts) == 3:
            found["in_line_sum_Eo"] = float(np.std(galileo.in_line_sum(parts)))
            band = galileo.in_line_sum_filtered(parts, line.rate)
            if band is not None:
                found["in_line_sum_filtered_Eo"] = float(np.std(band))
        six = _six(line, discs)
        if six is not None and abs(line.rate - 1.0) < 1e-6:
            found["frobenius_Eo"] = galileo.frobenius(*six)
    if discs.arrangement == "complements":
        a, b = discs.names
        found["difference_noise_UV_Eo"] = galileo.difference_noise(uv(line, a), uv(line, b))
        if crossed(line, discs):
            found["difference_noise_NE_Eo"] = galileo.difference_noise(ne(line, a), ne(line, b))
    height = filled(line.channels["altitude"]) if "altitude" in line.channels else None
    if height is not None:
        found["turbulence_of_altitude"] = galileo.vertical_displacement_turbulence(height)
    return found


def _std(values: Array) -> float:
    there = values[np.isfinite(values)]
    return float(np.std(there)) if len(there) > (1 - BRIDGED) * len(values) else float("nan")


def _numbers(values: Mapping[str, float]) -> dict[str, float | None]:
    return {n: float(v) if np.isfinite(v) else None for n, v in values.items()}
