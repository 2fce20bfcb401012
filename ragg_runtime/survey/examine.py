"""One flight of a survey: it is diagnosed, and its figures are kept.

A job is text and numbers only, so that it can be sent to any process; the record is the same for any number of workers.
"""

from __future__ import annotations

import json
import socket
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import digest_sources, list_versions
from ragg_runtime.base.progress import one_thread
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification import comparison
from ragg_runtime.identification.diagnose import diagnose_fitted
from ragg_runtime.identification.parameters import SEEN, Estimates
from ragg_runtime.identification.result import Diagnosis, heed_flags
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.io.files import read_recordings
from ragg_runtime.io.mapping import Mapped, parse_mapping
from ragg_runtime.io.record import digest_content
from ragg_runtime.model import derive
from ragg_runtime.screening import screen

Record = dict[str, Any]  # what a survey keeps of a flight: JSON
CONTENT = "content"  # key, in a record, of the digest of what was recorded; not part of the result
RANKED = 5  # effects of the ranking that are kept
BETWEEN = "::"  # between the file and the line of a flight


def fingerprint() -> tuple[tuple[str, str], ...]:
    """(name, version) of everything that figures depend on, with a digest of the program's own text."""
    text = digest_sources("derive", "generated", "ragg_runtime")
    return (("ragg", text[:16]), *((n, list_versions()[n]) for n in ("python", "numpy", "scipy", "sympy")))


@dataclass(frozen=True)
class Job:
    """The model that flights are compared with: model.toml and its path; mapping (text, path, whether it is the model's own).

    ``program``: :func:`fingerprint` of the program that started the survey; ``cluster``: examined on another machine.
    """

    text: str
    path: str
    mapping: tuple[str, str, bool] | None = None
    cluster: bool = False
    program: tuple[tuple[str, str], ...] = field(default_factory=fingerprint)

    def mapped(self) -> Mapped | None:
        if self.mapping is None:
            return None
        text, path, kept = self.mapping
        return replace(parse_mapping(text, Path(path)), kept=kept)


def expand_lines(job: Job, files: Sequence[str]) -> list[str]:
    """The files, and for those with several lines ``file::line`` for each; what cannot be read stays as it is."""
    flights = []
    for file in files:
        try:
            names = [r.line for r in read_recordings(Path(file), job.mapped())]
        except (UserError, OSError):
            names = [None]
        flights += [file] if len(names) == 1 else [f"{file}{BETWEEN}{n}" for n in names]
    return flights


def split_line(file: str) -> tuple[Path, str | None]:
    """The path and the line of ``file::line``; a file of that very name comes first."""
    path, between, line = file.rpartition(BETWEEN)
    if not between or Path(file).exists():
        return Path(file), None
    return Path(path), line


def examine(job: Job, file: str) -> Record:
    """The record of one flight, with ``error`` if it fails. Raises MemoryError and OSError, which a new attempt may mend."""
    record: Record = {"flight": Path(file).name, "file": file}
    try:
        return record | _diagnose_file(job, file)
    except UserError as error:
        return record | {"error": {"kind": "input", "message": error.message}}
    except (MemoryError, OSError):
        raise
    except Exception as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        message = f"{type(error).__name__}: {error} ({Path(frame.filename).name}, line {frame.lineno})"
        return record | {"error": {"kind": "fault", "message": message}}


@one_thread
def _diagnose_file(job: Job, file: str) -> Record:
    path, line = split_line(file)
    _require_same_program(job)
    if job.cluster and not path.exists():
        raise UserError(
            "the worker does not see the flight file",
            where=path,
            found=f"no such file on {socket.gethostname()}",
            expected="a file system that all workers share, under the same path",
            remedy="put the flights where every worker can read them, or survey without --scheduler",
        )
    instrument = parse_instrument(job.text, Path(job.path))
    model = derive.load_model(instrument)
    raw = read_flight(path, instrument.g0, accelerometers=instrument.layout, mapping=job.mapped(), line=line)
    flight = screen(model, instrument, raw)
    return _make_record(fit(model, instrument, observe_flights([flight], instrument)), flight)


def _require_same_program(job: Job) -> None:
    installed, required = dict(fingerprint()), dict(job.program)
    different = [n for n in required if installed.get(n) != required[n]]
    if different:
        raise UserError(
            "the worker runs another version of the program",
            where=socket.gethostname(),
            found=", ".join(f"{n} {installed.get(n)}" for n in different),
            expected=", ".join(f"{n} {required[n]}" for n in different),
            remedy="install the same versions on all workers",
        )


def _make_record(f: Fitted, flight: Flight) -> Record:
    held_out, nominal = comparison.score_with_nominal(f, [f.fit_held_out()])
    extend = partial(derive.with_effects, f.instrument)
    d = heed_flags(diagnose_fitted(f, [flight], extend), [flight])
    holdout = held_out.held_out.as_json()
    record: Record = {
        "sha256": flight.digest,
        CONTENT: digest_content(flight),
        "samples": len(flight),
        "duration_s": flight.duration,
        "rate_Hz": flight.rate,
        "notes": list(flight.notes),
        "verdict": d.verdict,
        "found": list(d.found),
        "indistinguishable": {
            r.effect: list(r.indistinguishable_from) for r in d.ranking if r.effect in d.found
        },
        "ranking": [
            {"effect": r.effect, "log10_p": r.log_p / np.log(10.0), "delta_bic": r.delta_bic}
            for r in d.ranking[:RANKED]
        ],
        "not_testable": [n.effect for n in d.not_testable],
        "error": {
            "nominal": nominal.whole.as_json(),
            "calibrated": d.before.as_json(),
            "holdout": holdout,
            "after": d.after.as_json(),
            "after_holdout": _score_holdout(d, holdout),
        },
        "noise_floor": {"rms_Eo": d.noise_floor},
        "parameters": _list_visible(d),
    }
    if d.remains:
        record["terms"] = d.terms()
    # numbers print and read back exactly: the same figures whichever way a record takes; what is no number is null
    text = json.dumps(record, default=lambda x: x.item())
    return dict(json.loads(text, parse_constant=lambda _: None))


def _score_holdout(d: Diagnosis, holdout: Mapping[str, Any]) -> Mapping[str, Any] | None:
    if d.final is not None:
        (scored,) = d.final.score([d.final.fit_held_out()])
        return scored.held_out.as_json()
    if not d.found:
        return holdout
    return next((r.after_holdout.as_json() for r in d.ranking if d.found == (r.effect,)), None)


def _list_visible(d: Diagnosis) -> list[Record]:
    """Calibrated values of what this record sees: single parameters, else combinations; effects by their id."""
    estimates = Estimates.of_calibration(d.final or d.fitted)
    rows = zip(estimates.columns, estimates.list_parameters(), np.diag(estimates.covariance), strict=True)
    visible = [(q.effect, p) for q, p, variance in rows if variance < SEEN**2]
    for e in dict.fromkeys(q.effect for q in estimates.columns):
        visible += [(e, p) for p in estimates.select(e).list_combinations()]
    if d.final is None:
        visible += [(r.effect, p) for r in d.ranking if r.effect in d.found for p in r.parameters]
    return [p.as_json() | {"name": f"{e}.{p.name}" if e else p.name} for e, p in visible]
