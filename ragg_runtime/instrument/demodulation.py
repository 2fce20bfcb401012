"""How inline and cross were made of an output before they were recorded: ``[demodulator]`` of model.toml or of a mapping.

[demodulator]
kind = "butterworth"   # fir: the default; butterworth: forward and backward; causal: forward alone; average: a moving average; none
cutoff = "0.18 Hz"     # fir: half amplitude; butterworth, causal: half power of one pass
order = 6              # of butterworth, in each direction, and of causal
length = "4 s"         # of average, about the sample
delay = "0 s"          # by which the channels are later than that low-pass makes them
rate = "16 Hz"         # at which they were made, if they were thinned out afterwards
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ragg_runtime.base.errors import UserError, at, check_choice, check_keys, check_table
from ragg_runtime.instrument.units import STANDARD_G0, read_quantity, read_si

KINDS: Mapping[str, tuple[str, ...]] = {
    "fir": ("cutoff",),
    "butterworth": ("cutoff", "order"),
    "causal": ("cutoff", "order"),
    "average": ("length",),
    "causal average": ("length",),
    "none": (),
}
"""Each kind of low-pass, and the keys that it needs (``cutoff`` of fir may be left out)."""

# of a Butterworth low-pass: beyond it, at a hundredth of the sampling rate, its sections lose their precision
MOST_ORDER = 12

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
        """Keys and values for a file; numbers with so many ``digits`` (a format), or all."""
        entries: dict[str, str | int] = {"kind": self.kind}
        for key in _KEYS[1:]:
            value = getattr(self, key)
            if value is not None and value != 0.0:
                entries[key] = value if key == "order" else f"{value:{digits}} {_UNITS[key]}"
        return entries

    def toml(self) -> str:
        """The same on one line, rounded."""
        text = {k: f'"{v}"' if isinstance(v, str) else v for k, v in self.entries(".4g").items()}
        return ", ".join(f"{k} = {v}" for k, v in text.items())


OURS = Demodulation()


def read_demodulation(table: object, where: str) -> Demodulation | None:
    """``[demodulator]`` of a parsed file; ``None``: it is not there. UserError names the key."""
    if table is None:
        return None
    table = check_table(table, "demodulator", where, "[demodulator]")
    check_keys(table, _KEYS, where)
    kind = table.get("kind", "fir")
    check_choice(kind, tuple(KINDS), at(where, "kind"), "there is no such demodulator")
    missing = [k for k in KINDS[kind] if k not in table and kind != "fir"]
    foreign = [k for k in ("cutoff", "order", "length") if k in table and k not in KINDS[kind]]
    if missing or foreign:
        raise UserError(
            f"the demodulator {kind} is not described",
            where=where,
            found=f"no {', '.join(missing)}"
            if missing
            else f"{', '.join(foreign)}, which {kind} does not have",
            expected=", ".join(KINDS[kind]),
            remedy="ask whoever made the channels",
        )
    order = table.get("order")
    if order is not None and not (type(order) is int and 1 <= order <= MOST_ORDER):
        raise UserError(
            "no such order", where=at(where, "order"), found=repr(order)[:60], expected=f"1 to {MOST_ORDER}"
        )
    sizes = {key: _read_size(table[key], key, at(where, key)) for key in _UNITS if key in table}
    return Demodulation(kind=kind, order=order, **sizes)


def _read_size(raw: object, key: str, where: str) -> float:
    value = float(read_si(read_quantity(raw, where, count=1), _UNITS[key], STANDARD_G0, where)[0])
    if key != "delay" and value <= 0.0:
        raise UserError(f"{key} must be positive", where=where, found=str(raw)[:60])
    return value
