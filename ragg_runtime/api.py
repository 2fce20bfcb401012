"""The steps of ragg for the command line, the studio and notebooks (``import ragg``).

>>> import ragg                                                    # doctest: +SKIP
>>> m = ragg.load("my-model")
>>> flights = ragg.read_flights(m, ["flight.csv"])
>>> d = ragg.diagnose(m, flights)
>>> step = ragg.add(m, d.found[0], flights)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation import calibrate as _calibrate
from ragg_runtime.compensation import compensate as _compensate
from ragg_runtime.compensation import recursive as _recursive
from ragg_runtime.compensation.calibrate import Calibrated, Held, count_directions, saved_calibration
from ragg_runtime.compensation.compensate import Compensation, Kind
from ragg_runtime.compensation.drift import Drift, smooth_drift
from ragg_runtime.compensation.export import FORMS, Contents, write_export
from ragg_runtime.estimation.fitted import list_noise_floor
from ragg_runtime.identification import comparison as _compare
from ragg_runtime.identification import diagnose as _diagnose
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.next_motion import LIMITS, UNITS
from ragg_runtime.identification.parameters import Estimates, ParameterValue
from ragg_runtime.identification.result import Diagnosis, heed_flags
from ragg_runtime.identification.strong import choose_start
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.model_toml import add_effect, remove_effect
from ragg_runtime.instrument.units import RawQuantity, read_quantity
from ragg_runtime.io import Flight
from ragg_runtime.io.mapping import list_codes
from ragg_runtime.model import derive
from ragg_runtime.model.derive import Catalogue, effects
from ragg_runtime.model.directory import HistoryStep, replace_model_dir
from ragg_runtime.model.model import make_vector
from ragg_runtime.model.record import list_recorded_channels
from ragg_runtime.survey.result import Survey
from ragg_runtime.survey.run import digest_file, survey
from ragg_runtime.wording import describe, describe_other
from ragg_runtime.wording.sections import render_notebook
from ragg_runtime.workspace import (
    Flights,
    Loaded,
    Source,
    as_of,
    change,
    example,
    keep_mapping,
    load,
    load_state,
    mapping_of,
    mapping_text,
    new,
    read_flights,
    stamp,
)

__all__ = [
    "FORMS", "Added", "Catalogue", "Compensation", "Flights", "Held", "Kept", "Loaded", "Source", "add", "as_of",
    "calibrate", "change", "compare", "compare_frozen", "compensate",
    "contents", "diagnose", "effects", "example", "export", "keep_mapping", "load",
    "mapping_of", "mapping_text", "new", "parse_limits", "read_flights",
    "remove", "saved_calibration", "source_of_survey", "survey", "validate", "write_export",
]  # fmt: skip


# --- the loop


def compare(m: Loaded, flights: Flights) -> Comparison:
    """Show how far the model is from flights, and where it fails.

    Parameters
    ----------
    m
        The model: :func:`ragg.load` or :func:`ragg.new`.
    flights
        A path, a pandas DataFrame, an xarray Dataset, a dict of arrays, a list of these, or what :func:`ragg.read_flights` returned.

    Returns
    -------
        ``nominal``, ``calibrated`` and ``holdout`` errors (V, Eo), ``noise_floor`` (Eo), ``adequate``, ``where``.

    Raises
    ------
    UserError
        If the flights cannot be read or do not fit the instrument.
    """
    flights = read_flights(m, flights)
    return _compare.compare(m.model, m.instrument, flights)


def diagnose(
    m: Loaded, flights: Flights, limits: Mapping[str, float] = LIMITS, compared: Comparison | None = None
) -> Diagnosis:
    """Identify the physical effects that the model lacks.

    Parameters
    ----------
    m, flights
        As for :func:`ragg.compare`.
    limits
        Largest amplitudes of the next motion in SI: ``a``, ``omega``, ``jerk``, ``alpha``.
    compared
        A comparison of the same flights, whose calibration is then reused.

    Returns
    -------
        ``verdict``, ``found`` (the effects to add), ``ranking``, ``reason``, ``unexplained``, ``next_motion``.

    Raises
    ------
    UserError
        As for :func:`ragg.compare`.
    """
    flights = read_flights(m, flights)
    extended = partial(derive.with_effects, m.instrument)
    if compared is None:
        d = _diagnose.diagnose(m.model, m.instrument, flights, extended, limits)
    else:
        d = _diagnose.diagnose_fitted(compared.fitted, flights, extended, limits)
    return heed_flags(d, flights)


def parse_limits(m: Loaded, texts: Sequence[str]) -> Mapping[str, float]:
    """Largest amplitudes of a motion to fly next, and of its rates of change, SI, from texts such as ``a=50mg`` or ``a_z=1mg``."""
    amplitudes = dict(LIMITS)
    for text in texts:
        name, _, size = text.partition("=")
        kind = name.partition("_")[0]
        if kind not in UNITS or name not in (kind, *(f"{kind}_{k}" for k in "xyz")) or not size:
            raise UserError(
                "the limit of a motion cannot be read",
                where="--limit",
                found=text,
                expected="a=50mg, omega=500deg/h, jerk=1m/s^3, alpha=1deg/s^2, mass=0.5m or speed=0.1m/s; of one axis a_z=50mg",
            )
        q = read_quantity(size, f"--limit {name}", count=1)
        value = m.instrument.units.to_si(np.asarray(q.value), q.unit, UNITS[kind], f"--limit {name}")
        if not float(value) > 0.0:
            raise UserError("the limit of a motion must be positive", where=f"--limit {name}", found=size)
        amplitudes[name] = float(value)
    return MappingProxyType(amplitudes)


@dataclass(frozen=True, repr=False)
class Added:
    """The result of ``add``: errors and parameters; the model directory is as it was where it has not ``converged``."""

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
        return describe.summarize("Added", self.effect, *errors)

    def _repr_html_(self) -> str:
        effects = [e.id for e in self.loaded.model.effects]
        return render_notebook(describe.describe_addition(self.as_json(), effects))

    def as_json(self) -> dict[str, object]:
        """As ``ragg add --json`` writes it."""
        return {
            "effect": self.effect,
            "converged": self.converged,
            "reason": None if self.after is None else self.after.complaint,
            "off_sheet": [] if self.after is None else [x.as_json() for x in self.after.off_sheet],
            "before": _judge(self.before),
            "after": _judge(self.after),
            "parameters": [p.as_json() for p in self.parameters],
            "combinations": [p.as_json() for p in self.combinations],
        }


def _judge(c: Comparison | None) -> dict[str, object] | None:
    """The errors of a comparison with its noise floor, and whether the model is adequate."""
    if c is None:
        return None
    floor = list_noise_floor(c.fitted, c.noise_floor)
    return {**c.errors_json(), "noise_floor": floor, "adequate": c.adequate}


def add(
    m: Loaded,
    effect: str,
    flights: Flights = (),
    tell: Callable[[Added], None] | None = None,
    *,
    save: bool = True,
) -> Added:
    """Add an effect: derive it into the model, calibrate, and record the step in the history.

    Parameters
    ----------
    m, flights
        As for :func:`ragg.compare`; without flights nothing is calibrated.
    effect
        Its id, as listed by :func:`ragg.effects`.
    tell
        Called with the result before the directory is changed; if it raises, nothing is changed.
    save
        Whether to change the model directory, which also needs a calibration that converges.

    Returns
    -------
        ``before`` and ``after``, comparisons without and with the effect; ``parameters``; ``loaded``, the new model.

    Raises
    ------
    UserError
        If there is no such effect, if the model has it, or if a flight lacks a channel that it needs.
    """
    flights = read_flights(m, flights)
    setting = _prepare_setting(m, effect, flights)
    without = replace(m.instrument, effects=tuple(s for s in m.instrument.effects if s.id != effect))
    before = _compare.compare(derive.load_model(without), without, flights) if flights else None
    extended = replace(without, effects=(*without.effects, setting))
    model = derive.load_model(extended)
    after: Comparison | None = None
    parameters: tuple[ParameterValue, ...] = ()
    combinations: tuple[ParameterValue, ...] = ()
    if before is not None:
        extended = choose_start(before.fitted, model, extended, effect)
        setting = extended.effect(effect) or setting
        after = _compare.compare(model, extended, flights)
        estimates = Estimates.of_calibration(after.fitted).select(effect)
        parameters, combinations = estimates.list_parameters(), estimates.list_combinations()
        values = {**setting.values, **_list_quantities(parameters, m.instrument.layout.size)}
        setting = replace(setting, values=MappingProxyType(values))
        after = after.with_nominal(replace(extended, effects=(*without.effects, setting)))
    result = Added(m, effect, before, after, parameters, combinations)
    text = add_effect(m.directory.text, setting)
    step = HistoryStep(
        action="add",
        time=stamp(),
        effect=effect,
        before=None if before is None else before.errors_json(),
        after=None if after is None else after.errors_json(),
        flights=MappingProxyType({x.name: x.digest for x in flights}),
        text=text,
    )
    if result.converged:
        result = replace(result, loaded=as_of(m, text, step))
    if tell is not None:
        tell(result)
    if not (save and result.converged):
        return replace(result, loaded=m)
    directory = replace_model_dir(m.directory, text, generated=derive.list_files(extended), step=step)
    return replace(result, loaded=load_state(directory))


def _prepare_setting(m: Loaded, effect: str, flights: Sequence[Flight]) -> EffectSetting:
    """The effect as model.toml will list it, its values open but for a step's instant; UserError if it cannot be added."""
    offered = m.model.effect(effect) or derive.with_effects(m.instrument, m.model, [effect]).effect(effect)
    assert offered is not None
    present = m.instrument.effect(effect) or EffectSetting(effect)
    if {q.name for q in offered.parameters if not q.shape} & present.values.keys():
        raise UserError(
            "the effect is already in the model",
            where=str(m.directory.path),
            found=effect,
            remedy=f"remove it first: ragg remove {m.directory.path} {effect}",
        )
    for x in flights:
        missing = offered.missing(list_recorded_channels(x, m.instrument.layout))
        if missing:
            raise UserError(
                f"the effect {effect} needs a channel that the flight lacks",
                where=x.path or x.name,
                found=f"no {', '.join(missing)}",
                expected="a column of that name with its unit",
                remedy="record it, or choose another effect",
            )
    values = dict(present.values)
    if offered.kind == "step" and flights:
        values = {"t_step": RawQuantity(_estimate_instant(m, effect, flights), "s")}
    return replace(present, values=MappingProxyType(values))


def _estimate_instant(m: Loaded, effect: str, flights: Sequence[Flight]) -> float:
    """The most likely instant of a step, s."""
    ranking = _diagnose.diagnose(m.model, m.instrument, flights).ranking
    estimates = (p for r in ranking if r.effect == effect for p in r.parameters if p.name == "t_step")
    return next((p.value for p in estimates), 0.0)


def _list_quantities(parameters: Sequence[ParameterValue], count: int) -> dict[str, RawQuantity]:
    """Calibrated parameters of an effect as they are written to model.toml, ``count`` accelerometers."""
    values: dict[str, RawQuantity] = {}
    for name in dict.fromkeys(p.name for p in parameters):
        entries = [p for p in parameters if p.name == name]
        table = {p.accelerometer: p.value for p in entries}
        value = table[None] if None in table else tuple(table.get(k, 0.0) for k in range(1, count + 1))
        values[name] = RawQuantity(value, entries[0].unit)
    return values


def remove(m: Loaded, effect: str, tell: Callable[[Loaded], None] | None = None) -> Loaded:
    """Remove an effect from the model; ``tell`` as for :func:`ragg.add`.

    Returns
    -------
        The new model.

    Raises
    ------
    UserError
        If the model does not have the effect.
    """
    return change(m, remove_effect(m.directory.text, effect), "remove", effect, tell)


# --- many flights


def source_of_survey(m: Loaded, s: Survey, command: str) -> Source:
    """What a survey with a model was made from, including the files that could not be read."""
    files = [
        (r["flight"], r["file"], r["sha256"] if "sha256" in r else digest_file(r["file"])) for r in s.records
    ]
    return Source(command, m, files=files, title=f"{m.name} and {len(s.records)} flights")


# --- calibrations


@dataclass(frozen=True)
class Kept:
    """The result of ``calibrate``: the calibration, the model directory as it is afterwards, and the ``drift`` if it was asked for."""

    loaded: Loaded
    calibrated: Calibrated
    saved: bool
    drift: Drift | None = None

    def __repr__(self) -> str:
        seen, of = count_directions(self.calibrated.fitted)
        return (
            f"<calibration of {self.loaded.name}: {self.calibrated.error.rms_Eo:.4g} Eo rms, "
            f"{seen} of {of} directions seen>"
        )

    def _repr_html_(self) -> str:
        names = [o.name for o in self.calibrated.fitted.observations]
        return render_notebook(describe_other.describe_calibration(self.as_json(), names))

    def as_json(self) -> dict[str, Any]:
        """As ``ragg calibrate --json`` writes it."""
        drift = {} if self.drift is None else {"drifting": self.drift.as_json()}
        return self.calibrated.as_json() | {"saved": self.saved} | drift


def calibrate(
    m: Loaded, flights: Flights, save: bool = False, mapping: Path | str | None = None, *, drift: bool = False
) -> Kept:
    """Fit the parameters of the model to flights.

    Parameters
    ----------
    m, flights
        As for :func:`ragg.compare`.
    save
        Whether to save the calibration (and ``mapping``) in the model directory; earlier ones are kept.
    mapping
        Description of the files' columns.
    drift
        Whether to estimate parameters that drift during the flights, too; the constant ones are saved.

    Returns
    -------
        Parameters with their standard uncertainties, combinations, errors; ``loaded``, the model with the calibration.
    """
    flights = read_flights(m, flights, mapping)
    text = None if mapping is None else mapping_text(Path(mapping))
    c = _calibrate.calibrate(m.model, m.instrument, flights)
    walked = smooth_drift(c.fitted, flights) if drift else None
    return Kept(_save_calibration(m, c, flights, text) if save else m, c, save, walked)


def _save_calibration(m: Loaded, c: Calibrated, flights: Sequence[Flight], mapping: str | None) -> Loaded:
    d = m.directory
    new = _calibrate.make_saved(c, flights, stamp())
    step = HistoryStep("calibrate", new.time, after=new.error, flights=MappingProxyType(dict(new.flights)))
    directory = replace_model_dir(
        d,
        d.text,
        generated=derive.list_files(d.instrument),
        step=step,
        calibration=new.as_text(),
        mapping=mapping,
    )
    return Loaded(directory, m.model, m.notes)


def compare_frozen(m: Loaded, flights: Flights) -> Held:
    """Compare flights with the model in its saved calibration, and test whether that holds."""
    flights = read_flights(m, flights)
    return _calibrate.compare_frozen(m.model, m.instrument, flights, saved_calibration(m))


def validate(m: Loaded, c: Comparison, fitted: Sequence[Flight], flights: Sequence[Flight]) -> Held:
    """Test the calibration of a comparison on other flights, on which nothing is fitted."""
    calibrated_ = Calibrated(c.fitted, c.nominal, c.calibrated, c.holdout)
    return _calibrate.compare_frozen(
        m.model, m.instrument, flights, _calibrate.make_saved(calibrated_, fitted, stamp())
    )


# --- compensation


def compensate(
    m: Loaded,
    flights: Flights,
    calibration: Kind | Literal["online"] = "self",
    demodulator: str = "fir",
    output: Path | str | None = None,
    *,
    noise: float | None = None,
    walk: float | None = None,
    forget: float = float("inf"),
) -> Compensation:
    """Remove the modelled motion errors and demodulate: the gravity gradient as the instrument saw it.

    Parameters
    ----------
    m, flights
        As for :func:`ragg.compare`.
    calibration
        ``self``: parameters fitted to these flights; ``crossed``: in every block of time those fitted to all
        others; ``smoothed``: drifting from block to block; ``frozen``: as ``calibrate(..., save=True)`` saved
        them; ``online``: the recursive filter, sample by sample, from the saved calibration, else from the sheet.
    demodulator
        ``fir``, ``butterworth`` or ``causal``.
    output
        A file to write the channels to.
    noise
        ``online``: noise density of the cross channel near twice the spin rate, Eo/sqrt(Hz); default: that of the saved calibration.
    walk
        ``online``: random walk of the cross channel, Eo/sqrt(s), twice that of the inline channel; default: a time
        constant of 1/(2 pi 0.2 Hz).
    forget
        ``online``: time constant, s, with which parameters are forgotten.

    Returns
    -------
        ``inline`` and ``cross`` (Eo) with their standard uncertainties and ``quality``, for each flight.
    """
    flights = read_flights(m, flights, gradient=False)
    if calibration == "online":
        result = _recursive.follow(m, flights, noise=noise, walk=walk, forget=forget)
    else:
        result = _compensate.compensate(m, flights, calibration, demodulator)
    if output is not None:
        result.write(output)
    return result


# --- export


def contents(m: Loaded) -> Contents:
    """The content of an export: the model with its saved calibration, else with the values of model.toml."""
    saved, of = None, "values of model.toml, not calibrated"
    if m.directory.calibration is not None:
        try:
            saved = saved_calibration(m)
            of = f"calibrated {saved.time} on {', '.join(saved.flights)}"
        except UserError as error:
            of = f"values of model.toml: {error.what}"
    folded = {n: text for n, text in m.model.chain.sources.items() if n.startswith("folded")}
    if not m.instrument.layout.like_paper:  # of a single accelerometer a volt has few digits: then bit by bit
        folded = {}
    mapped = mapping_of(m, None)
    return Contents(
        name=m.name,
        model=m.model,
        instrument=m.instrument,
        p=make_vector(m.model, m.instrument) if saved is None else saved.p,
        sources=folded or derive.derive_plain_c(m.instrument),
        module=derive.read_chain(m.instrument),
        origin=of,
        saved=saved,
        null={} if mapped is None else list_codes(mapped),
    )


def export(m: Loaded, folder: Path | str, form: str) -> list[Path]:
    """Write the model with its saved calibration, else the values of model.toml, into a folder.

    Parameters
    ----------
    m
        The model.
    folder
        An empty folder, or one of an earlier export.
    form
        ``c``, ``numpy`` or ``json``.

    Returns
    -------
        The files.
    """
    return write_export(contents(m), Path(folder), form)
