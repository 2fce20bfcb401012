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
from derive.folded import Folded, folded
from derive.propagation import collect, ideal
from derive.transduction import starred

FORMAT = 1
"""Version of the generated interface, in every manifest."""

Files = Mapping[str, str]


def derive_base() -> Files:
    """The packaged models: analytical and simplified (Python, C, LaTeX), chain, signatures, manifest."""
    from derive.simplify import simplified

    return _derive(
        (),
        catalogue(),
        ir.harmonic(collect(), "analytical", "The analytical model of the RAGG (paper, Eq. 16-19)."),
        ir.harmonic(
            simplified(), "simplified", "The simplified analytical model of the RAGG (paper, Eq. 42-47)."
        ),
    )


def derive_model(effects: Sequence[Effect], candidates: Sequence[Effect]) -> Files:
    """A model with ``effects``: its chain, and the signatures of the ``candidates`` in it (none: no file)."""
    return _derive(effects, candidates)


def derive_plain(effects: Sequence[Effect]) -> Files:
    """The model with ``effects`` in C, for G_out alone, in the order of operations of the NumPy code."""
    active = [e for e in effects if e.kind in ("deterministic", "step")]
    header, source = render.plain_c(
        ir.chain(active, "plain", "The instrument as a chain of stages (paper, Eq. 1-15).")
    )
    return {"plain.h": header, "plain.c": source}


def _derive(effects: Sequence[Effect], candidates: Sequence[Effect], *harmonics: ir.Harmonic) -> Files:
    files: dict[str, str] = {}
    for m in harmonics:
        files[f"{m.name}.py"] = render.harmonic_numpy(m)
        files[f"c/{m.name}.h"], files[f"c/{m.name}.c"] = render.harmonic_c(m)
        files[f"latex/{m.name}.tex"] = render.harmonic_latex(m)
    if harmonics:
        files["latex/paper.tex"] = render.paper_latex(starred(), ideal(collect()))
        forms = [
            folded("folded", "The analytical model of the RAGG, folded for evaluation (paper, Eq. 1-15).")
        ]
    else:
        forms = []
    for f in forms:
        files[f"{f.name}.py"] = render.folded_numpy(f)
        files[f"c/{f.name}.h"], files[f"c/{f.name}.c"] = render.folded_c(f)
    active = [e for e in effects if e.kind in ("deterministic", "step")]
    chains = [ir.chain(active, "chain", "The instrument as a chain of stages (paper, Eq. 1-15).")]
    known = {e.id for e in effects}
    open_ = [e for e in candidates if e.id not in known and e.kind != "output"]
    if open_:
        title = "Signatures: what each candidate effect would add to V_j."
        chains.append(ir.chain(active, "signatures", title, candidates=open_))
    for c in chains:
        files[f"{c.name}.py"] = render.chain_numpy(c)
        # The packaged models are whole in C; of a model directory, C serves to evaluate it elsewhere.
        if harmonics or c.name == "chain":
            files[f"c/{c.name}.h"], files[f"c/{c.name}.c"] = render.chain_c(c)
    every = [*candidates, *(e for e in effects if e not in candidates)]
    return _complete(files, effects, every, [*harmonics, *forms, *chains])


def _complete(
    files: dict[str, str],
    effects: Sequence[Effect],
    candidates: Sequence[Effect],
    models: Sequence[ir.Harmonic | ir.Chain | Folded],
) -> Files:
    """Add the package file and the manifest, which names everything that was derived."""
    files["__init__.py"] = render.render("init.py.j2", modules=sorted(m.name for m in models))
    text = "".join(f"{name}\0{files[name]}\0" for name in sorted(files))
    manifest: dict[str, object] = {
        "format": FORMAT,
        "sympy": sympy.__version__,
        "digest": hashlib.sha256(text.encode()).hexdigest(),
        "effects": [e.id for e in effects],
        "files": sorted([*files, "manifest.json"]),
        "models": {m.name: ir.manifest_of_model(m) for m in models},
        "catalogue": [ir.manifest_of_effect(e) for e in candidates],
    }
    files["manifest.json"] = manifest_text(manifest)
    return dict(sorted(files.items()))


def manifest_text(manifest: Mapping[str, object]) -> str:
    """A manifest as it stands in the file."""
    return json.dumps(manifest, indent=1, ensure_ascii=False) + "\n"
