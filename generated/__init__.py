"""Derived models; do not edit: change the derivation and derive again. See manifest.json."""

from . import analytical, chain, folded, signatures, simplified

__all__ = ["analytical", "chain", "folded", "signatures", "simplified"]
