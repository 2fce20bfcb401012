"""How inline and cross were made of an output before they were recorded: ``[demodulator]`` of model.toml or of a mapping.

[demodulator]
kind = "butterworth"   # fir: ours; butterworth: forward and backward; causal: forward alone; average: a moving average; none
cutoff = "0.18 Hz"     # fir: half amplitude; butterworth, causal: half power of one pass
order = 6              # of butterworth, in each direction, and of causal
length = "4 s"         # of average, about the sample
delay = "0 s"          # by which the channels stand later than that low-pass makes them
rate = "16 Hz"         # at which they were made, if they were thinned out afterwards
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ragg_runtime.base.errors import UserError, at, check_keys, did_you_mean
from ragg_runtime.instrument.units import read_quantity, units

KINDS: Mapping[str, tuple[str, ...]] = {
    "fir": ("cutoff",),
    "butterworth": ("cutoff", "order"),
    "causal": ("cutoff", "order"),
    "average": ("length",),
    "causal average": ("length",),
    "none": (),
}
"""Each kind of low-pass, and the keys that it needs (``cutoff`` of fir may be left out)."""

MOST_ORDER = 12
"""Of a Butterworth low-pass: beyond it, at a hundredth of the sampling rate, its sections lose what precision there is."""

_UNITS: Mapping[str, str] = {"cutoff": "Hz", "length": "s", "delay": "s", "rate": "Hz"}
_KEYS = ("kind", "cutoff", "order", "length", "delay", "rate")


@dataclass(frozen=True)
class Demodulation:
    """A low-pass of the mixed output; what a kind does not have is ``None``. ``cutoff``, ``rate``: Hz; ``length``, ``delay``: s."""

    kind: str = "fir"
    cutoff: float | None = None
    order: int | None = None
    length: float | None = None
    delay: float = 0.0
    rate: float | None = None

    def words(self) -> str:
        """In half a sentence."""
        size = f"{self.length:.3g} s" if self.length is not None else ""
        text = {
            "none": "no low-pass at all (the output times its carriers)",
            "fir": "the linear-phase low-pass of this program",
            "butterworth": f"a Butterworth low-pass, forward and backward, of order {self.order}",
            "causal": f"a causal Butterworth low-pass of order {self.order}",
            "average": f"a moving average over the surrounding {size}",
            "causal average": f"a moving average over the last {size}",
        }[self.kind]
        text += f" at {self.cutoff:.3g} Hz" if self.cutoff is not None else ""
        text += f", delayed by {self.delay:.3g} s" if self.delay else ""
        return text + (f", made at {self.rate:.6g} Hz" if self.rate is not None else "")

    def entries(self, digits: str = "") -> dict[str, str | int]:
        """Keys and values as they stand in a file; numbers with so many ``digits`` (a format), or all."""
        found: dict[str, str | int] = {"kind": self.kind}
        for key in _KEYS[1:]:
            value = getattr(self, key)
            if value is not None and value != 0.0:
                found[key] = value if key == "order" else f"{value:{digits}} {_UNITS[key]}"
        return found

    def toml(self) -> str:
        """The same on one line, rounded."""
        text = {k: f'"{v}"' if isinstance(v, str) else v for k, v in self.entries(".4g").items()}
        return ", ".join(f"{k} = {v}" for k, v in text.items())


OURS = Demodulation()


def read_demodulation(table: object, where: str) -> Demodulation | None:
    """``[demodulator]`` of a parsed file; ``None``: it is not there. UserError names the key."""
    if table is None:
        return None
    if not isinstance(table, dict):
        raise UserError(
            "demodulator must be a table", where=where, found=repr(table)[:60], expected="[demodulator]"
        )
    check_keys(table, _KEYS, where)
    kind = table.get("kind", "fir")
    if not isinstance(kind, str) or kind not in KINDS:
        raise UserError(
            "there is no such demodulator",
            where=at(where, "kind"),
            found=repr(kind)[:60],
            expected=", ".join(KINDS),
            remedy=did_you_mean(str(kind), tuple(KINDS)),
        )
    _fits(kind, table, where)
    sizes = {k: _size(table, k, where) for k in _UNITS}
    return Demodulation(
        kind=kind,
        cutoff=sizes["cutoff"],
        order=_order(table, where),
        length=sizes["length"],
        delay=sizes["delay"] or 0.0,
        rate=sizes["rate"],
    )


def _fits(kind: str, table: Mapping[str, Any], where: str) -> None:
    """UserError if a key that the kind needs is missing, or one is there that it does not have."""
    needed = () if kind == "fir" else KINDS[kind]
    missing = [k for k in needed if k not in table]
    foreign = [k for k in ("cutoff", "order", "length") if k in table and k not in KINDS[kind]]
    if missing or foreign:
        said = f"no {', '.join(missing)}" if missing else f"{', '.join(foreign)}, which {kind} does not have"
        raise UserError(
            f"the demodulator {kind} is not described",
            where=where,
            found=said,
            expected=", ".join(KINDS[kind]),
            remedy="ask whoever made the channels",
        )


def _size(table: Mapping[str, Any], key: str, where: str) -> float | None:
    if key not in table:
        return None
    place = at(where, key)
    q = read_quantity(table[key], place, count=1)
    value = float(
        units(9.8).to_si(float(q.value) if isinstance(q.value, float) else 0.0, q.unit, _UNITS[key], place)
    )
    if key != "delay" and value <= 0.0:
        raise UserError(f"{key} must be positive", where=place, found=str(table[key])[:60])
    return value


def _order(table: Mapping[str, Any], where: str) -> int | None:
    order = table.get("order")
    if order is None:
        return None
    if isinstance(order, bool) or not isinstance(order, int) or not 1 <= order <= MOST_ORDER:
        raise UserError(
            "no such order", where=at(where, "order"), found=repr(order)[:60], expected=f"1 to {MOST_ORDER}"
        )
    return order
