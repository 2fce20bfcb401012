"""The steps of the loop, for the command line and for notebooks: load, compare, diagnose, add, remove.

>>> import ragg_runtime.workflow.loop as ragg                      # doctest: +SKIP
>>> m = ragg.load("my-model")
>>> flights = ragg.read_flights(m, ["flight.csv"])
>>> d = ragg.diagnose(m, flights)
>>> step = ragg.add(m, d.found[0], flights)
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import read_text
from ragg_runtime.diagnosis import comparison as _compare
from ragg_runtime.diagnosis import diagnose as _diagnose
from ragg_runtime.diagnosis.comparison import Comparison
from ragg_runtime.diagnosis.ladder import climb
from ragg_runtime.diagnosis.next_motion import LIMITS
from ragg_runtime.diagnosis.parameters import ParameterValue, parameter_values, visible_combinations
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.flight import Flight
from ragg_runtime.flight import read_flights as _read_flights
from ragg_runtime.flight.landmarks import distinct
from ragg_runtime.flight.mapping import Mapped, parse_mapping, read_mapping
from ragg_runtime.flight.spool import settled
from ragg_runtime.instrument.edit_toml import add_effect, remove_effect, set_effects_folder
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.layout import PAPER
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.instrument.units import RawQuantity, read_quantity
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import missing_channels
from ragg_runtime.model_dir import derive
from ragg_runtime.model_dir.directory import (
    MAPPING,
    ModelDir,
    create_model_dir,
    load_model_dir,
    replace_model_dir,
)
from ragg_runtime.model_dir.history import Step
from ragg_runtime.plausibility import check_settings, examined
from ragg_runtime.survey import Survey
from ragg_runtime.survey import survey as _survey
from ragg_runtime.survey.run import Progress
from ragg_runtime.survey.tls import Tls
from ragg_runtime.wording import notebook

NO_FORM = (
    'model.toml has no [model], which means kinematics = "platform" and order = "paper": as in Eq. 9 of the paper '
    "the accelerometers do not feel that they turn with the disc. Real ones do: with "
    '[model] kinematics = "full" the model knows it'
)


@dataclass(frozen=True, repr=False)
class Loaded:
    """A model directory, the model derived for it, and what was odd, in sentences."""

    directory: ModelDir
    model: Model
    notes: tuple[str, ...] = ()

    @property
    def instrument(self) -> Instrument:
        return self.directory.instrument

    @property
    def name(self) -> str:
        return one_line(self.directory.path.resolve().name)

    def __repr__(self) -> str:
        return f"<Model {self.name}: effects {', '.join(e.id for e in self.model.effects) or 'none'}>"

    def _repr_html_(self) -> str:
        steps = [s.as_json() for s in self.directory.history]
        return notebook.model(self.name, [e.id for e in self.model.effects], steps)


@dataclass(frozen=True, repr=False)
class Added:
    """The result of ``add``: the errors before and after, and the calibrated parameters.

    Where the calibration with the effect in the model has not ``converged``, the model directory is as it was.
    """

    loaded: Loaded
    effect: str
    before: Comparison | None
    after: Comparison | None
    parameters: tuple[ParameterValue, ...]
    combinations: tuple[ParameterValue, ...]

    @property
    def converged(self) -> bool:
        """Whether the effect was added."""
        return self.after is None or self.after.converged

    def __repr__(self) -> str:
        before = None if self.before is None else self.before.calibrated.rms_Eo
        after = None if self.after is None else self.after.calibrated.rms_Eo
        noise = None if self.after is None else self.after.noise_floor
        errors = (("before", before), ("after", after), ("noise", noise))
        return notebook.in_one_line("Added", self.effect, *errors)

    def _repr_html_(self) -> str:
        noise, adequate = (
            (None, False) if self.after is None else (self.after.noise_floor, self.after.adequate)
        )
        return notebook.added(self.as_json(), [e.id for e in self.loaded.model.effects], noise, adequate)

    def as_json(self) -> dict[str, object]:
        return {
            "effect": self.effect,
            "converged": self.converged,
            "reason": None if self.after is None else self.after.complaint,
            "off_sheet": [] if self.after is None else [x.as_json() for x in self.after.off_sheet],
            "before": errors_of(self.before),
            "after": errors_of(self.after),
            "parameters": [p.as_json() for p in self.parameters],
            "combinations": [p.as_json() for p in self.combinations],
        }


def errors_of(c: Comparison | None) -> dict[str, object] | None:
    """The ``error`` of compare: nominal, calibrated, holdout."""
    if c is None:
        return None
    return {
        "nominal": c.nominal.as_json(),
        "calibrated": c.calibrated.as_json(),
        "holdout": c.holdout.as_json(),
    }


def new(path: Path | str, source: Path | None = None, mapping: Path | None = None) -> Loaded:
    """Make a model directory from a test sheet (a model.toml), by default the packaged example.

    ``mapping`` is kept with the model: what the columns of its flight files are.
    """
    kept = None
    if mapping is not None:
        kept = read_text(Path(mapping))
        parse_mapping(kept, Path(mapping))
    if source is None:
        text = resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8")
    else:
        text = read_text(Path(source))
    instrument = parse_instrument(text, Path(source) if source else None)
    if instrument.effects_folder is not None:
        text = set_effects_folder(text, instrument.effects_folder.resolve())
    history = (Step("new", _now(), text=text),)
    made = create_model_dir(path, text, generated=derive.files_of(instrument), history=history, mapping=kept)
    m = _loaded(made)
    return m if tomllib.loads(text).get("model") else replace(m, notes=(*m.notes, NO_FORM))


def load(path: Path | str) -> Loaded:
    """Read a model directory and derive its model."""
    return _loaded(load_model_dir(path))


def _loaded(directory: ModelDir) -> Loaded:
    model = derive.model_of(directory.instrument, directory.generated)
    check_settings(model, directory.instrument)
    note = derive.departure(directory.instrument, directory.generated)
    return Loaded(directory, model, (*directory.notes, *(() if note is None else (note,))))


def read_flights(m: Loaded, paths: Sequence[Path | str], mapping: Path | str | None = None) -> list[Flight]:
    """Read flight files in the units of this model (its g0), and examine them: see ``plausibility``.

    A file with several lines gives as many flights. ``mapping`` is a file that says what the columns are, by
    default the model's own ``mapping.toml``, if it has one.
    """
    how = mapping_of(m, mapping)
    found = []
    for path in paths:
        for x in _read_flights(path, m.instrument.g0, accelerometers=m.instrument.layout, mapping=how):
            found.append(settled(examined(m.model, m.instrument, x)))
    return found


def mapping_of(m: Loaded, given: Path | str | None) -> Mapped | None:
    """The mapping that is given, else the one that is kept with the model, else none."""
    if given is not None:
        return read_mapping(Path(given))
    own = m.directory.path / MAPPING
    return replace(read_mapping(own), kept=True) if own.exists() else None


def compare(m: Loaded, flights: Sequence[Flight], *, ladder: bool = False) -> Comparison:
    """How far the model is from the flights, and where it fails.

    With ``ladder`` also what each of its simplifications, order and kinematics, is worth on these flights.
    """
    distinct(flights)
    c = _compare.compare(m.model, m.instrument, flights)
    if not ladder:
        return c
    return replace(
        c, ladder=climb(m.instrument, flights, lambda form: derive.without_signatures(m.instrument, form))
    )


def diagnose(
    m: Loaded,
    flights: Sequence[Flight],
    limits: Mapping[str, float] = LIMITS,
    compared: Comparison | None = None,
) -> Diagnosis:
    """Which physical effect the model lacks; ``limits`` of a motion to fly next (see :func:`motion_limits`).

    ``compared`` is the comparison of the same model with the same flights, if there is one: then nothing is fitted again.
    """
    distinct(flights)

    def extended(model: Model, ids: Sequence[str], /, *, candidates: bool = False) -> Model:
        return derive.with_effects(m.instrument, model, ids, candidates=candidates)

    if compared is not None:
        return _diagnose.diagnose_fitted(compared.fitted, flights, extended, limits)
    return _diagnose.diagnose(m.model, m.instrument, flights, extended, limits)


def motion_limits(m: Loaded, texts: Sequence[str]) -> Mapping[str, float]:
    """Largest amplitudes of a motion to fly next, SI, from texts such as ``a=50mg`` and ``omega=500deg/h``."""
    found = dict(LIMITS)
    for text in texts:
        name, _, size = text.partition("=")
        if name not in found or not size:
            raise UserError(
                "the limit of a motion cannot be read",
                where="--limit",
                found=text,
                expected="a=50mg or omega=500deg/h",
            )
        q = read_quantity(size, f"--limit {name}", count=1)
        value = m.instrument.units.to_si(
            np.asarray(q.value), q.unit, "m/s^2" if name == "a" else "rad/s", f"--limit {name}"
        )
        if not float(value) > 0.0:
            raise UserError("the limit of a motion must be positive", where=f"--limit {name}", found=size)
        found[name] = float(value)
    return MappingProxyType(found)


def survey(
    m: Loaded,
    flights: Sequence[Path | str],
    *,
    jobs: int | None = None,
    scheduler: str | None = None,
    tls: Tls | None = None,
    resume: Path | None = None,
    progress: Progress | None = None,
    mapping: Path | None = None,
) -> Survey:
    """Diagnose many flights, each by itself, on a pool of processes or a Dask cluster, and sum them up.

    The arguments are those of :func:`ragg_runtime.survey.run.survey`.
    """
    place = m.directory.path / "model.toml"
    how = mapping_of(m, mapping)
    return _survey(
        m.directory.text,
        place,
        flights,
        jobs=jobs,
        scheduler=scheduler,
        tls=tls,
        resume=resume,
        progress=progress,
        mapping=None if how is None else (read_text(how.path), str(how.path.resolve()), how.kept),
    )


def add(
    m: Loaded,
    effect: str,
    flights: Sequence[Flight] = (),
    tell: Callable[[Added], None] | None = None,
    *,
    save: bool = True,
) -> Added:
    """Put an effect into the model: derive it anew, calibrate it on the flights, keep the history.

    An effect that model.toml lists without values (one of your own, say) is calibrated likewise.
    The directory is changed whole or not at all, after ``tell`` has been called with the result: if that raises,
    nothing is changed; nor where the calibration does not converge. Without ``save`` the directory stays, and the result
    says what would be.
    """
    distinct(flights)
    instrument = m.instrument
    symbolic = derive.offered(instrument, effect)
    present = next((s for s in instrument.effects if s.id == effect), None)
    if present is not None and present.values:
        raise UserError(
            "the effect is in the model already",
            where=str(m.directory.path),
            found=effect,
            remedy=f"remove it first: ragg remove {m.directory.path} {effect}",
        )
    for x in flights:
        missing = missing_channels(symbolic, x.channels)
        if missing:
            raise UserError(
                f"the effect {effect} needs a channel that the flight lacks",
                where=x.path or x.name,
                found=f"no {', '.join(missing)}",
                expected="a column of that name with its unit",
                remedy="record it, or choose another effect",
            )
    others = replace(instrument, effects=tuple(s for s in instrument.effects if s.id != effect))
    before = _compare.compare(derive.model_of(others), others, flights) if flights else None
    values: dict[str, RawQuantity] = {}
    if symbolic.kind == "step" and flights:
        values = {"t_step": RawQuantity(_instant(m, effect, flights), "s")}
    expression = present.expression if present is not None else None
    setting = EffectSetting(effect, MappingProxyType(values), expression)
    extended = replace(instrument, effects=(*others.effects, setting))
    model = derive.model_of(extended)
    after: Comparison | None = None
    parameters: tuple[ParameterValue, ...] = ()
    combinations: tuple[ParameterValue, ...] = ()
    if flights:
        after = _compare.compare(model, extended, flights)
        parameters, combinations = calibrated(after, effect)
        values |= settings(parameters, instrument.layout.size)
        with_values = replace(
            extended,
            effects=(*others.effects, EffectSetting(effect, MappingProxyType(values), expression)),
        )
        after = after.with_nominal(with_values)
        if not after.converged:
            made = Added(m, effect, before, after, parameters, combinations)
            if tell is not None:
                tell(made)
            return made
    text = add_effect(m.directory.text, EffectSetting(effect, MappingProxyType(values), expression))
    step = Step(
        "add",
        _now(),
        effect,
        errors_of(before),
        errors_of(after),
        MappingProxyType({x.name: x.digest for x in flights}),
        text,
    )
    made = Added(_planned(m, text, model, step), effect, before, after, parameters, combinations)
    if tell is not None:
        tell(made)
    if not save:
        return replace(made, loaded=m)
    directory = replace_model_dir(
        m.directory, text, generated=derive.files_of(extended), history=(*m.directory.history, step)
    )
    return replace(made, loaded=_loaded(directory))


def _planned(m: Loaded, text: str, model: Model, step: Step) -> Loaded:
    """What the model will be after this step."""
    instrument = parse_instrument(text, m.directory.path / "model.toml")
    history = (*m.directory.history, step)
    return Loaded(replace(m.directory, text=text, instrument=instrument, history=history), model)


def remove(m: Loaded, effect: str, tell: Callable[[Loaded], None] | None = None) -> Loaded:
    """Take an effect out of the model again; ``tell`` as for :func:`add`."""
    text = remove_effect(m.directory.text, effect)
    instrument = parse_instrument(text, m.directory.path / "model.toml")
    step = Step("remove", _now(), effect, text=text)
    if tell is not None:
        tell(_planned(m, text, derive.model_of(instrument), step))
    directory = replace_model_dir(
        m.directory, text, generated=derive.files_of(instrument), history=(*m.directory.history, step)
    )
    return _loaded(directory)


def calibrated(c: Comparison, effect: str) -> tuple[tuple[ParameterValue, ...], tuple[ParameterValue, ...]]:
    """The calibrated parameters of an effect that is in the model, and the combinations that are seen."""
    cal = c.fitted.calibration
    mine = [n for n, column in enumerate(cal.columns) if column.effect == effect]
    columns = [cal.columns[n] for n in mine]
    values = np.array([cal.p[cal.index[n]] / cal.columns[n].scale for n in mine])
    covariance = cal.covariance[np.ix_(mine, mine)]
    return (
        tuple(parameter_values(columns, values, covariance)),
        tuple(visible_combinations(c.fitted.model, cal.p, columns, values, covariance)),
    )


def settings(parameters: Sequence[ParameterValue], count: int = PAPER.size) -> dict[str, RawQuantity]:
    """Calibrated parameters of an effect as they are written to model.toml, ``count`` accelerometers."""
    values: dict[str, RawQuantity] = {}
    for p in parameters:
        if p.accelerometer is None:
            values[p.name] = RawQuantity(p.value, p.unit)
        else:
            old = values.get(p.name)
            each = list(old.value) if old is not None and isinstance(old.value, tuple) else [0.0] * count
            each[p.accelerometer - 1] = p.value
            values[p.name] = RawQuantity(tuple(each), p.unit)
    return values


def _instant(m: Loaded, effect: str, flights: Sequence[Flight]) -> float:
    """The most likely instant of a step."""
    d = _diagnose.diagnose(m.model, m.instrument, flights)
    for r in d.ranking:
        if r.effect == effect:
            for p in r.parameters:
                if p.name == "t_step":
                    return p.value
    return 0.0


def sources(m: Loaded, flights: Sequence[Flight]) -> list[tuple[str, str]]:
    """(name, sha256) of everything that a result depends on."""
    text = hashlib.sha256(m.directory.text.encode()).hexdigest()
    return [(f"{m.name}/model.toml", text), *((x.name, x.digest) for x in flights)]


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
