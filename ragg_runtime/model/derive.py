"""Derive models at run time, SymPy imported only then; a model directory's ``generated/`` is never executed.

Effects in Python come from installed packages (entry points ``ragg.effects``) and from the folder ``RAGG_EFFECTS``, never from a
model directory: they are code.
"""

from __future__ import annotations

import inspect
import json
import os
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from importlib import metadata, resources
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeVar

from ragg_runtime.base.errors import UserError, at, did_you_mean
from ragg_runtime.base.files import digest_sources, find_private_folder, read_text, write_text
from ragg_runtime.instrument import layout as layouts
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.model.directory import DIGEST, compute_digest, read_digest
from ragg_runtime.model.model import Model, load_files, load_packaged
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.sections import Section, render_notebook

if TYPE_CHECKING:
    from derive.effect import Effect as SymbolicEffect
    from derive.layout import SymbolicForm, SymbolicLayout

E = TypeVar("E")

_SYMPY = threading.RLock()  # one thread at a time derives: SymPy's caches are not made for several


def list_known(instrument: Instrument) -> Mapping[str, SymbolicEffect]:
    """The effects that this instrument's model directory can use, by id: the catalogue's, the user's in Python, its one-line ones."""
    from derive.effects import catalogue

    with _SYMPY:
        definitions = [*catalogue(), *load_own_effects()]
        definitions += [_expression(s, instrument.path) for s in instrument.effects if s.expression]
    ids = [e.id for e in definitions]
    if twice := next((i for i in reversed(ids) if ids.count(i) > 1), None):
        raise UserError(
            "the id of your effect is taken",
            where=at(instrument.path, "effects"),
            found=repr(twice),
            remedy="choose another id",
        )
    return {e.id: e for e in definitions}


def _expression(s: EffectSetting, path: Path | None) -> SymbolicEffect:
    from derive.expression import ExpressionError, from_expression

    assert s.expression is not None
    try:
        return from_expression(s.id, s.expression["stage"], s.expression["add"], s.expression["params"])
    except ExpressionError as error:
        where = at(path, f"effect {s.id}")
        raise UserError("the expression is invalid", where=where, found=str(error)) from error


def find_effect(effects: Mapping[str, E], identifier: str, where: str | None = None) -> E:
    """The effect of this id; UserError if there is none."""
    if identifier in effects:
        return effects[identifier]
    raise UserError(
        "unknown effect",
        where=where,
        found=repr(identifier),
        expected="an id listed by `ragg effects`",
        remedy=did_you_mean(identifier, effects) or f"one of {', '.join(effects)}",
    )


def find_offered(instrument: Instrument, *ids: str) -> list[SymbolicEffect]:
    """The effects of these ids; UserError if there is none, or if the form of the instrument's model holds it already."""
    catalogue, form = list_known(instrument), make_symbolic_form(instrument)
    definitions = [find_effect(catalogue, i, at(instrument.path, "effects")) for i in ids]
    for e in definitions:
        if e.moot(form.order, form.kinematics):
            raise UserError(
                f"the effect {e.id} is already in the model",
                where=at(instrument.path, "effects"),
                found=f"[model] with {instrument.form.words()}",
                remedy="leave the effect out, or change [model]",
            )
    return definitions


def load_model(instrument: Instrument, *, candidates: bool = True) -> Model:
    """The model for an instrument's list of effects: the packaged one, or one derived for it, with the signatures of the others."""
    if not (instrument.effects or list_own_sources()) and _is_packaged(instrument):
        return load_packaged(instrument.form.kinematics)
    return _load(instrument, [s.id for s in instrument.effects], candidates=candidates)


def with_effects(
    instrument: Instrument, model: Model, further: Sequence[str], *, candidates: bool = False
) -> Model:
    """``model`` with further effects derived into it; with the signatures of the others only if ``candidates``."""
    return _load(instrument, [*(e.id for e in model.effects), *further], candidates=candidates)


def _load(instrument: Instrument, ids: Sequence[str], *, candidates: bool) -> Model:
    files = _derive_files(instrument, ids, candidates=candidates)
    return _execute_files(tuple(files.items()), instrument.layout)


@cache
def _execute_files(files: tuple[tuple[str, str], ...], layout: Layout) -> Model:
    return load_files(dict(files), layout)


def _derive_files(
    instrument: Instrument, ids: Sequence[str], *, candidates: bool = True
) -> Mapping[str, str]:
    """The files of an instrument's model, with effects of these ids, derived or kept."""
    digest = identify(instrument, ids, candidates=candidates)
    files = load_kept(digest)
    if files is None:
        from derive import pipeline

        catalogue = tuple(list_known(instrument).values()) if candidates else ()
        definitions = find_offered(instrument, *ids)
        with _SYMPY:
            files = pipeline.derive_model(definitions, catalogue, make_symbolic_form(instrument))
        keep_files(digest, files)
    return files


def make_symbolic_form(instrument: Instrument) -> SymbolicForm:
    """The form of an instrument's model as the derivation takes it."""
    from derive.layout import SymbolicForm
    from derive.stages import Order

    form, layout = instrument.form, _make_symbolic_layout(instrument.layout)
    order = Order(
        rotation=None if form.mounting == "exact" else int(form.mounting),
        misalignment=None if form.misalignment == "exact" else int(form.misalignment),
        second_order_angles=form.second_order_angles,
    )
    return SymbolicForm(order=order, kinematics=form.kinematics, layout=layout)


def _make_symbolic_layout(layout: Layout) -> SymbolicLayout:
    """The layout as the derivation takes it."""
    from derive.layout import PAPER as QUARTERS
    from derive.layout import SymbolicLayout, SymbolicOutput, rest_of_angles

    if layout.like_paper:
        return QUARTERS
    constants = layouts.list_constants(layout)
    return SymbolicLayout(
        names=layout.names,
        constants=constants,
        outputs=tuple(SymbolicOutput(o.name, o.members, o.signs) for o in layout.outputs),
        rest=rest_of_angles(layouts.find_degrees(layout), constants["cos_j"], constants["sin_j"]),
        own=True,
    )


def _is_packaged(instrument: Instrument) -> bool:
    """Whether such models come derived with the program: those of the paper's order and layout."""
    return instrument.form.preset == "paper" and instrument.layout.like_paper


def _has_files(instrument: Instrument) -> bool:
    """Whether a model directory of this instrument keeps derived code of its own."""
    return bool(instrument.effects) or not _is_packaged(instrument)


def list_files(instrument: Instrument) -> Mapping[str, str]:
    """The files of ``generated/`` in a model directory; none if the packaged model serves."""
    if not _has_files(instrument):
        return {}
    files = _derive_files(instrument, [s.id for s in instrument.effects])
    readable = {n: text for n, text in files.items() if not n.startswith("fits/")}
    return readable | {DIGEST: identify(instrument)}


def describe_departure(instrument: Instrument, generated: Path | None) -> str | None:
    """That a model directory's ``generated/`` was derived for something else, in a sentence; ``None``: it was not."""
    if generated is None or not _has_files(instrument) or read_digest(generated) == identify(instrument):
        return None
    return (
        "generated/ was not derived for this model.toml by this version; it is not used, and "
        "the next change of the model rewrites it"
    )


def derive_plain_c(instrument: Instrument) -> Mapping[str, str]:
    """The model in C, for G_out alone, in the order of operations of the NumPy code: file name -> text."""
    from derive import pipeline

    definitions = find_offered(instrument, *(s.id for s in instrument.effects))
    return pipeline.derive_plain(definitions, make_symbolic_form(instrument))


def read_chain(instrument: Instrument) -> str:
    """The text of the chain in NumPy."""
    if _has_files(instrument):
        return list_files(instrument)["chain.py"]
    package = "generated" if instrument.form.kinematics == "platform" else "generated.full"
    return resources.files(package).joinpath("chain.py").read_text("utf-8")


# derivations that are kept, at most half a megabyte each: enough for each effect of the catalogue, and pairs of the usual ones
MOST_KEPT = 200


def identify(instrument: Instrument, ids: Sequence[str] | None = None, *, candidates: bool = True) -> str:
    """Digest of all that a derivation depends on, for effects of these ids (else its own), and all ``candidates``."""
    expressions: dict[str, object] = {}
    for s in instrument.effects:
        if s.expression is not None:  # the values of its parameters do not matter
            parameters = {
                n: {k: repr(q[k]) for k in ("unit", "plausible", "shared") if k in q}
                for n, q in s.expression["params"].items()
            }
            expressions[s.id] = [s.expression["stage"], s.expression["add"], parameters]
    effect_ids = [s.id for s in instrument.effects] if ids is None else ids
    parts: list[object] = [
        digest_sources("derive", suffixes=(".py", ".j2"), first=metadata.version("sympy")),
        [[i, expressions.get(i)] for i in effect_ids],
        sorted(map(compute_digest, list_own_sources().values())),
        asdict(instrument.form),
        candidates and expressions,
    ]
    layout = instrument.layout
    if not layout.like_paper:
        outputs = [[o.name, o.members, o.signs] for o in layout.outputs]
        parts += [layout.names, dict(layouts.list_constants(layout)), outputs]
    return compute_digest(json.dumps(parts, sort_keys=True))


def load_kept(digest: str) -> Mapping[str, str] | None:
    """The files that were derived before for what this digest identifies, if they are at hand."""
    place = find_private_folder("derived") / f"{digest}.json"
    try:
        files = json.loads(place.read_text("utf-8"))
        os.utime(place)  # used last: the others go first
    except (OSError, ValueError):
        return None
    return files if "manifest.json" in files else None


def keep_files(digest: str, files: Mapping[str, str]) -> None:
    """Keep what a derivation yielded; where that cannot be written, it will be derived again."""
    folder = find_private_folder("derived")
    try:
        write_text(folder / f"{digest}.json", json.dumps(dict(files)))
        for old in sorted(folder.glob("*.json"), key=lambda p: -p.stat().st_mtime)[MOST_KEPT:]:
            old.unlink(missing_ok=True)
    except (OSError, UserError):
        return


GROUP = "ragg.effects"  # the group of entry points of packages; each is a module with EFFECT
VARIABLE = "RAGG_EFFECTS"  # names a folder of Python files with EFFECT


def list_own_sources() -> Mapping[str, str]:
    """The text of every module of a package or of RAGG_EFFECTS that defines an effect, by its name or path."""
    sources = {name: inspect.getsource(module) for name, module in _load_installed().items()}
    if named := os.environ.get(VARIABLE):
        if not Path(named).is_dir():
            raise UserError("there is no folder of effects", where=VARIABLE, found=named)
        files = sorted(p for p in Path(named).glob("*.py") if not p.name.startswith((".", "_")))
        sources |= {str(path): read_text(path) for path in files}
    return sources


def load_own_effects() -> tuple[SymbolicEffect, ...]:
    """The effects that they define, by id; UserError if one cannot be read."""
    sources = list_own_sources()
    if not sources:  # to import what derives takes a while
        return ()
    from derive.effects import of_module, of_text

    definitions = []
    for name, text in sources.items():
        try:
            module = _load_installed().get(name)
            definitions.append(of_text(Path(name), text) if module is None else of_module(module, text))
        except ValueError as error:
            raise _report_unread(name, error) from error
    return tuple(sorted(definitions, key=lambda e: e.id))


def list_own_entries() -> tuple[Mapping[str, Any], ...]:
    """Their entries in a catalogue."""
    definitions = load_own_effects()
    if not definitions:
        return ()
    from derive.ir import manifest_of_effect

    return tuple(manifest_of_effect(e) for e in definitions)


@cache
def _load_installed() -> Mapping[str, ModuleType]:
    modules = {}
    for entry in sorted(metadata.entry_points(group=GROUP), key=lambda e: e.value):
        try:
            modules[entry.value] = entry.load()
        except Exception as error:
            raise _report_unread(entry.value, error) from error
    return modules


def _report_unread(where: str, error: Exception) -> UserError:
    return UserError("an effect of your own cannot be read", where=where, found=str(error))


def rederive(root: Path) -> list[str]:
    """Derive everything that comes with the program and write it below ``root``; returns the paths that changed.

    Cut off, it leaves whole files; the next one writes the others.
    """
    from derive import pipeline

    changed = pipeline.write(pipeline.derive_base(), root / pipeline.GENERATED)
    return [f"{pipeline.GENERATED}/{name}" for name in changed]


def check(root: Path) -> None:
    """UserError unless what is below ``root`` is what the derivation yields. Nothing is written."""
    from derive import pipeline

    if difference := pipeline.diff_files(pipeline.derive_base(), root / pipeline.GENERATED):
        raise UserError(
            "the committed code does not match the derivation",
            where=root / pipeline.GENERATED,
            found="\n" + difference,
            expected="the same files, byte for byte, with the SymPy of requirements.lock",
            remedy="run: make derive   (or: ragg derive), look at the change, and commit it",
        )


def find_root() -> Path:
    """The root of the project, to write to unless another is named."""
    return Path(str(resources.files("derive"))).parent


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
    text = (find_root() / "generated" / "manifest.json").read_text("utf-8")
    return Catalogue((*json.loads(text)["catalogue"], *list_own_entries()))
