"""Names of a package that are imported when they are first used, from where its stub says.

The stub (``__init__.pyi``) is what editors and type checkers read; so there is one list of names, not two.
"""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

_LINE = re.compile(r"^from (\S+) import (\w+) as (\w+)$", re.MULTILINE)


def hand_on(package: str) -> None:
    """Give the package that is being imported the ``__getattr__``, ``__dir__`` and ``__all__`` of its stub."""
    own = sys.modules[package]
    assert own.__file__ is not None
    stub = Path(own.__file__).with_suffix(".pyi").read_text("utf-8")
    source = {name: (module, original) for module, original, name in _LINE.findall(stub)}

    def load(name: str) -> Any:
        if name not in source:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, original = source[name]
        value = getattr(import_module(module), original)
        setattr(own, name, value)
        return value

    vars(own).update(__getattr__=load, __dir__=lambda: sorted({*vars(own), *source}), __all__=sorted(source))
