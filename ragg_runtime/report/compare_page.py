"""The report of ``ragg compare``: how far the model is from the flight, and where it fails."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ragg_runtime.compensation.frozen import Held
from ragg_runtime.identification import series
from ragg_runtime.identification.comparison import LOUD, Comparison
from ragg_runtime.report import figures, page, panels, parameters
from ragg_runtime.report.page import Origin
from ragg_runtime.wording import numbers

HARDLY = 0.05
"""Root of what the error has beyond the noise, over the noise, up to which it is called hardly more."""


def compare_html(
    comparison: Comparison,
    *,
    title: str,
    command: str,
    sources: Sequence[tuple[str, str]],
    notes: Sequence[str] = (),
    frozen: Held | None = None,
) -> str:
    """The report as one HTML document. ``sources`` are (name, sha256) of the files read; ``frozen`` is how a saved
    calibration holds, where it is that which is compared.
    """
    f = comparison.fitted
    context: dict[str, Any] = {
        "kind": "Model against flight",
        "state": "good" if comparison.adequate else "bad",
        "headline": headline(comparison) if frozen is None else held_headline(frozen),
        # where the instrument changed, its parameters are others: no effect is missing
        "lead": lead(comparison)
        if frozen is None
        else held_lead(frozen, lead(comparison, advise=frozen.holds)),
        "facts": panels.facts(f),
        "errors": errors(comparison) if frozen is None else held_errors(frozen),
        "sections": [
            *([] if frozen is None else [held_section(frozen)]),
            *_sections(comparison),
            panels.demodulated_panel(f, comparison.residual),
        ],
        "by_combination": parameters.by_combination(f),
        "by_accelerometer": parameters.by_accelerometer(f),
        "patterns": [name for name, _ in parameters.PATTERNS],
        "visibility": parameters.visibility(f),
        "digest": f.model.digest,
    }
    return page.render("compare.html.j2", Origin(title, command, sources, notes), context)


def headline(c: Comparison) -> str:
    """Calibrated error against noise floor, adequate or not, in one sentence."""
    error, noise = numbers.number(c.calibrated.rms_Eo), numbers.number(c.noise_floor)
    if c.complaint is not None:
        return f"Nothing can be said of the model: {numbers.clean(c.complaint)}."
    if c.adequate:
        return (
            f"The model is adequate: calibrated, it leaves {error} Eo, which is the noise of this record"
            f" ({noise} Eo)."
        )
    excess = c.calibrated.rms_Eo**2 - c.noise_floor**2
    if excess <= (HARDLY * c.noise_floor) ** 2:
        beside = "hardly more than" if excess > 0.0 else "no more than"
        return (
            f"The model is not adequate: calibrated, it leaves {error} Eo, {beside} the noise"
            f" ({noise} Eo), but part of it is systematic."
        )
    return (
        f"The model is not adequate: calibrated, it leaves {error} Eo where the noise is {noise} Eo;"
        f" {numbers.number(math.sqrt(excess), 2)} Eo of it are not noise."
    )


def lead(c: Comparison, *, advise: bool = True) -> list[str]:
    """What follows the headline: the channels, where the error is largest, and if ``advise`` that a diagnosis says why."""
    f = c.fitted
    inline, cross = series.channel_noise(f)
    noise = panels.error_of_noise(c.noise_floor, inline, cross, f.k_ggi)
    said = []
    alone = ""
    if math.isfinite(noise.inline_Eo):
        densities = (noise.inline_Eo_per_rtHz, noise.cross_Eo_per_rtHz)
        alone = "; the noise alone would give {} and {}".format(*map(numbers.number, densities))
    if math.isfinite(c.calibrated.inline_Eo):
        said.append(
            f"In the demodulated channels the residual is {numbers.number(c.calibrated.inline_Eo_per_rtHz)} Eo/√Hz"
            f" inline and {numbers.number(c.calibrated.cross_Eo_per_rtHz)} Eo/√Hz cross{alone}."
        )
    found = c.terms()
    if found:
        t = found[0]
        z = abs(float(str(t["z"])))
        said.append(
            f"The clearest trace is {numbers.harmonic(str(t['harmonic']))} × {numbers.product(str(t['term']))}"
            f" ({numbers.number(z)} standard deviations)."
        )
    blocks = c.by_time()
    if blocks and float(str(blocks[0]["over_noise"])) > LOUD:
        b = blocks[0]
        digits = 0 if float(str(b["to_s"])) - float(str(b["from_s"])) > 10.0 else 1
        where = f" of {numbers.clean(str(b['flight']))}" if len(f.prepared) > 1 else ""
        said.append(
            f"The worst stretch is from {numbers.fixed(float(str(b['from_s'])), digits)} "
            f"to {numbers.fixed(float(str(b['to_s'])), digits)} s"
            f"{where}, with {numbers.number(float(str(b['rms_Eo'])))} Eo."
        )
    if advise and not c.adequate:
        said.append("The command ragg diagnose looks for the physical effect that would account for it.")
    return said


def errors(c: Comparison) -> list[dict[str, Any]]:
    """Rows of the table of errors."""
    return [
        panels.error_row("as model.toml says", c.nominal, "nominal values, nothing fitted"),
        panels.error_row("calibrated", c.calibrated, "parameters fitted to this record"),
        panels.error_row("held out", c.holdout, "fitted on half of the blocks of time, scored on the others"),
        panels.noise_row(c.fitted, c.noise_floor),
    ]


def _sections(c: Comparison) -> list[dict[str, Any]]:
    f = c.fitted
    chosen = series.worst(f, c.residual, panels.FLIGHTS)
    lines = [(figures.ONLY, c.residual)]
    found = [panels.measured_section(f, c.residual)]
    drawn = [
        page.figure(
            figures.in_time(panels.time_panels(f, lines, chosen), "time", "calibrated residual over time"),
            "Calibrated residual before demodulation. Above: least to greatest value and rms in short stretches,"
            " with the noise’s one sigma dashed. Below: rms in each of 24 blocks of time.",
        )
    ]
    if len(chosen) < len(f.prepared):
        drawn[0]["caption"] += f" The {len(chosen)} worst of {len(f.prepared)} flights are drawn."
    found.append({"title": "In time", "text": [], "figures": drawn})
    if spectra := panels.spectrum_panels(f, lines, chosen):
        svg = figures.spectra(spectra, "spectrum", "spectrum of the calibrated residual")
        caption = (
            "Amplitude density of the residual (Welch) and the noise that the fit assumes. Dotted: multiples of"
            " the spin rate. Lines or humps above the dashed curve are error, not noise."
        )
        found.append({"title": "Spectrum", "text": [], "figures": [page.figure(svg, caption)]})
    rest = panels.where_it_fails(c, "where")
    rows = panels.terms(c.terms(), c.calibrated.rms_Eo)
    text = [] if rows else ["No motion term stands out of the residual."]
    found.append({"title": "Where it fails", "text": text, "figures": page.figures(rest), "terms": rows})
    return found


MOVED = 8
"""Combinations that are listed, those that moved furthest first."""


def held_headline(h: Held) -> str:
    """Error with the saved parameters, whether they hold, and what a fit would leave."""
    frozen, free = numbers.number(h.comparison.calibrated.rms_Eo), numbers.number(h.free.rms_Eo)
    noise = numbers.number(h.comparison.noise_floor)
    holds = "The saved calibration holds here" if h.holds else "The saved calibration does not hold here"
    return f"{holds}: it leaves {frozen} Eo, parameters fitted to this record {free} Eo; the noise is {noise} Eo."


def held_lead(h: Held, said: list[str]) -> list[str]:
    """What follows: the test, and what is ``said`` of any error."""
    test = (
        f"Chi-square of the step from the saved parameters to what this record says: {numbers.number(h.chi2)} in"
        f" {h.degrees_of_freedom} directions (p = {h.p_value:.2g})."
    )
    return [test, *said]


def held_errors(h: Held) -> list[dict[str, Any]]:
    """Rows of the table of errors."""
    c = h.comparison
    return [
        panels.error_row("as model.toml says", c.nominal, "nominal values, nothing fitted"),
        panels.error_row("frozen", c.calibrated, "parameters as they were saved, nothing fitted here"),
        panels.error_row("free", h.free, "parameters fitted to this record"),
        panels.noise_row(c.fitted, c.noise_floor),
    ]


def held_section(h: Held) -> dict[str, Any]:
    """What moved since the calibration, and which single parameter would explain it."""
    rows = sorted(h.drift(), key=lambda r: -abs(r["z"]))[:MOVED]
    text = [
        f"{r['flight']}: {r['name']} was {r['frozen']:.5g} ± {r['frozen_std']:.2g}, is {r['value']:.5g} ± {r['std']:.2g}"
        f" {r['unit']} ({r['z']:+.1f} σ)."
        for r in rows
    ]
    text += [
        f"A change of {x['name']} by {x['change']:+.4g} {x['unit']} alone would explain {100 * x['share']:.0f} % of it."
        for x in h.suspects()
    ]
    return {"title": "What moved since it was saved", "text": text, "figures": []}
