"""From fitted flights to the panels of figures, and the rows of tables that all three reports share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.score import Error
from ragg_runtime.identification import comparison, series
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.report import figures, page
from ragg_runtime.report.figures import Bar, ChannelPanel, Line, MeasuredPanel, SpectrumPanel, TimePanel
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]
Residuals = Sequence[Array]

FLIGHTS = 4
"""Flights that are drawn one by one, the worst of all that were given."""

ERROR_COLUMNS = ("rms_V", "rms_Eo", "inline_Eo", "inline_Eo_per_rtHz", "cross_Eo", "cross_Eo_per_rtHz")


def time_panels(f: Fitted, lines: Sequence[tuple[Line, Residuals]], chosen: Sequence[int]) -> list[TimePanel]:
    """Envelope of the last residual of ``lines``, blocks of time of all."""
    found = []
    for n in chosen:
        w = f.prepared[n]
        r = w.observation.record
        rows, edges = [], r.time
        for line, residuals in lines:
            edges, rms = series.blocks(w, residuals[n], f.scales[n])
            rows.append((line, rms))
        e = series.envelope(r.time, lines[-1][1][n] / f.scales[n], r.valid)
        found.append(
            TimePanel(
                name=w.observation.name,
                envelope=e,
                edges=edges,
                blocks=rows,
                noise=series.noise_rms(w, f.scales[n]),
            )
        )
    return found


def spectrum_panels(
    f: Fitted, lines: Sequence[tuple[Line, Residuals]], chosen: Sequence[int]
) -> list[SpectrumPanel]:
    """Spectra of each residual, and the noise of ``f``; flights without a long enough stretch are left out."""
    found = []
    for n in chosen:
        w = f.prepared[n]
        r = w.observation.record
        drawn = []
        for line, residuals in lines:
            s = series.spectrum(residuals[n] / f.scales[n], r.valid, r.rate)
            if s is not None:
                drawn.append((line, s))
        if drawn:
            grid = drawn[0][1].frequency
            spin = abs(r.spin_frequency)
            noise = series.Spectrum(grid, series.noise_density(w, f.scales[n], spin, grid))
            found.append(SpectrumPanel(w.observation.name, drawn, noise, spin))
    return found


def channel_panels(
    f: Fitted, lines: Sequence[tuple[Line, Residuals]], chosen: Sequence[int]
) -> list[ChannelPanel]:
    """Inline and cross of each residual, of each flight that is long enough for the demodulator."""
    found = []
    for n in chosen:
        w = f.prepared[n]
        r = w.observation.record
        made = [(line, comparison.demodulated_one(f, n, residuals[n])) for line, residuals in lines]
        time = made[0][1][0]
        if not len(time):
            continue
        several = f" — {w.observation.name}" if len(f.prepared) > 1 else ""
        # four samples a cycle of the low-pass's edge draw the whole of it
        step = max(1, int(r.rate / (4.0 * series.DRAWN)))
        for k, (title, amplitude) in enumerate((("inline", 4.0), ("cross", 2.0)), 1):
            noise = series.demodulated_noise(w, f.scales[n], abs(r.spin_frequency), 2, amplitude)
            drawn = [(line, series.broken(time[::step], x[k][::step])) for line, x in made]
            found.append(
                ChannelPanel(
                    title=title + several,
                    time=drawn[0][1][0],
                    lines=[(line, y) for line, (_, y) in drawn],
                    noise=noise,
                    ends=(float(r.time[0]), float(r.time[-1])),
                )
            )
    return found


TURNS = 5.0
"""Turns of the disc that are drawn sample by sample: the harmonics of the spin can be told apart by eye."""

SHOWN_SAMPLES = 2000
"""Samples at most of such a stretch, and of one of a disc that does not turn."""


def measured_panel(f: Fitted, residual: Residuals) -> MeasuredPanel:
    """Of the worst flight; the stretch lies in the middle of its worst block of time."""
    (n,) = series.worst(f, residual, 1)
    w = f.prepared[n]
    r = w.observation.record
    y = series.measured(w)
    edges, rms = series.blocks(w, residual[n], f.scales[n])
    k = int(np.nanargmax(rms))
    spin = abs(r.spin_frequency)
    count = int(min(SHOWN_SAMPLES, TURNS * r.rate / spin if spin > 0.0 else SHOWN_SAMPLES, len(r.time)))
    middle = int(np.searchsorted(r.time, 0.5 * (edges[k] + edges[k + 1])))
    first = min(max(0, middle - count // 2), len(r.time) - count)
    part = slice(first, first + count)
    model = y - residual[n]
    return MeasuredPanel(
        measured=series.envelope(r.time, y, r.valid),
        modelled=series.envelope(r.time, model, r.valid),
        ends=(float(r.time[0]), float(r.time[-1])),
        time=r.time[part],
        samples=np.where(r.valid[part], y[part], np.nan),
        model=np.where(r.valid[part], model[part], np.nan),
    )


def measured_section(f: Fitted, residual: Residuals) -> dict[str, Any]:
    """Measured over model: the output itself, beside which the error is small."""
    drawn = measured_panel(f, residual)
    svg = figures.measured_over_model(drawn, "measured", "measured output over the model's")
    first, last = (numbers.number(float(t), 4) for t in (drawn.time[0], drawn.time[-1]))
    caption = f"Above: least to greatest value, the whole record. Below: {first} to {last} s, where the error is largest."
    if len(f.prepared) > 1:
        caption += " Of the flight with the largest error."
    return {"title": "Measured over model", "text": [], "figures": [page.figure(svg, caption)]}


def harmonic_bars(f: Fitted, coefficients: Array) -> list[Bar]:
    """Slow error at every harmonic of the spin, in their own order, with what noise alone gives."""
    rows = {str(x["harmonic"]): float(str(x["rms_Eo"])) for x in comparison.harmonic_errors(f, coefficients)}
    noise = series.harmonic_noise(f, rows)
    # relative uncertainty of the rms of noise in the demodulator's bandwidth, four times over
    seconds = sum(float(w.observation.record.time[-1]) for w in f.prepared)
    limit = 1.0 + 4.0 / np.sqrt(4.0 * series.BAND * max(seconds, 1.0))
    return [
        Bar(numbers.harmonic(h), rows[h], noise[h], rows[h] > limit * noise[h]) for h in noise if h in rows
    ]


def terms(rows: Sequence[Mapping[str, Any]], rms_Eo: float) -> list[dict[str, Any]]:
    """Generic terms of a residual for a table; ``rms`` is their own size in Eo."""
    found = []
    for t in rows:
        found.append(
            {
                "label": f"{numbers.harmonic(t['harmonic'])} × {numbers.product(t['term'])}",
                "coefficient": numbers.plus_minus(float(t["coefficient"]), float(t["std"])),
                "unit": numbers.unit_of_term(str(t["unit"])),
                "z": numbers.number(abs(float(t["z"])), 3),
                "share": numbers.percent(float(t["share"])),
                "rms": float(np.sqrt(float(t["share"]))) * rms_Eo,
            }
        )
    return found


def term_bars(rows: Sequence[Mapping[str, Any]]) -> list[Bar]:
    ordered = sorted(rows, key=lambda t: -float(t["rms"]))
    return [Bar(str(t["label"]), float(t["rms"])) for t in ordered]


def error_row(label: str, e: Error | None, note: str = "") -> dict[str, Any]:
    """A row of the table of errors; ``None`` gives dashes."""
    cells = [numbers.number(getattr(e, k)) if e is not None else numbers.ABSENT for k in ERROR_COLUMNS]
    return {"label": label, "cells": cells, "note": note}


def noise_row(f: Fitted, floor: float) -> dict[str, Any]:
    """What the estimated noise alone would give in each column."""
    inline, cross = series.channel_noise(f)
    return error_row("noise alone", error_of_noise(floor, inline, cross, f.k_ggi))


def error_of_noise(floor: float, inline: float, cross: float, k_ggi: float) -> Error:
    root = float(np.sqrt(series.BAND))
    return Error(
        rms_V=floor * k_ggi,
        rms_Eo=floor,
        inline_Eo=inline,
        cross_Eo=cross,
        inline_Eo_per_rtHz=inline / root,
        cross_Eo_per_rtHz=cross / root,
    )


def holdout_before(f: Fitted) -> Error:
    """Held-out error of the model without further effects, as :func:`ragg_runtime.identification.comparison.compare` makes it."""
    half, _ = f.coefficients((), held_out=True)
    return f.score([f.vector(half)])[0].held_out


def facts(f: Fitted) -> list[tuple[str, str]]:
    """What was recorded and what was fitted."""
    records = [o.unthinned.record for o in f.observations]
    samples = sum(len(r.time) for r in records)
    valid = sum(int(np.sum(r.valid)) for r in records)
    duration = sum(float(r.time[-1]) + 1.0 / r.rate for r in records)
    used = f"{numbers.fixed(samples, 0)} at {numbers.number(records[0].rate, 4)} Hz"
    if valid < samples:
        used += f", {numbers.fixed(samples - valid, 0)} of them not usable"
    thin = {o.record.rate for o in f.observations if o.thin is not None}
    if thin:
        used += f"; thinned to {numbers.number(min(thin), 4)} Hz, which tells as much"
    effects = numbers.listed([e.id for e in f.model.effects]) or "none: the paper’s instrument"
    return [
        ("flights", numbers.listed([numbers.clean(o.name) for o in f.observations])),
        ("duration", numbers.seconds(duration)),
        ("samples", used),
        ("output", f.observations[0].recorded.words),
        ("effects in the model", effects),
        ("k_ggi", f"{numbers.number(f.k_ggi, 4)} V/Eo"),
        ("spin", f"{numbers.number(f.instrument.spin_frequency, 4)} Hz"),
    ]


def where_it_fails(c: Comparison, key: str) -> list[dict[str, str]]:
    """Figures of harmonics and of motion terms of a comparison's residual; ``key`` begins their ids."""
    return remainder_figures(c.fitted, np.zeros(c.fitted.size), terms(c.terms(), c.calibrated.rms_Eo), key)


def remainder_figures(
    f: Fitted, coefficients: Array, rows: Sequence[Mapping[str, Any]], key: str
) -> list[dict[str, str]]:
    """The same of any residual."""
    found = []
    bars = harmonic_bars(f, coefficients)
    if bars:
        label = "error by harmonic of the spin"
        caption = (
            "Residual by harmonic of the spin: it is multiplied by 1, 2 cos kΩt or 2 sin kΩt and low-passed at"
            " 0.2 Hz as the demodulator does. Dashed: what the noise alone gives. Harmonics 2 are the ones that"
            " the demodulator reads as gradient. Bars in grey do not stand out of the noise."
        )
        found.append({"svg": figures.harmonics(bars, f"{key}-harmonic", label), "caption": caption})
    if rows:
        label = "error by motion term"
        caption = "Motion terms that stand out of the residual, by their own size before demodulation."
        shown = term_bars(rows)
        found.append(
            {"svg": figures.lying(shown, f"{key}-terms", label, "Eo rms", None, False), "caption": caption}
        )
    return found


def demodulated_panel(f: Fitted, residual: Residuals, before: Residuals | None = None) -> dict[str, Any]:
    """The demodulated residual: the error of the measured gradients, before a step (if there was one) and after it."""
    chosen = series.worst(f, residual, FLIGHTS)
    lines = [(figures.ONLY, residual)]
    if before is not None:
        lines = [(figures.BEFORE, before), (figures.AFTER, residual)]
    drawn = channel_panels(f, lines, chosen)
    if not drawn:
        said = (
            "The record is too short for the demodulator’s low-pass: there are no inline and cross channels."
        )
        return {"title": "Demodulated channels", "text": [said], "figures": []}
    svg = figures.channels(drawn, "channels", "demodulated residual over time")
    caption = "Demodulated residual: the error of the measured gradients. Dashed: the noise’s one sigma."
    return {"title": "Demodulated channels", "text": [], "figures": [page.figure(svg, caption)]}


def own_effect_panel(d: Diagnosis) -> list[dict[str, Any]]:
    """What no known effect explains, as a line for model.toml: the strongest term as an effect of the user's own."""
    line = None if d.verdict != "unexplained" else d.expression()
    if line is None:
        return []
    text = [
        "To keep the strongest term as an effect of your own, put this line into effects of model.toml, and add it as any"
        " other: ragg add MODEL_DIR my-effect FLIGHT. It says what the output follows, not why."
    ]
    if d.needs():
        text.append(f"The flight then needs further columns: {'; '.join(d.needs())}.")
    return [{"title": "As an effect of your own", "text": text, "code": [line], "figures": []}]
