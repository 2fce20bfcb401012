"""What tells a model directory apart in a result: where it stands, and digests of what was read of it."""

from __future__ import annotations

import hashlib

from ragg_runtime.model_dir.directory import ModelDir
from ragg_runtime.model_dir.trust import read_effects


def identity(
    directory: ModelDir, derivation: str | None = None, before: ModelDir | None = None
) -> dict[str, object]:
    """Of a directory as it was read, with the digest of what was derived for it, and as it was ``before`` a change."""
    found: dict[str, object] = {"model": str(directory.path), "model_digest": _sha256(directory)}
    if before is not None:
        found["model_digest_before"] = _sha256(before)
    folder = directory.instrument.effects_folder
    if folder is not None:
        found["effects_folder_digest"] = read_effects(folder).digest
    if derivation is not None:
        found["derivation_digest"] = derivation
    return found


def _sha256(directory: ModelDir) -> str:
    return hashlib.sha256(directory.text.encode()).hexdigest()
