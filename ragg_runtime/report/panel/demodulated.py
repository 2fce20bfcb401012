"""The demodulated residual: the error of the measured gradients."""

from __future__ import annotations

from ragg_runtime.report import figures, page, panels, series
from ragg_runtime.report.panel import Panel, Shown

REPORTS = ("compare",)


def panel(shown: Shown) -> Panel:
    chosen = series.worst(shown.fitted, shown.residual, panels.FLIGHTS)
    drawn = panels.channel_panels(shown.fitted, shown.residual, chosen)
    if not drawn:
        said = (
            "The record is too short for the demodulator’s low-pass: there are no inline and cross channels."
        )
        return Panel(title="Demodulated channels", text=[said])
    svg = figures.channels(drawn, "channels", "demodulated residual over time")
    caption = "Demodulated residual: the error of the measured gradients. Dashed: the noise’s one sigma."
    return Panel(title="Demodulated channels", figures=[page.figure(svg, caption)])
