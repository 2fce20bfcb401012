"""The derivation as a whole: stages -> harmonics -> frozen result -> source text.

``derive_base`` gives every file of the packaged ``generated/``; ``derive_model`` those of a model directory
with a list of effects. Both are pure: a mapping from path to text, the same bytes for the same input.
"""

from __future__ import annotations

import dataclasses
import difflib
import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import sympy as sp
from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from derive import ir, stages
from derive.effect import Effect
from derive.effects import catalogue, recogniser_package, recognisers
from derive.emit import Files, write_form
from derive.emit import c as _c
from derive.emit import numpy as _numpy
from derive.folded import Folded, folded
from derive.layout import PAPERS, SymbolicForm
from derive.propagation import collect, ideal
from derive.stages import PAPER
from derive.symbols import SECOND_ORDER, symbol

GENERATED = "generated"

FORMAT = 1
"""Version of the generated interface, in every manifest."""

FITS = "fits"
"""Folder of what serves fits alone, and is no part of a model directory: the signatures in C."""

FULL = "full"
"""Folder of the packaged model of full kinematics."""


def derive_base() -> Files:
    """The packaged models: analytical and simplified (Python, C, LaTeX), chain, signatures, manifest.

    In the folder ``full`` the model that includes the disc's own rotation, at the paper's order: chain, folded form,
    signatures. In ``output_effects`` what recognises the effects of the recorder.
    """
    from derive.simplify import simplified

    analytical = ir.harmonic(collect(), "analytical", "The analytical model of the RAGG (paper, Eq. 16-19).")
    simple = ir.harmonic(
        simplified(), "simplified", "The simplified analytical model of the RAGG (paper, Eq. 42-47)."
    )
    full = _derive(SymbolicForm(kinematics="full"), (), catalogue(), packaged=True)
    below = {f"{FULL}/{name}": text for name, text in full.items()}
    below |= {**recognisers(catalogue()), **recogniser_package(catalogue())}
    platform = _derive(PAPERS, (), catalogue(), analytical, simple, packaged=True, below=tuple(below))
    return dict(sorted({**platform, **below}.items()))


def derive_model(
    effects: Sequence[Effect], candidates: Sequence[Effect], form: SymbolicForm = PAPERS
) -> Files:
    """A model with ``effects``: its chain, and the signatures of the ``candidates`` in it (none: no file).

    The folder :data:`FITS` is not part of the model: the manifest does not list it.
    Effects of the recorder bring their recogniser, those of the catalogue apart: theirs come with the program.
    """
    below = recognisers(e for e in candidates if e not in catalogue())
    files = _derive(form, effects, candidates, below=tuple(below))
    return dict(sorted({**files, **below}.items()))


def derive_plain(effects: Sequence[Effect], form: SymbolicForm = PAPERS) -> Files:
    """The model with ``effects`` in C, for G_out alone, in the order of operations of the NumPy code."""
    (chain, *_) = _chains(form, effects, ())
    return _c.plain(chain)


def _derive(
    form: SymbolicForm,
    effects: Sequence[Effect],
    candidates: Sequence[Effect],
    *harmonics: ir.Harmonic,
    packaged: bool = False,
    below: Sequence[str] = (),
) -> Files:
    candidates = [e for e in candidates if not e.moot(form.order, form.kinematics)]  # held already
    forms = [] if _select_active(effects) else [folded(form)]
    chains = _chains(form, effects, candidates)
    models: list[ir.Harmonic | ir.ChainProgram | Folded] = [*harmonics, *forms, *chains]
    files: dict[str, str] = {}
    for m in harmonics:
        write_form(files, "harmonic", m)
    for f in forms:
        write_form(files, "folded", f)
    for x in chains:
        write_form(files, "chain", x, packaged=packaged)
    if harmonics:
        write_form(files, "paper", starred(), ideal(collect()))
    files["__init__.py"] = _numpy.package_file([m.name for m in models])
    text = "".join(f"{name}\0{files[name]}\0" for name in sorted(files))
    manifest: dict[str, object] = {
        "format": FORMAT,
        "sympy": sp.__version__,
        "digest": hashlib.sha256(text.encode()).hexdigest(),
        **({} if form == PAPERS else {"form": _describe_form(form)}),
        "effects": [e.id for e in effects],
        "files": sorted([*files, *below, "manifest.json"]),
        "models": {m.name: ir.manifest_of_model(m) for m in models},
        "catalogue": [
            ir.manifest_of_effect(e) for e in (*candidates, *(e for e in effects if e not in candidates))
        ],
    }
    files["manifest.json"] = json.dumps(manifest, indent=1, ensure_ascii=False) + "\n"
    if not packaged:
        (of_fits,) = [_c.chain(x, packaged=True) for x in chains if x.name == "signatures"] or [{}]
        files |= {f"{FITS}/{n.rpartition('/')[2]}": text for n, text in of_fits.items()}
    return files


def _select_active(effects: Sequence[Effect]) -> list[Effect]:
    """Those that change the voltages."""
    return [e for e in effects if e.kind in ("deterministic", "step")]


def _chains(
    form: SymbolicForm, effects: Sequence[Effect], candidates: Sequence[Effect]
) -> list[ir.ChainProgram]:
    active = _select_active(effects)
    title = "The instrument as a chain of stages (paper, Eq. 1-15)."
    chains = [ir.chain(active, "chain", title, form)]
    ids = {e.id for e in effects}
    open_ = [e for e in candidates if e.id not in ids and e.kind != "output" and e.searched]
    if open_:
        title = "Signatures: what each candidate effect would add to V_j."
        chains.append(ir.chain(active, "signatures", title, form, open_))
    return chains


def _describe_form(form: SymbolicForm) -> Mapping[str, object]:
    """A form as the manifest lists it; the paper's layout is left out."""
    described = dataclasses.asdict(form)
    del described["layout"]["own"]  # it follows from the rest of model.toml
    if form.layout.is_paper:
        del described["layout"]
    return described


STARRED: Mapping[str, tuple[int, int, int]] = {
    "vartheta_z": (0, 1, 0),
    "vartheta_y": (0, 0, 1),
    "K2": (2, 0, 0),
    "K4": (1, 0, 1),
    "K5": (0, 2, 0),
    "K6": (1, 1, 0),
    "K7": (0, 0, 2),
    "K8": (0, 1, 1),
}
"""Starred quantity of Eq. 5a -> powers of (f_x, f_y, f_z) that it multiplies (vartheta_y with a minus sign)."""


@cache
def starred() -> dict[str, sp.Expr]:
    """Eq. 5b: every starred coefficient by the angles and the second-order coefficients."""
    forces = [symbol(n) for n in ("f_x", "f_y", "f_z")]
    angles = [symbol(f"vartheta_{k}") for k in "xyz"]
    coefficients = [symbol(n) for n in SECOND_ORDER]
    ring = PolyRing([*forces, *angles, *coefficients], QQ, lex)
    x, y, z = (stages.turn(sp.eye(3)[:, n], -a, PAPER.rotation) for n, a in enumerate(angles))
    sensed = z * (y * (x * sp.Matrix(forces)))
    f = stages.SensedForce(*(ring.from_expr(e) for e in sensed))
    k = {s.name: ring.from_expr(s) for s in coefficients} | {"K0": ring.zero}
    by_powers: dict[tuple[int, ...], dict[tuple[int, ...], object]] = {}
    for monomial, c in stages.transducer(f, f, k).terms():
        by_powers.setdefault(monomial[:3], {})[(0, 0, 0, *monomial[3:])] = c
    signs = {"vartheta_y": -1}
    return {
        name: ring.from_dict(by_powers[powers]).as_expr() * signs.get(name, 1)
        for name, powers in STARRED.items()
    }


def write(files: Mapping[str, str], folder: Path) -> list[str]:
    """Make ``folder`` hold these files; returns the paths that changed.

    Each file is replaced by a rename, so that none is ever half-written. Files that are not derived are removed; caches
    (``__pycache__``) are left alone.
    """
    changed = []
    for name, text in files.items():
        path = folder / name
        if path.is_file() and path.read_bytes() == text.encode():
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_name(f"{path.name}.new")
        temporary.write_bytes(text.encode())
        temporary.replace(path)
        changed.append(name)
    for name in _list_files(folder):
        if name not in files:
            (folder / name).unlink()
            changed.append(name)
    return changed


def diff_files(files: Mapping[str, str], folder: Path, lines: int = 40) -> str:
    """Empty if ``folder`` holds these files and only them, byte for byte; else a diff."""
    present = _list_files(folder)
    report = [f"missing: {n}" for n in files if n not in present]
    report += [f"not derived: {n}" for n in present if n not in files]
    for name in (n for n in files if n in present):
        old = (folder / name).read_bytes()
        if old != files[name].encode():
            texts = old.decode(errors="replace").splitlines(), files[name].splitlines()
            diff = difflib.unified_diff(*texts, f"committed/{name}", f"derived/{name}", lineterm="", n=1)
            report += list(diff) or [f"{name}: line endings or final newline differ"]
    if len(report) > lines:
        report = [*report[:lines], f"... and {len(report) - lines} more lines"]
    return "\n".join(report)


def _list_files(folder: Path) -> list[str]:
    """The files below a folder; links are none, for what they lead to is elsewhere."""
    if folder.is_symlink():
        return []
    paths = (
        p for p in folder.rglob("*") if p.is_file() and not p.is_symlink() and "__pycache__" not in p.parts
    )
    return sorted(p.relative_to(folder).as_posix() for p in paths)
