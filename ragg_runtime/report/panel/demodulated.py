"""The demodulated residual: the error of the measured gradients, before a step and after it."""

from __future__ import annotations

from ragg_runtime.diagnosis import series
from ragg_runtime.report import figures, page, panels
from ragg_runtime.report.panel import Panel, Shown

REPORTS = ("compare", "diagnose", "add")


def panel(shown: Shown) -> Panel:
    chosen = series.worst(shown.fitted, shown.residual, panels.FLIGHTS)
    lines = [(figures.ONLY, shown.residual)]
    if shown.before is not None:
        lines = [(figures.BEFORE, shown.before), (figures.AFTER, shown.residual)]
    drawn = panels.channel_panels(shown.fitted, lines, chosen)
    if not drawn:
        said = (
            "The record is too short for the demodulator’s low-pass: there are no inline and cross channels."
        )
        return Panel(title="Demodulated channels", text=[said])
    svg = figures.channels(drawn, "channels", "demodulated residual over time")
    caption = "Demodulated residual: the error of the measured gradients. Dashed: the noise’s one sigma."
    return Panel(title="Demodulated channels", figures=[page.figure(svg, caption)])
