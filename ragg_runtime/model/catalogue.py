"""The catalogue of physical effects, as the derivation has written it down."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ragg_runtime.model.derive import find_effect, list_own_entries
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.sections import Section, render_notebook


@dataclass(frozen=True, repr=False)
class Catalogue:
    """Effects by their id: title, physics, equation, parameters with units, channels, limits, source."""

    entries: tuple[Mapping[str, Any], ...]

    def __len__(self) -> int:
        return len(self.entries)

    def __iter__(self) -> Iterator[Mapping[str, Any]]:
        return iter(self.entries)

    def __getitem__(self, identifier: str) -> Mapping[str, Any]:
        return find_effect({str(e["id"]): e for e in self.entries}, identifier)

    def __repr__(self) -> str:
        return f"<Catalogue: {len(self.entries)} effects>"

    def sections(self) -> tuple[Section, ...]:
        """A line for every effect."""
        return describe_other.describe_catalogue(self.entries)

    def _repr_html_(self) -> str:
        return render_notebook(self.sections())

    def as_json(self) -> dict[str, object]:
        return {"effects": [dict(e) for e in self.entries]}


def effects() -> Catalogue:
    """List the packaged catalogue of effects and the user's own effects in Python."""
    place = Path(__file__).parents[2] / "generated"  # `resources` would import the models, and NumPy for them
    text = (place / "manifest.json").read_text("utf-8")
    return Catalogue(entries=(*json.loads(text)["catalogue"], *list_own_entries()))
