"""What is fuzzed. A target takes bytes and returns what it did; whatever it raises is a finding."""

from __future__ import annotations

import contextlib
import dataclasses
import re
from collections.abc import Callable, Mapping

from derive.chain import recorded_motion
from derive.context import Context
from derive.emit.printers import to_c, to_numpy
from derive.expression import ExpressionError, from_expression
from derive.stages import SensedForce
from derive.symbols import symbol
from derive.tape import Tape
from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import read_flight
from ragg_runtime.instrument.edit_toml import add_effect, remove_effect, set_parameters
from ragg_runtime.instrument.read_toml import parse_instrument, read_instrument
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model_dir import derive

from .grammar import generated_model
from .kept import calibration, history, mapping, unfinished
from .places import Outcome, place, shown

_CONTEXT = Context(Tape(), recorded_motion())
_FORCE = SensedForce(*(symbol(f"f_{axis}") for axis in "iop"))


def expression(data: bytes) -> Outcome:
    """A one-line effect: read, and printed as source, which must be source."""
    text = data.decode("utf-8", "surrogateescape")
    words = set(re.findall(r"\w+", text))
    parameters = {name: {"unit": "ug"} for name in ("K", "K_x", "c") if name in words} or {
        "K": {"unit": "ug"}
    }
    try:
        effect = from_expression("mine", "transducer", text, parameters)
    except ExpressionError as error:
        str(error).encode("utf-8", "backslashreplace")
        return "refused"
    assert effect.transducer is not None
    formula = effect.transducer(symbol("f_i"), _FORCE, effect.values, _CONTEXT)
    source = to_numpy(formula)
    compile(source, "<formula>", "eval", dont_inherit=True)
    assert "\n" not in source + effect.equation + effect.title
    assert "*/" not in to_c(formula) + effect.title
    return "read"


def model_toml(data: bytes) -> Outcome:
    """A model.toml: read from a file, its effects looked up, its one-line effects understood."""
    path = place("model.toml", data)
    try:
        instrument = read_instrument(path)
        instrument = dataclasses.replace(instrument, effects_folder=None)  # Python is not fuzzed
        known = derive.known(instrument)
        for setting in instrument.effects:
            effect = known.get(setting.id)
            for q in effect.parameters:
                setting.si(q.name, q.unit, instrument.g0, shared=q.shared)
    except UserError as error:
        return shown(error)
    return "read"


def edited_toml(data: bytes) -> Outcome:
    """A model.toml that a command edits: what is written must be read, with the change in it."""
    text = data.decode("utf-8", "replace")
    try:
        before = parse_instrument(text)
        setting = dataclasses.replace(_LAG, id="lag")
        if before.effect("lag") is None:
            longer = add_effect(text, setting)
            assert [e.id for e in parse_instrument(longer).effects] == [
                *(e.id for e in before.effects),
                "lag",
            ]
            shorter = parse_instrument(remove_effect(longer, "lag"))
            assert [e.id for e in shorter.effects] == [e.id for e in before.effects]
        changed = parse_instrument(set_parameters(text, {"dR": RawQuantity(1.0, "um")}))
        assert abs(changed.accelerometers["dR"][2] - 1e-6) < 1e-12
    except UserError as error:
        return shown(error)
    return "read"


def flight_csv(data: bytes) -> Outcome:
    """A CSV flight; compressed, if it begins like gzip."""
    return _flight(data, "flight.csv.gz" if data.startswith(b"\x1f\x8b") else "flight.csv")


def flight_parquet(data: bytes) -> Outcome:
    """A Parquet flight."""
    return _flight(data, "flight.parquet")


def flight_netcdf(data: bytes) -> Outcome:
    """A NetCDF flight."""
    return _flight(data, "flight.nc")


TARGETS: Mapping[str, Callable[[bytes], Outcome]] = {
    f.__name__: f
    for f in (
        expression,
        model_toml,
        edited_toml,
        mapping,
        history,
        unfinished,
        calibration,
        flight_csv,
        flight_parquet,
        flight_netcdf,
        generated_model,
    )
}

_LAG = derive.EffectSetting("lag")


def _flight(data: bytes, name: str) -> Outcome:
    with contextlib.suppress(UserError):
        flight = read_flight(place(name, data), 9.8, need_output=False)
        assert len(flight.time) == len(flight.valid)
        return "read"
    return "refused"
