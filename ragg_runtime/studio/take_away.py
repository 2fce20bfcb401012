"""What one takes along: reports, results as JSON, the model, the commands that do the same in a shell."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable, Mapping

from ragg_runtime.base.errors import UserError
from ragg_runtime.report.add_page import add_html
from ragg_runtime.report.compare_page import compare_html
from ragg_runtime.report.diagnose_page import diagnose_html
from ragg_runtime.studio import apply, views
from ragg_runtime.studio.session import State
from ragg_runtime.workflow import after, loop, origin
from ragg_runtime.workflow.branches import branches

File = tuple[str, str, bytes]
HTML, JSON, TEXT = "text/html", "application/json", "text/plain"


def take_away(s: State, what: str) -> File:
    """(name, media type, content) of a file to download."""
    make = FILES.get(what)
    if make is None:
        raise UserError("there is no such file", found=what[:40], expected=", ".join(FILES))
    return make(s)


def _common(s: State) -> dict[str, object]:
    m, flights = s.model, s.flights
    return {
        "title": f"{m.name} and {', '.join(x.name for x in flights)}",
        "sources": loop.sources(m, flights),
        "notes": origin.notes(m, flights),
    }


def _dumped(s: State, result: dict[str, object], command: str) -> bytes:
    return _json(result | origin.origin(s.model, s.flights, command))


def _json(result: dict[str, object]) -> bytes:
    return (json.dumps(result, indent=1, allow_nan=False) + "\n").encode()


def _command(s: State, name: str) -> str:
    return next((c for c in views.commands(s) if c.startswith(f"ragg {name} ")), f"ragg {name}")


def _wait() -> UserError:
    return UserError("there is no result yet", remedy="open a flight and wait until it is compared")


def _compare_report(s: State) -> File:
    if s.compared is None:
        raise _wait()
    page = compare_html(s.compared, command=_command(s, "compare"), **_common(s))  # type: ignore[arg-type]
    return "compare.html", HTML, page.encode()


def _diagnose_report(s: State) -> File:
    if s.diagnosed is None:
        raise _wait()
    page = diagnose_html(s.diagnosed, command=_command(s, "diagnose"), **_common(s))  # type: ignore[arg-type]
    return "diagnosis.html", HTML, page.encode()


def _steps_report(s: State) -> File:
    if s.compared is None or s.previous is None:
        raise UserError("there is no step to report yet", remedy="derive an effect into the model first")
    history = s.model.directory.history
    steps = [history[n].as_json() for n in branches(history)[0]]
    page = add_html(steps, s.previous, s.compared, s.diagnosed, command=_command(s, "history"), **_common(s))  # type: ignore[arg-type]
    return "steps.html", HTML, page.encode()


def _compare_json(s: State) -> File:
    if s.compared is None:
        raise _wait()
    return "compare.json", JSON, _dumped(s, s.compared.as_json(), _command(s, "compare"))


def _diagnose_json(s: State) -> File:
    if s.diagnosed is None:
        raise _wait()
    return "diagnosis.json", JSON, _dumped(s, s.diagnosed.as_json(), _command(s, "diagnose"))


def _compensated(s: State, name: str) -> File:
    if s.compensated is None:
        raise UserError("nothing is compensated yet", remedy="do it under Apply")
    kind = "text/csv" if name.endswith(".csv") else "application/vnd.apache.parquet"
    return name, kind, apply.file_of(s.compensated, name)


def _model(s: State) -> File:
    return "model.toml", "application/toml", s.model.directory.text.encode()


def _exported(s: State, form: str) -> File:
    """The model to run elsewhere, with the calibration that is kept: what ``ragg export`` writes, as one file."""
    files = after.FORMS[form](after.contents(s.model))
    name = f"model-{form}"
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as z:
        for path, text in files.items():
            z.writestr(zipfile.ZipInfo(f"{name}/{path}"), text, zipfile.ZIP_DEFLATED)
    return f"{name}.zip", "application/zip", made.getvalue()


def _commands(s: State) -> File:
    return "commands.sh", TEXT, ("#!/bin/sh\n" + "\n".join(views.commands(s)) + "\n").encode()


FILES: Mapping[str, Callable[[State], File]] = {
    "compare.html": _compare_report,
    "diagnosis.html": _diagnose_report,
    "steps.html": _steps_report,
    "compare.json": _compare_json,
    "diagnosis.json": _diagnose_json,
    "compensated.csv": lambda s: _compensated(s, "compensated.csv"),
    "compensated.parquet": lambda s: _compensated(s, "compensated.parquet"),
    "model.toml": _model,
    "model-c.zip": lambda s: _exported(s, "c"),
    "model-numpy.zip": lambda s: _exported(s, "numpy"),
    "commands.sh": _commands,
}
