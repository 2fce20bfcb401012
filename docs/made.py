"""Pages and figures of the site that are not written by hand: from the code, and from the flight that is shipped."""

from __future__ import annotations

import io
import json
import shutil
import tomllib
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

if TYPE_CHECKING:
    from ragg_runtime.identification.comparison import Comparison

HERE = Path(__file__).parent
FLIGHT = HERE.parent / "examples" / "demo-flight.parquet"


def commands() -> str:
    """Every command with its help, as ``--help`` prints it."""
    from ragg_runtime.cli.main import cli

    text = [
        "# Commands",
        "",
        "Look up a command and its options.",
        "",
        "Exit status: 0 done, 2 bad input or usage (one message), 1 a fault of the program.",
        "",
    ]
    root = click.Context(cli, info_name="ragg", max_content_width=100)
    for name in cli.list_commands(root):
        command = cli.get_command(root, name)
        if command is None or command.hidden:
            continue
        context = click.Context(command, info_name=name, parent=root, max_content_width=100)
        text += [f"## ragg {name}", "", "```text", command.get_help(context), "```", ""]
    return "\n".join(text)


def effects() -> dict[str, str]:
    """``effects/<id>.md`` of every effect of the catalogue, and their index."""
    from derive.effects import catalogue
    from derive.emit.render import environment

    limits = detection_limits()
    one, index = (environment("derive.emit").get_template(f"{n}.md.j2") for n in ("effect", "effects"))
    pages = {f"effects/{e.id}.md": one.render(e=e, limits=limits.get(e.id, {})) for e in catalogue()}
    return pages | {"effects.md": index.render(effects=catalogue())}


def detection_limits() -> dict[str, dict[str, str]]:
    """Effect -> parameter -> size, in its display unit, that is three sigma in ten minutes of flight with every channel recorded."""
    from ragg_runtime.estimation.fitted import fit
    from ragg_runtime.estimation.observation import observe_flights
    from ragg_runtime.identification.ranking import list_detectable
    from ragg_runtime.identification.selection import make_problem
    from ragg_runtime.model.model import load_packaged
    from ragg_runtime.reference.scenario import scenario
    from ragg_runtime.reference.simulate import draw_rare

    s = scenario(1, duration=600.0, rate=8.0)
    s = replace(s, auxiliaries={**s.auxiliaries, **draw_rare(np.random.default_rng(1))})
    f = fit(load_packaged(), s.sheet, observe_flights([s.simulate().flight()], s.sheet))
    limits: dict[str, dict[str, str]] = {}
    for x in list_detectable(make_problem(f)):
        limits.setdefault(x.effect, {})[x.name] = f"{x.size:.2g}"
    return limits


def model_toml() -> str:
    """Keys of model.toml: prose with the table of the accelerometers' parameters."""
    from ragg_runtime.instrument.instrument import PARAMETERS

    rows = ["| key | | unit | usual error | if left out |", "|---|---|---|---|---|"]
    for p in PARAMETERS:
        usual = f"{p.plausible:g} of the value" if p.relative else f"{p.plausible:g} {p.display_unit}"
        absent = "an error" if p.required else "0"
        rows.append(
            f"| `{p.name}` | ${p.symbol}$, {p.description} | `{p.display_unit}` | {usual} | {absent} |"
        )
    text = (HERE / "reference" / "model-toml.txt").read_text("utf-8")
    return text.replace("@PARAMETERS@", "\n".join(rows))


def keys(value: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """(path, type) of everything in a JSON document; ``[]`` is any entry of a list, ``*`` any name of :data:`NAMED`."""
    if isinstance(value, dict) and {"rms_V", "inline_Eo"} <= value.keys():
        yield path, "error object"
    elif isinstance(value, dict) and path == "provenance":
        yield path, "object"
    elif isinstance(value, dict):
        named = path.rpartition(".")[2] in NAMED
        for name, x in value.items():
            key = "*" if named else name
            yield from keys(x, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        inner = dict(k for x in value for k in keys(x, f"{path}[]"))
        yield from inner.items() if inner else [(f"{path}[]", "")]
    else:
        kind = {bool: "boolean", int: "number", float: "number", str: "string"}.get(type(value), "null")
        yield path, kind


NAMED = ("quality", "flights", "indistinguishable")
"""Objects whose keys are names: of flags, flights, effects."""


@dataclass(frozen=True)
class Demonstration:
    """The loop on the shipped flight: what each command writes with ``--json``, and what the figure needs."""

    documents: dict[str, Any]
    before: Comparison
    after: Comparison


def demonstration(reports: Path) -> Demonstration:
    """Go through the loop in the current folder, once for all pages; the reports of diagnosis and addition go to ``reports``."""
    from ragg_runtime import api
    from ragg_runtime.cli.main import cli
    from ragg_runtime.report.pages import write_addition, write_diagnosis

    shutil.copy(FLIGHT, FLIGHT.name)
    m = api.new(Path("model"))
    flights = api.read_flights(m, [Path(FLIGHT.name)])
    c = api.compare(m, flights)
    d = api.diagnose(m, flights, compared=c)
    step = api.add(m, d.found[0], flights)
    assert step.after is not None
    source = api.Source("ragg demo", m, flights, title="Demonstration: diagnosis")
    (reports / "diagnosis.html").write_text(write_diagnosis(d, source), "utf-8")
    source = api.Source("ragg demo", step.loaded, flights, title="Demonstration: the effect added")
    steps = [s.as_json() for s in step.loaded.directory.history]
    (reports / "report.html").write_text(write_addition(steps, c, step.after, source), "utf-8")
    documents = {
        name: result | api.Source(f"ragg {name} model", m, flights).as_json()
        for name, result in {"compare": c.as_json(), "diagnose": d.as_json()}.items()
    }
    documents["add"] = step.as_json() | api.Source("ragg add model", step.loaded, flights, before=m).as_json()
    for line in LINES:
        with redirect_stdout(io.StringIO()):
            words = line.replace("FLIGHT", FLIGHT.name).split()
            cli.main([*words, "--json", "written.json"], standalone_mode=False)
        documents[words[0]] = json.loads(Path("written.json").read_text("utf-8"))
    return Demonstration(json.loads(json.dumps(documents)), c, step.after)


LINES = (
    "new another",
    "effects thermal-scale",
    "info FLIGHT",
    "convert FLIGHT flight.csv",
    "calibrate model FLIGHT --save",
    "compensate model FLIGHT -o gradient.parquet --calibration frozen",
    "history model",
    "simulate another -o short.parquet --duration 180",
    "next-motion another short.parquet -o motion.csv",
    "survey another short.parquet --jobs 1",
    "remove model thermal-scale",
)
"""What is run besides ``compare``, ``diagnose`` and ``add`` for the page of JSON: each of the other commands with ``--json``."""


def json_page(documents: dict[str, Any]) -> str:
    """Keys of every command's JSON with type and meaning; a key without a meaning is an error."""
    from ragg_runtime.cli.main import COMMANDS

    meanings = read_meanings()
    text = ["# JSON", "", meanings["head"], ""]
    for name in sorted(documents, key=list(COMMANDS).index):
        text += [f"## {name}", "", "| key | type | meaning |", "|---|---|---|"]
        kinds: dict[str, list[str]] = {}
        for path, kind in keys(documents[name]):
            kinds.setdefault(path, []).append(kind or "empty here")
        for path, of in kinds.items():
            several = [k for k in dict.fromkeys(of) if k != "empty here"] or ["empty here"]
            text.append(f"| `{path}` | {' or '.join(several)} | {meaning(name, path, meanings)} |")
        text.append("")
    return "\n".join(text)


def read_meanings() -> dict[str, Any]:
    """What the keys mean: ``docs/reference/json.toml``."""
    return tomllib.loads((HERE / "reference" / "json.toml").read_text("utf-8"))


def meaning(command: str, path: str, meanings: dict[str, Any]) -> str:
    """Of a key of a command's JSON, by the longest end of its path that is listed, first for the command, then for all."""
    parts = path.replace("[]", "").split(".")
    for listed in (meanings.get(command, {}), meanings["keys"]):
        for k in range(len(parts)):
            if (end := ".".join(parts[k:])) in listed:
                return str(listed[end])
    raise KeyError(f"docs/reference/json.toml has no meaning of {path} of {command}")


def loop_figure(target: Path, shown: Demonstration) -> None:
    """Residual and its spectrum before and after the missing effect is added."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    from scipy import signal

    fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    for c, label in ((shown.before, "before"), (shown.after, "after")):
        residual = c.residual[0] / c.fitted.k_ggi
        record = c.fitted.prepared[0].observation.record
        left.plot(record.time, residual, lw=0.4, label=f"{label}: {c.calibrated.rms_Eo:.2f} Eo rms")
        frequency, density = signal.welch(residual, record.rate, nperseg=2048)
        right.loglog(frequency[1:], np.sqrt(density[1:]), lw=0.8, label=label)
    left.set(xlabel="time, s", ylabel="residual, Eo")
    right.set(xlabel="frequency, Hz", ylabel="residual, Eo/√Hz")
    for axes in (left, right):
        axes.legend(loc="upper right")
    fig.savefig(target, dpi=110)
