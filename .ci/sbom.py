"""CycloneDX from stdin (as cyclonedx-py writes it from the lock) with licences and what is vendored, to stdout.

The same lock and the same vendored files give the same bytes. Licences are those that the installed packages state.
"""

from __future__ import annotations

import hashlib
import json
import sys
import tomllib
from importlib import metadata
from pathlib import Path
from typing import Any

VENDORED = Path(__file__).parents[1] / "ragg_runtime" / "studio" / "static" / "vendor" / "vendored.toml"


def licence(name: str) -> str | None:
    """What an installed package says of its licence, in a line; ``None`` if it is not installed or says nothing."""
    try:
        about = metadata.metadata(name)
    except metadata.PackageNotFoundError:
        return None
    told = about.get("License-Expression") or about.get("License")
    if told and "\n" not in told and len(told) < 100:
        return str(told)
    kinds = [c.split(" :: ")[-1] for c in about.get_all("Classifier", []) if c.startswith("License ::")]
    return " AND ".join(kinds) or None


def package(c: dict[str, Any]) -> dict[str, Any]:
    found = licence(c["name"])
    kept = {k: c[k] for k in ("type", "name", "version", "purl")} | {"bom-ref": c["purl"]}
    return kept | ({"licenses": [{"license": {"name": found}}]} if found else {})


def vendored() -> list[dict[str, Any]]:
    """A component for each project whose files are shipped, with the digest of each file."""
    return [
        {
            "type": "library",
            "name": c["name"],
            "version": c["version"],
            "bom-ref": f"vendored:{c['name']}",
            "licenses": [{"license": {"id": c["licence"]}}],
            "externalReferences": [{"type": "vcs", "url": c["source"]}],
            "components": [
                {
                    "type": "file",
                    "name": name,
                    "bom-ref": f"vendored:{c['name']}:{name}",
                    "hashes": [{"alg": "SHA-256", "content": digest(VENDORED.with_name(name))}],
                }
                for name in (*c["files"], c["licence_file"])
            ],
        }
        for c in tomllib.loads(VENDORED.read_text("utf-8"))["component"]
    ]


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def main() -> None:
    bom = json.load(sys.stdin)
    packages = [package(c) for c in bom["components"]]
    bom["components"] = sorted(packages, key=lambda c: str(c["purl"])) + vendored()
    for tool in bom["metadata"]["tools"]["components"]:
        tool.pop("externalReferences", None)
    bom["dependencies"] = []  # a lock says what is installed, not what asked for it
    json.dump(bom, sys.stdout, indent=1, sort_keys=True)
    print()


if __name__ == "__main__":
    main()
