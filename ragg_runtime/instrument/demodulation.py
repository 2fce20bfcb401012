"""How inline and cross were made of an output before they were recorded: ``[demodulator]`` of model.toml or of a mapping.

[demodulator]
kind = "butterworth"   # fir: the default; butterworth: forward and backward; causal: forward alone
cutoff = "0.18 Hz"     # fir: half amplitude; butterworth, causal: half power of one pass
order = 6              # of butterworth, in each direction, and of causal
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ragg_runtime.base.errors import UserError, at, check_choice, check_keys, check_table
from ragg_runtime.instrument.units import STANDARD_G0, read_quantity, read_si

KINDS: Mapping[str, tuple[str, ...]] = {
    "fir": (),
    "butterworth": ("cutoff", "order"),
    "causal": ("cutoff", "order"),
}
"""Each kind of low-pass, and the keys that it needs."""

# of a Butterworth low-pass: beyond it, at a hundredth of the sampling rate, its sections lose their precision
MOST_ORDER = 12


@dataclass(frozen=True)
class Demodulation:
    """A low-pass of the mixed output; ``None``: the usual ``cutoff``, Hz, or ``order``, which fir does not have."""

    kind: str = "fir"
    cutoff: float | None = None
    order: int | None = None

    def words(self) -> str:
        """In half a sentence."""
        text = {
            "fir": "the linear-phase low-pass of this program",
            "butterworth": f"a Butterworth low-pass, forward and backward, of order {self.order}",
            "causal": f"a causal Butterworth low-pass of order {self.order}",
        }[self.kind]
        return text + (f" at {self.cutoff:.3g} Hz" if self.cutoff is not None else "")

    def entries(self) -> dict[str, str | int]:
        """Keys and values for a file."""
        cutoff = {} if self.cutoff is None else {"cutoff": f"{self.cutoff} Hz"}
        return {"kind": self.kind, **cutoff, **({} if self.order is None else {"order": self.order})}


OURS = Demodulation()


def read_demodulation(table: object, where: str) -> Demodulation | None:
    """``[demodulator]`` of a parsed file; ``None``: it is not there. UserError names the key."""
    if table is None:
        return None
    table = check_table(table, "demodulator", where, "[demodulator]")
    kind = table.get("kind", "fir")
    check_choice(kind, tuple(KINDS), at(where, "kind"), "there is no such demodulator")
    check_keys(table, ("kind", *(KINDS[kind] or ("cutoff",))), where)
    if missing := [k for k in KINDS[kind] if k not in table]:
        raise UserError(
            f"the demodulator {kind} is not described",
            where=where,
            found=f"no {', '.join(missing)}",
            expected=", ".join(KINDS[kind]),
            remedy="ask whoever made the channels",
        )
    order = table.get("order")
    if order is not None and not (type(order) is int and 1 <= order <= MOST_ORDER):
        raise UserError(
            "no such order", where=at(where, "order"), found=repr(order)[:60], expected=f"1 to {MOST_ORDER}"
        )
    return Demodulation(
        kind, _read_cutoff(table["cutoff"], at(where, "cutoff")) if "cutoff" in table else None, order
    )


def _read_cutoff(raw: object, where: str) -> float:
    value = float(read_si(read_quantity(raw, where, count=1), "Hz", STANDARD_G0, where)[0])
    if value <= 0.0:
        raise UserError("cutoff must be positive", where=where, found=str(raw)[:60])
    return value
