"""What no known effect explains, as a line for model.toml: the strongest term as an effect of the user's own."""

from __future__ import annotations

from ragg_runtime.report.panel import Panel, Shown

REPORTS = ("diagnose",)


def panel(shown: Shown) -> Panel | None:
    d = shown.diagnosis
    line = None if d is None or d.verdict != "unexplained" else d.expression()
    if d is None or line is None:
        return None
    text = [
        "To keep the strongest term as an effect of your own, put this line into effects of model.toml, and add it as any"
        " other: ragg add MODEL_DIR my-effect FLIGHT. It says what the output follows, not why."
    ]
    if d.needs():
        text.append(f"The flight then needs further columns: {'; '.join(d.needs())}.")
    return Panel(title="As an effect of your own", text=text, code=[line])
