"""Derived models; do not edit: change the derivation and derive again. See manifest.json."""

from . import chain, folded, signatures

__all__ = ["chain", "folded", "signatures"]
