"""The derivation as a whole: stages -> harmonics -> frozen result -> source text.

``derive_base`` gives every file of the packaged ``generated/``; ``derive_model`` those of a model directory
with a list of effects. Both are pure: a mapping from path to text, the same bytes for the same input.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence

import sympy

from derive import ir
from derive.effect import Effect
from derive.effects import catalogue
from derive.emit import render
from derive.propagation import collect

FORMAT = 1
"""Version of the generated interface, in every manifest."""

Files = Mapping[str, str]


def derive_base() -> Files:
    """The packaged models: analytical and simplified (Python, C, LaTeX), chain, signatures, manifest."""
    from derive.simplify import simplified

    files: dict[str, str] = {}
    harmonic = [
        ir.harmonic(collect(), "analytical", "The analytical model of the RAGG (paper, Eq. 16-19)."),
        ir.harmonic(
            simplified(), "simplified", "The simplified analytical model of the RAGG (paper, Eq. 42-47)."
        ),
    ]
    for m in harmonic:
        files[f"{m.name}.py"] = render.harmonic_numpy(m)
        files[f"c/{m.name}.h"], files[f"c/{m.name}.c"] = render.harmonic_c(m)
        files[f"latex/{m.name}.tex"] = render.harmonic_latex(m)
    return _complete(files | dict(derive_model((), catalogue())), (), catalogue())


def derive_model(effects: Sequence[Effect], candidates: Sequence[Effect]) -> Files:
    """A model with ``effects``: its chain, and the signatures of the ``candidates`` in it (none: no file)."""
    active = [e for e in effects if e.kind in ("deterministic", "step")]
    chains = [ir.chain(active, "chain", "The instrument as a chain of stages (paper, Eq. 1-15).")]
    files: dict[str, str] = {}
    files["c/chain.h"], files["c/chain.c"] = render.chain_c(chains[0])
    known = {e.id for e in effects}
    open_ = [e for e in candidates if e.id not in known and e.kind != "output"]
    if open_:
        title = "Signatures: what each candidate effect would add to V_j."
        chains.append(ir.chain(active, "signatures", title, candidates=open_))
    for c in chains:
        files[f"{c.name}.py"] = render.chain_numpy(c)
    every = [*candidates, *(e for e in effects if e not in candidates)]
    return _complete(files, effects, every, *chains)


def _complete(
    files: dict[str, str],
    effects: Sequence[Effect],
    candidates: Sequence[Effect],
    *chains: ir.Chain,
) -> Files:
    """Add the package file and the manifest, which names everything that was derived."""
    modules = sorted(
        n.removesuffix(".py") for n in files if n.endswith(".py") and "/" not in n and n[0] != "_"
    )
    files["__init__.py"] = render.render("init.py.j2", modules=modules)
    text = "".join(f"{name}\0{files[name]}\0" for name in sorted(files) if name != "manifest.json")
    manifest: dict[str, object] = {
        "format": FORMAT,
        "sympy": sympy.__version__,
        "digest": hashlib.sha256(text.encode()).hexdigest(),
        "effects": [e.id for e in effects],
        "files": sorted([*(n for n in files if n != "manifest.json"), "manifest.json"]),
        "catalogue": [ir.manifest_of_effect(e) for e in candidates],
    }
    if chains:
        manifest["models"] = {
            c.name: {
                "inputs": [{"name": i.name, "unit": i.unit, "meaning": i.meaning} for i in c.inputs],
                "parameters": [
                    {"name": q.name, "unit": q.unit, "size": q.size, "meaning": q.meaning}
                    for q in c.parameters
                ],
                "rows": [r.name for r in c.rows],
                "operations": {"value": ir.operations(c.value), "derivatives": ir.operations(c.derivatives)},
            }
            for c in chains
        }
    else:
        manifest["models"] = json.loads(files["manifest.json"])["models"]
    files["manifest.json"] = json.dumps(manifest, indent=1, ensure_ascii=False) + "\n"
    return dict(sorted(files.items()))
