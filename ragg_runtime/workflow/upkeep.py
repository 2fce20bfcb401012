"""What a model directory and the project need between flights: own effects trusted, code compiled, steps read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.provenance import provenance
from ragg_runtime.instrument.read_toml import read_instrument
from ragg_runtime.model import native
from ragg_runtime.model.model import packaged
from ragg_runtime.model_dir.directory import load_model_dir
from ragg_runtime.model_dir.identity import identity
from ragg_runtime.model_dir.trust import OwnEffects, read_effects
from ragg_runtime.model_dir.trust import forget as forget
from ragg_runtime.model_dir.trust import is_trusted as is_trusted
from ragg_runtime.model_dir.trust import trust as trust

if TYPE_CHECKING:
    from ragg_runtime.workflow.loaded import Loaded


def own_effects(model: Path) -> OwnEffects:
    """The Python files that a model directory, or a model.toml, names; UserError if it names none."""
    instrument = read_instrument(model) if model.is_file() else load_model_dir(model).instrument
    if instrument.effects_folder is None:
        raise UserError("the model names no effects_folder", where=model, remedy="there is nothing to trust")
    return read_effects(instrument.effects_folder)


def compiled(m: Loaded | None) -> native.Built:
    """The machine code of a model, of the paper's without one, made if it is not there; UserError if it cannot be."""
    try:
        return native.build((packaged() if m is None else m.model).sources)
    except native.BuildError as error:
        raise UserError(
            "the model cannot be compiled",
            where=None if m is None else m.directory.path,
            found=error,
            remedy="without it NumPy serves",
        ) from None


@dataclass(frozen=True)
class History:
    """The steps of a model directory, oldest first, as JSON; what is odd about it; where it comes from."""

    steps: tuple[Mapping[str, Any], ...]
    notes: tuple[str, ...]
    provenance: Mapping[str, Any]


def history(model_dir: Path, command: str) -> History:
    """Read, not derived: a model that no longer can be is told its steps, too."""
    d = load_model_dir(model_dir)
    return History(
        steps=tuple(s.as_json() for s in d.history),
        notes=tuple(d.notes),
        provenance=provenance(command, identity(d)),
    )
