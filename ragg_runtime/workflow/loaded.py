"""A model directory and what is read with it: new, load, read flights."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import read_text, replacing
from ragg_runtime.flight import Flight
from ragg_runtime.flight import read_flights as _read_flights
from ragg_runtime.flight.mapping import Mapped, parse_mapping, read_mapping
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model.model import Model
from ragg_runtime.model_dir import derive
from ragg_runtime.model_dir.directory import MAPPING, ModelDir, create_model_dir, load_model_dir
from ragg_runtime.model_dir.history import Step
from ragg_runtime.plausibility import check_settings, examined
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


def new(path: Path | str, source: Path | None = None, mapping: Path | None = None) -> Loaded:
    """Make a model directory from a test sheet (a model.toml), by default the packaged example.

    ``mapping`` is kept with the model: what the columns of its flight files are.
    """
    kept = None if mapping is None else mapping_text(Path(mapping))
    if source is None:
        text = _example_text()
    else:
        text = read_text(Path(source))
    instrument = parse_instrument(text, Path(source) if source else None)
    history = (Step("new", now(), text=text),)
    made = create_model_dir(path, text, generated=derive.files_of(instrument), history=history, mapping=kept)
    m = loaded(made)
    return m if tomllib.loads(text).get("model") else replace(m, notes=(*m.notes, NO_FORM))


def example() -> Instrument:
    """The instrument of the packaged test sheet."""
    return parse_instrument(_example_text())


def _example_text() -> str:
    return resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8")


def load(path: Path | str) -> Loaded:
    """Read a model directory and derive its model."""
    return loaded(load_model_dir(path))


def loaded(directory: ModelDir) -> Loaded:
    """The directory with its model, and what is odd about both."""
    model = derive.model_of(directory.instrument)
    check_settings(model, directory.instrument)
    note = derive.departure(directory.instrument, directory.generated)
    return Loaded(directory, model, () if note is None else (note,))


def read_flights(
    m: Loaded,
    paths: Sequence[Path | str],
    mapping: Path | str | None = None,
    *,
    leave: frozenset[str] = frozenset(),
) -> list[Flight]:
    """Read flight files in the units of this model (its g0), and examine them: see ``plausibility``.

    A file with several lines gives as many flights. ``mapping`` is a file that says what the columns are, by
    default the model's own ``mapping.toml``, if it has one. ``leave`` names columns that are not read.
    """
    how = mapping_of(m, mapping)
    found = []
    for path in paths:
        read = _read_flights(
            path, m.instrument.g0, accelerometers=m.instrument.layout, mapping=how, leave=leave
        )
        for x in read:
            found.append(as_read(m.model, m.instrument, x))
    return found


def as_read(model: Model, instrument: Instrument, x: Flight) -> Flight:
    """What is done to every flight that is read: examined, and the memory that reading it took given back."""
    return examined(model, instrument, x)


def mapping_of(m: Loaded, given: Path | str | None) -> Mapped | None:
    """The mapping that is given, else the one that is kept with the model, else none."""
    if given is not None:
        return read_mapping(Path(given))
    own = m.directory.mapping
    return None if own is None else replace(read_mapping(own), kept=True)


def keep_mapping(m: Loaded, text: str, *, replace: bool) -> None:
    """Lay a mapping down in the model directory, where every command finds it; never over another unasked."""
    place = m.directory.path / MAPPING
    if place.exists() and not replace and read_text(place) != text:
        raise UserError(
            "the model has a mapping already", where=place, remedy="say that it shall be replaced"
        )
    with replacing(place) as temporary:
        temporary.write_text(text, "utf-8")


def mapping_text(path: Path) -> str:
    """The text of a mapping that is to be kept; UserError if it is none."""
    text = read_text(path)
    parse_mapping(text, path)
    return text


def now() -> str:
    """The instant as it stands in a history."""
    return datetime.now(UTC).isoformat(timespec="seconds")
