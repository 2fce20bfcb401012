"""A flight in memory: what the columns mean, their SI units, and the record itself."""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Demodulation

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SPECIFIC_FORCE = ("a_x", "a_y", "a_z")
ANGULAR_RATE = ("omega_x", "omega_y", "omega_z")
ANGULAR_ACCELERATION = ("omegadot_x", "omegadot_y", "omegadot_z")
GRADIENT = ("Gamma_xx", "Gamma_xy", "Gamma_xz", "Gamma_yy", "Gamma_yz", "Gamma_zz")
VOLTAGES = ("V_1", "V_2", "V_3", "V_4")
DEMODULATED = ("inline", "cross")
RATES = frozenset(
    f"{d}_{name}"
    for d in ("d", "d2")
    for name in (*SPECIFIC_FORCE, *ANGULAR_RATE, *ANGULAR_ACCELERATION, *GRADIENT)
)
"""Time derivatives of the motion: models form them from it, whatever columns of these names hold."""

AUXILIARY: Mapping[str, str] = MappingProxyType(
    {"temperature": "K", "roll": "rad", "pitch": "rad", "yaw": "rad", "pressure": "Pa"}
    | {"B_x": "T", "B_y": "T", "B_z": "T", "fuel_mass": "kg"}
    | {"vibration_rms": "m/s^2", "angular_vibration_rms": "rad/s"}
    | {"balance_current": "A", "second_order_current": "A"}
    | {"mass_x": "m", "mass_y": "m", "mass_z": "m"}
)
"""Auxiliary channels of fixed meaning and their SI units; any other name is an auxiliary channel as well."""

SI_UNITS: Mapping[str, str] = MappingProxyType(
    {"time": "s"}
    | dict.fromkeys(SPECIFIC_FORCE, "m/s^2")
    | dict.fromkeys(ANGULAR_RATE, "rad/s")
    | dict.fromkeys(ANGULAR_ACCELERATION, "rad/s^2")
    | dict.fromkeys(GRADIENT, "s^-2")
    | {"spin_angle": "rad"}
    | dict(AUXILIARY)
    | dict.fromkeys(("G_out", *VOLTAGES), "V")
    | dict.fromkeys(DEMODULATED, "s^-2")
)
"""SI unit of every column whose meaning is fixed. Other auxiliary channels are held in SI base units."""

# most samples in a row that are a spike; a longer excursion is the signal, a longer stretch without samples a gap
WIDEST_SPIKE = 3

SAME_RECORD = "the same record as {}: it would count twice"
# the note of a segment of time, s, that the user has left out
LEFT_OUT = "left out by hand: {:g} s to {:g} s"


def is_disc_angle(name: str) -> bool:
    """Whether a column is the angle of a disc by its name: ``spin_angle``, ``spin_angle_A`` ..."""
    return name.startswith("spin_angle")


@dataclass(frozen=True)
class Flag:
    """Something odd about some samples of a record, and what that means for a verdict."""

    columns: tuple[str, ...]  # names of those that it is about; empty: the whole record
    reason: str  # what is odd, and what was done about it: the sentence that a user reads
    open: bool = False  # whether it is still in the record: of such a record only ``effects`` may be claimed
    effects: tuple[str, ...] = ()  # ids of those that describe the same, and may be claimed with it
    # motion-noise of sensors whose noise shows in the output, still where one of their columns holds one value, coarse of a
    # thermometer that reads few values; else empty
    kind: str = ""


@dataclass(frozen=True, eq=False)
class Flight:
    """A uniformly sampled record of motion, auxiliary channels and output, in SI, float64."""

    time: Array  # (N,) s: a sample every 1/rate
    # name -> (N,): motion (m/s^2, rad/s, rad/s^2), gradients (s^-2), spin_angle (rad), auxiliaries; interpolated where the file has none
    channels: Mapping[str, Array]
    # name -> (N,): G_out and V_1 ... in V, inline and cross in s^-2; NaN where the file has none
    outputs: Mapping[str, Array]
    name: str = "flight"
    path: Path | None = None
    digest: str = ""  # SHA-256 of the file
    notes: tuple[str, ...] = ()
    # (N,): False where a sample is missing or incomplete
    valid: Mask = field(default_factory=lambda: np.ones(0, dtype=np.bool_))
    units: Mapping[str, str] = field(default_factory=dict)  # SI, of every column
    written: Mapping[str, str] = field(default_factory=dict)  # those of the file
    demodulation: Demodulation | None = None  # how inline and cross were made, by the mapping
    flags: tuple[Flag, ...] = ()  # what was found odd; each is among the notes, too
    instants: bool = False  # whether the file's stamps are instants (dates, GPS time), not seconds
    origin: datetime | None = None  # the instant at which time is 0, if it is known
    began: float | None = None  # time, s, of the first sample of the record that this is, or is a part of
    lacking: Mask | None = None  # (N,): where the file has no angular rates; None: nowhere

    def __post_init__(self) -> None:
        changes: dict[str, Any] = {
            "time": _freeze(self.time),
            "valid": _freeze(self.valid if self.valid.size else np.ones(len(self.time)), np.bool_),
            "began": self.began if self.began is not None or not len(self.time) else float(self.time[0]),
        }
        for group in ("channels", "outputs"):
            columns = {name: _freeze(v) for name, v in getattr(self, group).items()}
            changes[group] = MappingProxyType(columns)
        default = {n: "rad" for n in self.channels if is_disc_angle(n)} | dict.fromkeys(self.outputs, "V")
        names = ("time", *self.channels, *self.outputs)
        units = {n: self.units.get(n) or SI_UNITS.get(n, default.get(n, "1")) for n in names}
        for name, value in (changes | {"units": MappingProxyType(units)}).items():
            object.__setattr__(self, name, value)  # as frozen dataclasses normalise what they are given

    def __repr__(self) -> str:
        columns = " ".join((*self.channels, *self.outputs))
        return f"<Flight {self.name}: {self.duration:.6g} s at {self.rate:.6g} Hz; {columns}>"

    def __len__(self) -> int:
        return len(self.time)

    @property
    def rate(self) -> float:
        """Sampling rate, Hz."""
        return (len(self.time) - 1) / float(self.time[-1] - self.time[0])

    @property
    def duration(self) -> float:
        """Duration of the record, s: N / rate."""
        return len(self.time) / self.rate

    @property
    def present(self) -> Mask:
        """(N,): samples that the file has, whether they can be used or not."""
        recorded = [np.isfinite(v) for v in self.outputs.values()]
        return np.asarray(np.any(recorded, axis=0)) if recorded else self.valid

    def without(self, segments: Sequence[tuple[float, float]]) -> Flight:
        """The flight with segments of time (from, to, s since the first sample) marked as not to be used, with a note."""
        valid, notes = np.array(self.valid), list(self.notes)
        since = self.time - self.time[0]
        for first, last in segments:
            valid[(since >= first) & (since <= last)] = False
            notes.append(LEFT_OUT.format(first, last))
        return dataclasses.replace(self, valid=valid, notes=tuple(notes))

    def flagged(self, flags: Sequence[Flag]) -> Flight:
        """The flight with further flags, each of them a note as well."""
        notes = (*self.notes, *(f.reason for f in flags))
        return dataclasses.replace(self, flags=(*self.flags, *flags), notes=notes)

    def part(self, rows: slice | Mask) -> Flight:
        """A segment of the flight, as views, or some of its rows."""
        return dataclasses.replace(
            self,
            time=self.time[rows],
            channels={name: v[rows] for name, v in self.channels.items()},
            outputs={name: v[rows] for name, v in self.outputs.items()},
            valid=self.valid[rows],
            lacking=None if self.lacking is None else self.lacking[rows],
        )


def _freeze(values: ArrayLike, kind: type = np.float64) -> NDArray[Any]:
    view: NDArray[Any] = np.asarray(values, dtype=kind).view()
    view.flags.writeable = False
    return view


def digest_content(flight: Flight) -> str:
    """Digest of motion and output in single precision: the same for any format that holds their digits."""
    columns = {**{n: flight.channels[n] for n in (*SPECIFIC_FORCE, *ANGULAR_RATE)}, **flight.outputs}
    digest = hashlib.sha256()
    for name in sorted(columns):
        with np.errstate(over="ignore"):
            digest.update(name.encode() + np.asarray(columns[name], dtype="<f4").tobytes())
    return digest.hexdigest()


def require_distinct(flights: Sequence[Flight]) -> None:
    """UserError if two of the flights are the same record."""
    records: dict[str, Flight] = {}
    for x in flights if len(flights) > 1 else ():
        first = records.setdefault(digest_content(x), x)
        if first is not x:
            what = SAME_RECORD.format(first.path or first.name)
            raise UserError(what, where=x.path or x.name, remedy="give each record once")
