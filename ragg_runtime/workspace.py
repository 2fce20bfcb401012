"""A model directory with its derived model, and flights read and screened for it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path
from typing import Any

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import provenance, read_text, write_text
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.model_toml import parse_instrument, with_full_kinematics
from ragg_runtime.io import Flight
from ragg_runtime.io import read_flights as _read_flights
from ragg_runtime.io.mapping import Mapped, parse_mapping, read_mapping
from ragg_runtime.io.record import GRADIENT, require_distinct
from ragg_runtime.model import derive
from ragg_runtime.model.directory import (
    MAPPING,
    HistoryStep,
    ModelDir,
    compute_digest,
    create_model_dir,
    load_model_dir,
    replace_model_dir,
)
from ragg_runtime.model.model import Model, make_vector
from ragg_runtime.screening import screen
from ragg_runtime.wording import describe
from ragg_runtime.wording.sections import render_notebook


@dataclass(frozen=True, repr=False)
class Loaded:
    """A model directory, the model derived for it, and what was odd, in sentences."""

    directory: ModelDir
    model: Model
    notes: tuple[str, ...] = ()

    @property
    def instrument(self) -> Instrument:
        """The instrument of model.toml."""
        return self.directory.instrument

    @property
    def name(self) -> str:
        """Name of the directory."""
        return one_line(self.directory.path.resolve().name)

    def __repr__(self) -> str:
        return f"<Model {self.name}: effects {', '.join(e.id for e in self.model.effects) or 'none'}>"

    def _repr_html_(self) -> str:
        steps = [s.as_json() for s in self.directory.history]
        return render_notebook(describe.describe_model(self.name, [e.id for e in self.model.effects], steps))


FULL_KINEMATICS = (
    'the sheet has no [model]: kinematics = "full" was written into model.toml, because accelerometers turn with the '
    'disc; Eq. 9 of the paper, which ignores this, is [model] kinematics = "platform"'
)


def new(path: Path | str, source: Path | str | None = None, mapping: Path | str | None = None) -> Loaded:
    """Make a model directory.

    Parameters
    ----------
    path
        The directory; it must not exist or be empty.
    source
        A test sheet (a model.toml); default: the packaged example.
    mapping
        A mapping of the flights' columns, to be kept with the model.

    Returns
    -------
        The model.

    Raises
    ------
    UserError
        If the sheet or the mapping is invalid, or the directory cannot be made.
    """
    mapping_toml = None if mapping is None else mapping_text(Path(mapping))
    text = _read_example() if source is None else read_text(Path(source))
    completed = with_full_kinematics(text)
    instrument = parse_instrument(completed, Path(source) if source else None)
    directory = create_model_dir(
        path,
        completed,
        generated=derive.list_files(instrument),
        history=(HistoryStep("new", stamp(), text=completed),),
        mapping=mapping_toml,
    )
    m = load_state(directory)
    return m if completed == text else replace(m, notes=(*m.notes, FULL_KINEMATICS))


def load(path: Path | str) -> Loaded:
    """Read a model directory and derive its model.

    Returns
    -------
        The model.

    Raises
    ------
    UserError
        If there is no model directory, or its files are invalid.
    """
    return load_state(load_model_dir(path))


def load_state(directory: ModelDir) -> Loaded:
    """A model directory that was read, with the model derived for it."""
    model = derive.load_model(directory.instrument)
    make_vector(model, directory.instrument)  # its settings are good
    note = derive.describe_departure(directory.instrument, directory.generated)
    return Loaded(directory, model, () if note is None else (note,))


def example() -> Instrument:
    """The instrument of the packaged test sheet."""
    return parse_instrument(_read_example())


def _read_example() -> str:
    return resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8")


def as_of(m: Loaded, text: str, step: HistoryStep | None = None) -> Loaded:
    """The model with another text of model.toml, after this ``step``, in memory; the directory is not changed."""
    instrument = parse_instrument(text, m.directory.path / "model.toml")
    model = derive.load_model(instrument)
    make_vector(model, instrument)
    history = (*m.directory.history, *([] if step is None else [step]))
    directory = replace(m.directory, text=text, instrument=instrument, generated=None, history=history)
    return Loaded(directory, model, m.notes if step is None else ())


def change(
    m: Loaded, text: str, action: str, effect: str = "", tell: Callable[[Loaded], None] | None = None
) -> Loaded:
    """Put another text in the place of model.toml, derive its model, and note the step in the history.

    ``tell`` is called with the new model before; if it raises, nothing is changed.
    """
    step = HistoryStep(action, stamp(), effect, text=text)
    planned = as_of(m, text, step)
    if tell is not None:
        tell(planned)
    generated = derive.list_files(planned.instrument)
    return load_state(replace_model_dir(m.directory, text, generated=generated, step=step))


def stamp() -> str:
    """The instant as written in a history."""
    return datetime.now(UTC).isoformat(timespec="seconds")


# a flight as it was read, a path, a pandas DataFrame, an xarray Dataset, or a dict of arrays; or a list of these
Flights = Flight | Path | str | Any


def read_flights(
    m: Loaded, paths: Flights, mapping: Path | str | None = None, *, gradient: bool = True
) -> list[Flight]:
    """Read and screen flights in the units of this model (its g0); every flight line of a file is a flight.

    Parameters
    ----------
    m
        The model.
    paths
        Paths, pandas DataFrames, xarray Datasets or dicts of arrays (columns ``name [unit]``, or units in ``attrs``), one
        or a list of these. Flights that were already read are returned unchanged.
    mapping
        Description of the columns; default: the mapping kept with the model.
    gradient
        Whether recorded gravity gradients are read: they must not enter what is compensated.

    Returns
    -------
        Flights with channels in SI.

    Raises
    ------
    UserError
        If a file cannot be read or does not fit the instrument, or is given twice.
    """
    sources = list(paths) if isinstance(paths, list | tuple) else [paths]
    mapped = mapping_of(m, mapping) if any(not isinstance(x, Flight) for x in sources) else None
    flights: list[Flight] = []
    for n, source in enumerate(sources, 1):
        if isinstance(source, Flight):
            flights.append(source)
            continue
        records = _read_flights(
            source,
            m.instrument.g0,
            accelerometers=m.instrument.layout,
            mapping=mapped,
            leave=frozenset() if gradient else frozenset(GRADIENT),
            name="flight" if len(sources) == 1 else f"flight {n}",
        )
        flights += [screen(m.model, m.instrument, x) for x in records]
    require_distinct(flights)
    return flights


def mapping_of(m: Loaded, path: Path | str | None) -> Mapped | None:
    """The mapping that is given, else the one that is kept with the model, else none."""
    if path is not None:
        return read_mapping(Path(path))
    kept = m.directory.mapping
    return None if kept is None else replace(read_mapping(kept), kept=True)


def keep_mapping(m: Loaded, text: str, *, replace: bool) -> None:
    """Lay a mapping down in the model directory, where every command finds it; never over another unasked."""
    place = m.directory.path / MAPPING
    if place.exists() and not replace and read_text(place) != text:
        raise UserError("the model has a mapping already", where=place, remedy="ask for it to be replaced")
    write_text(place, text)


def mapping_text(path: Path) -> str:
    """The text of a mapping that is to be kept; UserError if it is none."""
    text = read_text(path)
    parse_mapping(text, path)
    return text


@dataclass(frozen=True)
class Source:
    """What a result was made from: the ``command``, model and flights.

    ``before``: the model before the command changed it. ``further``: notes. ``files``: name, path and SHA-256 (``None``: it cannot be
    read) of what was read elsewhere. ``title``: of its report.
    """

    command: str
    m: Loaded | None = None
    flights: Sequence[Flight] = ()
    before: Loaded | None = None
    further: Sequence[str] = ()
    files: Sequence[tuple[str, str, str | None]] = ()
    title: str = ""

    @property
    def heading(self) -> str:
        """The title, else the model and the flights."""
        flights = ", ".join(x.name for x in self.flights)
        return self.title if self.title or self.m is None else f"{self.m.name} and {flights}"

    @property
    def notes(self) -> list[str]:
        """Notes: changes to, and oddities of, model directory and flights."""
        return [
            *self.further,
            *(self.m.notes if self.m else ()),
            *(f"{x.name}: {note}" for x in self.flights for note in x.notes),
        ]

    @property
    def inputs(self) -> list[tuple[str, str]]:
        """(name, SHA-256) of everything that the result depends on."""
        model = [(f"{m.name}/model.toml", compute_digest(m.directory.text)) for m in (self.m,) if m]
        elsewhere = [(name, digest) for name, _, digest in self.files if digest]
        return [*model, *((x.name, x.digest) for x in self.flights), *elsewhere]

    def as_json(self) -> dict[str, object]:
        """``notes`` of the reader on the flights, and ``provenance``, from which the result can be made again."""
        assert self.m is not None
        model = {
            "model": str(self.m.directory.path),
            "model_digest": compute_digest(self.m.directory.text),
            **({"model_digest_before": compute_digest(self.before.directory.text)} if self.before else {}),
            "derivation_digest": self.m.model.digest,
        }
        flights = [(x.name if x.path is None else str(x.path), x.digest) for x in self.flights]
        elsewhere = [(path, digest) for _, path, digest in self.files]
        return {"notes": self.notes, "provenance": provenance(self.command, model, [*flights, *elsewhere])}
