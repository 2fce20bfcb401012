"""history.json: what was added to a model or removed from it, when, and the error before and after."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import read_text

_LONGEST = 1 << 26  # bytes


def digest(text: str | None) -> str:
    """SHA-256 of a file's text, hexadecimal; of a file that is not there, that of nothing."""
    return hashlib.sha256((text or "").encode()).hexdigest()


@dataclass(frozen=True)
class Step:
    """An entry of history.json; ``time`` is UTC, ISO 8601, ``before`` and ``after`` are error objects (rms_V, rms_Eo,
    ...).

    ``action`` is ``new``, ``add``, ``remove`` or ``calibrate``; ``flights`` have their SHA-256; ``text`` is model.toml
    as it then was; ``digests`` are those of the file changed, before and after. Older histories lack the last two.
    """

    action: str
    time: str
    effect: str = ""
    before: Mapping[str, Any] | None = None
    after: Mapping[str, Any] | None = None
    flights: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    text: str = ""
    digests: tuple[str, ...] = ()

    def was_cut_off(self, model: str, calibration: str | None) -> bool:
        """Whether the file that the step changes is still the one before: the history is written first."""
        if len(self.digests) != 2:
            return False
        before, after = self.digests
        return before != after and before == digest(calibration if self.action == "calibrate" else model)

    def as_json(self) -> dict[str, Any]:
        """The entry as it stands in the file."""
        return {
            "action": self.action,
            "effect": self.effect or None,
            "time": self.time,
            "before": None if self.before is None else dict(self.before),
            "after": None if self.after is None else dict(self.after),
            "flights": dict(self.flights),
            **({"model": self.text} if self.text else {}),
            **({"digests": list(self.digests)} if self.digests else {}),
        }


def history_text(steps: Sequence[Step]) -> str:
    """The text of a history.json."""
    return json.dumps({"steps": [step.as_json() for step in steps]}, indent=2, allow_nan=False) + "\n"


def _error(found: Any) -> Mapping[str, Any] | None:
    """An error object as it stands in the file; TypeError, ValueError or AttributeError if it is none."""
    inner = found.get("calibrated", found) if found else {}
    told = inner.get("rms_Eo") if inner else None  # of a step
    float(0.0 if told is None else told)
    json.dumps(found, allow_nan=False)  # it is written again with the next step
    return None if found is None else dict(found)


def read_history(path: Path) -> tuple[Step, ...]:
    """The steps of a history.json, oldest first; none if there is no file. UserError if it is damaged."""
    if not path.exists():
        return ()
    try:
        content = json.loads(read_text(path, _LONGEST))
        return tuple(
            Step(
                action=one_line(str(s["action"])),
                time=one_line(str(s["time"])),
                effect=one_line(str(s["effect"] or "")),
                before=_error(s.get("before")),
                after=_error(s.get("after")),
                flights=MappingProxyType({str(n): str(d) for n, d in s.get("flights", {}).items()}),
                text=str(s.get("model", "")),
                digests=tuple(map(str, s.get("digests", ()))),
            )
            for s in content["steps"]
        )
    except (ArithmeticError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise UserError(
            "the history is damaged",
            where=path,
            found=str(error),
            expected='{"steps": [{"action", "effect", "time", "before", "after", "flights"}, ...]}',
            remedy="restore the file, or remove it: a new history begins with the next step",
        ) from None
