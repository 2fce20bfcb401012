"""Results in words, for the terminal, with the command that comes next."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ragg_runtime.base.errors import one_line
from ragg_runtime.io import Flight
from ragg_runtime.report import in_words

if TYPE_CHECKING:
    from ragg_runtime.workflow.after import Kept
    from ragg_runtime.workflow.loop import Added


def command(
    verb: str, model_dir: Path, flights: Sequence[Flight], mapping: Path | None = None, effect: str = ""
) -> str:
    """A command on the same model and flights, as a shell takes it: ``ragg add my-model lag day-1/flight.csv``."""
    files = dict.fromkeys(str(x.path) for x in flights if x.path is not None)
    words = [verb, str(model_dir), *([effect] if effect else []), *files]
    words += [] if mapping is None else ["--map", str(mapping)]
    return one_line(f"ragg {shlex.join(words)}{'' if files else ' FLIGHT'}")


def next_add(model_dir: Path, flights: Sequence[Flight], mapping: Path | None, found: Sequence[str]) -> str:
    """The command that adds the first effect that a diagnosis has found; nothing if it has found none."""
    return command("add", model_dir, flights, mapping, found[0]) if found else ""


def with_notes(text: str, flights: Sequence[Flight]) -> str:
    """A result, and below it what the reader did to the flights."""
    return "\n".join([text, *(f"note: {note}" for x in flights for note in x.notes)])


def added(a: Added, flights: Sequence[Flight] = (), mapping: Path | None = None) -> str:
    """The result of ``add``."""
    done = f"added {a.effect}" if a.converged else f"{a.effect} was NOT added"
    lines = [f"{done}; effects: {', '.join(e.id for e in a.loaded.model.effects) or 'none'}"]
    if a.before is not None and a.after is not None:
        rows = (("before", a.before.calibrated), ("after", a.after.calibrated), ("held out", a.after.holdout))
        lines += [
            *in_words.errors_table(rows, a.after.noise_floor, a.after.fitted),
            "",
            *in_words.not_converged(a.after.complaint),
            in_words.now(a.after),
            *in_words.off_sheet(a.after),
        ]
        lines += in_words.parameters(a.parameters, a.combinations)
        if a.converged and not a.after.adequate:
            lines += ["", f"next: {command('diagnose', a.loaded.directory.path, flights, mapping)}"]
    return with_notes("\n".join(lines), flights)


def calibrated(k: Kept, flights: Sequence[Flight]) -> str:
    """The result of ``calibrate``."""
    c = k.calibrated
    seen, of = c.directions
    found: dict[str, Any] = k.as_json()
    floor = found["noise_floor"]["rms_Eo"]
    rows = (("nominal", c.nominal), ("calibrated", c.error), ("held out", c.holdout))
    lines = [
        f"{', '.join(x.name for x in flights)}: {c.fitted.calibration.rows} samples, effects in the model: "
        f"{', '.join(found['effects']) or 'none'}",
        *in_words.errors_table(rows, floor, c.fitted),
        "" if c.converged else "\nThe fit has NOT converged: do not rely on these values.",
        f"the record determines {seen} of {of} directions of the parameters; the sheet alone says the others:",
        *in_words.combinations(found["combinations"]),
    ]
    if found["drift"]:
        lines.append("\neach flight alone:")
        lines += [
            f"  {q['flight']:28} {q['name']} = {q['value']:.4g} +- {q['std']:.2g} {q['unit']}"
            for q in found["drift"]
        ]
    if k.saved:
        d = k.loaded.directory.path
        use = f"{command('compensate', d, flights)} -o compensated.csv --calibration frozen"
        lines += ["", f"kept in {d}; use it with: {use}"]
    return with_notes("\n".join(lines), flights)
