"""What is installed and shipped: every package of the lock has hashes, every vendored file its licence."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
VENDOR = ROOT / "ragg_runtime" / "studio" / "static" / "vendor"
LOCK = ROOT / "requirements.lock"

pytestmark = pytest.mark.skipif(not LOCK.exists(), reason="not a checkout of the project")


def test_the_lock_holds_what_the_project_asks_for_with_hashes() -> None:
    """Of every release the SHA-256 of its files; every line of the lock is one of these."""
    names = set()
    for line in filter(None, LOCK.read_text("utf-8").replace("\\\n", " ").splitlines()):
        match = re.fullmatch(r"([a-z0-9-]+)==[\w.]+(\s+--hash=sha256:[0-9a-f]{64})+", line.strip())
        assert match, f"not NAME==VERSION with hashes (make lock): {line[:80]}"
        names.add(match[1])
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = project["optional-dependencies"]
    groups = ("cluster", "files", "plots", "studio", "dev", "docs")
    asked = [*project["dependencies"], *(x for g in groups for x in extras[g] if not x.startswith("ragg["))]
    assert {re.split(r"[^A-Za-z0-9_.-]", x)[0].lower().replace("_", "-") for x in asked} <= names


def test_every_vendored_file_is_listed_with_its_licence() -> None:
    listed = tomllib.loads((VENDOR / "vendored.toml").read_text("utf-8"))["component"]
    named = {name for c in listed for name in (*c["files"], c["licence_file"])}
    assert {p.name for p in VENDOR.iterdir()} == named | {"vendored.toml"}
    for c in listed:
        assert c["version"] in (VENDOR / c["files"][0]).read_text("utf-8")[:400]
        assert (VENDOR / c["licence_file"]).stat().st_size > 500
