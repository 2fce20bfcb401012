"""What tells a model directory apart in a result: where it stands, and digests of what was read of it."""

from __future__ import annotations

from ragg_runtime.model_dir.directory import ModelDir
from ragg_runtime.model_dir.history import digest


def identity(
    directory: ModelDir, derivation: str | None = None, before: ModelDir | None = None
) -> dict[str, object]:
    """Of a directory as it was read, with the digest of what was derived for it, and as it was ``before`` a change."""
    found: dict[str, object] = {"model": str(directory.path), "model_digest": digest(directory.text)}
    if before is not None:
        found["model_digest_before"] = digest(before.text)
    if derivation is not None:
        found["derivation_digest"] = derivation
    return found
