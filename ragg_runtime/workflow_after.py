"""What comes after a model, for the command line and for notebooks: calibrate, compare frozen, compensate, export."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from types import MappingProxyType
from typing import Any

from ragg_runtime import display, extend
from ragg_runtime.compensation import calibrated as _calibrated
from ragg_runtime.compensation import frozen as _frozen
from ragg_runtime.compensation.calibrated import Calibrated
from ragg_runtime.compensation.frozen import Held
from ragg_runtime.compensation.saved import Saved, with_another
from ragg_runtime.flight import Flight
from ragg_runtime.model_dir import CALIBRATION, ModelDir, Step, replace_model_dir
from ragg_runtime.workflow import Loaded


@dataclass(frozen=True)
class Kept:
    """The result of ``calibrate``: the calibration, and the model directory as it is afterwards."""

    loaded: Loaded
    calibrated: Calibrated
    saved: bool

    def __repr__(self) -> str:
        seen, of = self.calibrated.directions
        return (
            f"<calibration of {self.loaded.name}: {self.calibrated.error.rms_Eo:.4g} Eo rms, "
            f"{seen} of {of} directions seen>"
        )

    def _repr_html_(self) -> str:
        return display.calibration(self.as_json(), [o.name for o in self.calibrated.fitted.observations])

    def as_json(self) -> dict[str, Any]:
        return self.calibrated.as_json() | {"saved": self.saved}


def calibrate(m: Loaded, flights: Sequence[Flight], save: bool = False) -> Kept:
    """Fit the model's parameters to flights; ``save`` keeps them in the model directory, the older ones as history."""
    c = _calibrated.calibrated(m.model, m.instrument, flights)
    return Kept(loaded=_saved(m, c, flights) if save else m, calibrated=c, saved=save)


def _saved(m: Loaded, c: Calibrated, flights: Sequence[Flight]) -> Loaded:
    d = m.directory
    new = _calibrated.to_save(c, flights, datetime.now(UTC).isoformat(timespec="seconds"))
    digests = MappingProxyType(dict(new.flights))
    step = Step(action="calibrate", time=new.time, after=new.error, flights=digests)
    directory = replace_model_dir(
        d,
        d.text,
        generated=_code(d),
        history=(*d.history, step),
        calibration=with_another(d.calibration, new, str(d.path / CALIBRATION)),
    )
    return Loaded(directory, m.model, m.notes)


def _code(d: ModelDir) -> Any:
    """The code of a model directory, unchanged if it is what is derived for it, else derived anew."""
    if d.generated is not None and extend.departure(d.instrument, d.generated) is None:
        return d.generated
    return extend.files_of(d.instrument)


def saved_calibration(m: Loaded) -> Saved:
    """The calibration that the model directory keeps; UserError if there is none, or if it is of another model."""
    return _frozen.in_force(m.directory, m.model)


def compare_frozen(m: Loaded, flights: Sequence[Flight]) -> Held:
    """How far the model is from flights with the parameters as they were kept, and how these hold."""
    return _frozen.hold(m.model, m.instrument, flights, saved_calibration(m))


def calibration_notes(m: Loaded) -> list[str]:
    """What is odd about the calibration that is kept."""
    return _frozen.notes(saved_calibration(m), m.model, m.directory)
