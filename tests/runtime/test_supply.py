"""What is installed and shipped: every package of the lock has hashes, the SBOM is that of the lock, vendored files are listed."""

from __future__ import annotations

import hashlib
import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
VENDOR = ROOT / "ragg_runtime" / "studio" / "static" / "vendor"

pytestmark = pytest.mark.skipif(not (ROOT / "sbom.json").exists(), reason="not a checkout of the project")


def locked(lock: str = "requirements.lock") -> dict[tuple[str, str], list[str]]:
    """(name, version) -> SHA-256 of the release's files; every line of the lock is one of these."""
    text = (ROOT / lock).read_text("utf-8").replace("\\\n", " ")
    found = {}
    for line in filter(None, map(str.strip, text.splitlines())):
        match = re.fullmatch(r"([a-z0-9-]+)==([\w.]+)((?:\s+--hash=sha256:[0-9a-f]{64})+)", line)
        assert match, f"not NAME==VERSION with hashes (make lock): {line[:80]}"
        found[match[1], match[2]] = re.findall(r"sha256:(\w+)", match[3])
    return found


def sbom() -> dict[str, Any]:
    found: dict[str, Any] = json.loads((ROOT / "sbom.json").read_text("utf-8"))
    return found


@pytest.mark.parametrize(("lock", "at_least"), [("requirements.lock", 100), ("requirements-oldest.lock", 40)])
def test_every_package_has_the_hashes_of_its_files(lock: str, at_least: int) -> None:
    packages = locked(lock)
    assert len(packages) > at_least
    for name, hashes in packages.items():
        assert len(hashes) == len(set(hashes)) > 0, name
    # Compiled packages have wheels for each Python and each processor.
    for compiled in ("numpy", "scipy", "h5py", "pyarrow", "pandas"):
        (hashes,) = [h for (n, _), h in packages.items() if n == compiled]
        assert len(hashes) > 10, compiled


def test_what_the_project_asks_for_is_in_the_lock() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    asked = [*project["dependencies"]]
    asked += [
        x for group in ("cluster", "studio", "dev", "docs") for x in project["optional-dependencies"][group]
    ]
    names = {re.split(r"[^A-Za-z0-9_.-]", x)[0].lower().replace("_", "-") for x in asked}
    assert names <= {name for name, _ in locked()}


def test_the_oldest_lock_holds_the_lower_bounds() -> None:
    """With setuptools, which builds the project there too: nothing is fetched beside the lock."""
    text = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    bounds = dict(
        x.split(">=") for x in [*text["project"]["dependencies"], *text["build-system"]["requires"]]
    )
    held = dict(locked("requirements-oldest.lock"))
    for name, bound in bounds.items():
        (version,) = [v for n, v in held if n == name]
        assert f"{version}.".startswith(f"{bound}."), f"{name}: {version} is not the bound {bound}"


def test_the_sbom_is_current() -> None:
    """If not: make sbom."""
    packages = [c for c in sbom()["components"] if c.get("purl", "").startswith("pkg:pypi/")]
    assert {(c["name"], c["version"]) for c in packages} == set(locked())
    assert sum("licenses" in c for c in packages) > 0.9 * len(packages)
    version = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["version"]
    assert sbom()["metadata"]["component"]["version"] == version
    assert "timestamp" not in sbom()["metadata"]
    assert "serialNumber" not in sbom()


def test_every_vendored_file_is_listed_with_its_licence() -> None:
    listed = tomllib.loads((VENDOR / "vendored.toml").read_text("utf-8"))["component"]
    named = {name for c in listed for name in (*c["files"], c["licence_file"])}
    assert {p.name for p in VENDOR.iterdir()} == named | {"vendored.toml"}
    shipped = {
        f["name"]: f["hashes"][0]["content"]
        for c in sbom()["components"]
        if c["bom-ref"].startswith("vendored:")
        for f in c["components"]
    }
    assert shipped == {n: hashlib.sha256((VENDOR / n).read_bytes()).hexdigest() for n in named}
    for c in listed:
        assert c["version"] in (VENDOR / c["files"][0]).read_text("utf-8")[:400]
        assert (VENDOR / c["licence_file"]).stat().st_size > 500


def test_nothing_of_others_lies_elsewhere() -> None:
    """Code and fonts of others say so; what says so outside the vendor folder would have to be listed too."""
    own = ("derive", "generated", "ragg", "ragg_runtime", "docs/_static", "examples")
    for path in (p for folder in own for p in (ROOT / folder).rglob("*") if p.is_file()):
        if VENDOR in path.parents or "__pycache__" in path.parts:
            continue
        assert path.suffix not in (".woff", ".woff2", ".ttf", ".otf", ".eot", ".wasm", ".jar"), path
        if path.suffix in (".py", ".js", ".css", ".c", ".h", ".j2", ".html"):
            assert not re.search(r"copyright \(c\)|@license", path.read_text("utf-8"), re.IGNORECASE), path
