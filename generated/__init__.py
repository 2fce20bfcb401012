"""Derived models; do not edit: change the derivation and derive again. See manifest.json."""

from . import analytical, chain, signatures, simplified

__all__ = ["analytical", "chain", "signatures", "simplified"]
