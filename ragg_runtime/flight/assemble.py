"""From a file's columns to a flight: SI units, what is missing, what can be derived."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError, at, did_you_mean
from ragg_runtime.flight import slow
from ragg_runtime.flight.angular_acceleration import Derivative, planned
from ragg_runtime.flight.even_grid import differentiated, evenly
from ragg_runtime.flight.record import (
    ANGULAR_ACCELERATION,
    ANGULAR_RATE,
    AUXILIARY,
    DEMODULATED,
    GRADIENT,
    RATES,
    SI_UNITS,
    SPECIFIC_FORCE,
    Array,
    Flight,
    Mask,
    is_disc_angle,
)
from ragg_runtime.flight.sampling import Grid, uniform
from ragg_runtime.flight.source import Batch, Column
from ragg_runtime.instrument.layout import PAPER
from ragg_runtime.instrument.layout import Layout as Accelerometers
from ragg_runtime.instrument.units import Units, units
from ragg_runtime.signals.derivative import runs

BRIDGED = 2.0
"""Longest stretch, s, over which an auxiliary channel is interpolated as if it had been recorded: such
channels are often sampled more slowly than the motion, with blanks between."""

ENDLESS = 1e100  # in SI: beyond it a value counts as missing, as infinity does
_TRACE_NOTED = 1e-9  # s^-2: above it Gamma_xx + Gamma_yy + Gamma_zz = 0 (Laplace) is plainly violated
_NEEDED = ("time", *SPECIFIC_FORCE, *ANGULAR_RATE)


MOST_UNUSED = 0.5
"""Share of a file's samples from which on, if something lacks in them, the rest is no evidence."""


@dataclass(frozen=True)
class Whole:
    """What only the whole file tells, and every part of it is read by.

    Attributes
    ----------
    rows
        Rows of the file.
    derivative
        How angular rates are differentiated, if the acceleration is not recorded.
    slow
        Auxiliary channels of a lower rate, SI, interpolated.
    left_out
        Auxiliary channels of a lower rate that cannot be.
    notes
        Both in sentences.
    """

    rows: int
    derivative: Derivative
    slow: Mapping[str, slow.Slow] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Layout:
    """The columns of one file with their SI units, checked once; :meth:`flight` turns rows into a flight."""

    path: Path
    columns: tuple[Column, ...]
    si_units: dict[str, str]
    known: Units
    need_output: bool
    accelerometers: Accelerometers = PAPER

    def flight(
        self,
        rows: Batch,
        whole: Whole,
        *,
        name: str,
        digest: str,
        first_row: int = 1,
        step: float | None = None,
    ) -> Flight:
        """The flight of these rows (file's units); ``step`` is given for a part of a longer record."""
        si = {c.name: self.converted(c, rows[c.name]) for c in self.columns if c.name not in whole.left_out}
        grid = uniform(si.pop("time"), self.path, first_row, step)
        notes = [*grid.notes, *whole.notes]
        if step is None:
            _drop_empty(si, notes, self.path)
            if self.need_output:
                _check_output(self.path, list(si), self.accelerometers)
        placed = {
            c: whole.slow[c].at(grid.time) if c in whole.slow else _placed(v, grid) for c, v in si.items()
        }
        notes += [f"{c}: not used; models form this derivative themselves" for c in placed if c in RATES]
        named = (*self.accelerometers.columns, *DEMODULATED)
        outputs = {c: placed.pop(c) for c in named if c in placed}
        valid = _valid(placed | outputs, outputs, grid, notes)
        _derive_outputs(outputs, notes, self.accelerometers)
        channels = {c: _filled(v, c) for c, v in placed.items()}
        _derive_acceleration(channels, placed, grid, valid, notes, whole.derivative)
        _check_gradient(channels, notes)
        if step is None and not valid.any():
            raise UserError("no sample of the flight is complete", where=self.path, found="; ".join(notes))
        return Flight(
            time=grid.time,
            channels=channels,
            outputs=outputs,
            name=name,
            path=self.path,
            digest=digest,
            notes=tuple(notes),
            valid=valid,
            units=self.si_units,
            written={c.name: c.unit for c in self.columns},
        )

    def derivative(self, head: Batch) -> Derivative:
        """How to differentiate the rates, by the first rows of the file (its units)."""
        names = [c.name for c in self.columns]
        if ANGULAR_ACCELERATION[0] in names or len(head["time"]) < 2:
            return Derivative()
        si = {c.name: self.converted(c, head[c.name]) for c in self.columns if c.name in head}
        try:
            grid = uniform(si["time"], self.path)
        except UserError:
            return Derivative()  # told where the rows are read
        return planned([evenly(_placed(si[n], grid), grid) for n in ANGULAR_RATE], 1 / grid.step)

    def step(self, rows: Batch) -> float:
        """Sampling interval of these rows, s."""
        time = next(c for c in self.columns if c.name == "time")
        return uniform(self.converted(time, rows["time"]), self.path).step

    def converted(self, column: Column, values: Array) -> Array:
        """Values of a column in SI; NaN for what is beyond all bounds."""
        where = at(self.path, f"column {column.name!r}")
        result = self.known.to_si(values, column.unit, self.si_units[column.name], where)
        if (
            len(result) and max(result.max(), -result.min()) < ENDLESS
        ):  # the rule; of what is no number not true
            return result
        with np.errstate(invalid="ignore"):
            return np.where(np.abs(result) < ENDLESS, result, np.nan)


def layout(
    path: Path,
    columns: Sequence[Column],
    g0: float,
    *,
    need_output: bool = True,
    accelerometers: Accelerometers = PAPER,
) -> Layout:
    """Check names and units of a file's columns; UserError if one is missing or does not convert.

    ``g0`` is the model's g, m/s^2. ``need_output`` False lets a file of motion alone pass. ``accelerometers`` says
    which columns are outputs.
    """
    known = units(g0)
    names = [c.name for c in columns]
    _need(path, names, _NEEDED, "the motion needs")
    if any(n in names for n in ANGULAR_ACCELERATION):
        _need(path, names, ANGULAR_ACCELERATION, "angular acceleration, if given, needs")
    if need_output:
        _check_output(path, names, accelerometers)
    fixed = {**SI_UNITS, **dict.fromkeys(accelerometers.columns, "V")}
    fixed |= {d.angle_column: "rad" for d in accelerometers.discs}
    si_units = {}
    for c in columns:
        where = at(path, f"column {c.name!r}")
        si_units[c.name] = fixed[c.name] if c.name in fixed else known.base_unit(c.unit, where)
        known.to_si(1.0, c.unit, si_units[c.name], where)  # a wrong dimension is told before the file is read
    return Layout(
        path=path,
        columns=tuple(columns),
        si_units=si_units,
        known=known,
        need_output=need_output,
        accelerometers=accelerometers,
    )


def enough(flight: Flight, rows: int) -> Flight:
    """The flight, unless half of the file's rows or more lack something: what is left must not acquit a model."""
    used = int(np.sum(flight.valid))
    if used > (1 - MOST_UNUSED) * rows:
        return flight
    raise UserError(
        "most samples of the flight are incomplete: the rest would be no evidence",
        where=flight.path,
        found=f"{rows - used} of {rows} samples cannot be used ({'; '.join(flight.notes)})",
        expected=f"fewer than {100 * MOST_UNUSED:.0f} % without a value",
        remedy="record all columns at one rate, or resample the file to the slowest that it needs",
    )


def _check_output(path: Path, names: Sequence[str], a: Accelerometers) -> None:
    if any(o.name in names or a.voltages(o, names) is not None for o in a.outputs):
        return
    if len(a.outputs) == 1 and all(n in names for n in DEMODULATED):
        return
    volts = " ".join(a.voltage_columns(j)[0] for j in a.outputs[0].members)
    one = f"{a.output_names[0]}, or {volts}"
    further = f"; likewise {', '.join(a.output_names[1:])}" if len(a.outputs) > 1 else ", or inline and cross"
    raise UserError(
        "the instrument's output is missing",
        where=path,
        found="the columns " + ", ".join(names),
        expected=one + further,
        remedy=next(
            filter(None, (did_you_mean(n, (*a.columns, *DEMODULATED)) for n in names if n not in SI_UNITS)),
            None,
        ),
    )


def _need(path: Path, names: list[str], needed: Sequence[str], what: str) -> None:
    missing = [n for n in needed if n not in names]
    if missing:
        spare = [n for n in names if n not in SI_UNITS]
        near = did_you_mean(missing[0], spare)
        raise UserError(
            ("the columns " if len(missing) > 1 else "the column ")
            + ", ".join(missing)
            + (" are missing" if len(missing) > 1 else " is missing"),
            where=path,
            found="the columns " + ", ".join(names),
            expected=f"{what} " + ", ".join(needed),
            remedy=None if near is None else f"is {near[13:-1]} meant for {missing[0]}?",
        )


def _drop_empty(si: dict[str, Array], notes: list[str], path: Path) -> None:
    """Leave out columns without a single number, unless the motion would be incomplete."""
    for name in [n for n, v in si.items() if np.isnan(v).all()]:
        if name in _NEEDED:
            raise UserError(
                "the column holds no number",
                where=at(path, f"column {name!r}"),
                found="empty cells alone",
                expected="numbers: the motion needs it",
                remedy="check the recorder or the export",
            )
        del si[name]
        notes.append(f"{name}: the column holds no number; it is left out")


def _placed(values: Array, grid: Grid) -> Array:
    """Values on the whole grid, NaN where the file has no sample."""
    if len(values) == len(grid.time):
        return values
    whole = np.full(len(grid.time), np.nan)
    whole[grid.index] = values
    return whole


def _valid(columns: dict[str, Array], outputs: Container[str], grid: Grid, notes: list[str]) -> Mask:
    """Samples at which everything stands that has to; counts the others in ``notes``."""
    present = np.zeros(len(grid.time), dtype=np.bool_)
    present[grid.index] = True
    valid = present.copy()
    for name, values in columns.items():
        if not np.isnan(np.sum(values)):  # cheap, and true wherever something is missing
            continue
        missing = np.isnan(values)
        if not np.any(missing & present):
            continue
        count = int(np.sum(missing & present))
        bridged = np.zeros_like(missing)
        if (name not in SI_UNITS or name in AUXILIARY) and name not in outputs:
            for run in runs(missing & present):
                inside = run.start > 0 and run.stop < len(missing)
                bridged[run] = inside and (run.stop - run.start + 1) * grid.step <= BRIDGED
        kept = int(np.sum(bridged & present))
        if kept:
            notes.append(f"{name}: without a value at {samples_of(kept)}, interpolated")
        if count > kept:
            notes.append(f"{name}: without a value at {samples_of(count - kept)}, not used")
        valid &= ~missing | bridged
    return valid


def samples_of(count: int) -> str:
    return "1 sample" if count == 1 else f"{count} samples"


def _filled(values: Array, name: str) -> Array:
    if not np.isnan(np.sum(values)):
        return values
    missing = np.isnan(values)
    if not missing.any():
        return values
    result = values.copy()
    places = np.flatnonzero(~missing)
    if not len(places):  # only in a part of a longer record
        return np.zeros_like(values)
    there = values[places]
    if is_disc_angle(name):
        there = np.unwrap(there)
    result[missing] = np.interp(np.flatnonzero(missing), places, there)
    return result


def _derive_outputs(outputs: dict[str, Array], notes: list[str], a: Accelerometers) -> None:
    """Outputs that are not recorded from their voltages; where both are, they must agree."""
    for o in a.outputs:
        columns = a.voltages(o, outputs)
        if columns is None:
            continue
        sum_, formula = o.combined(np.stack([outputs[c] for c in columns])), a.formula(o, columns)
        if o.name not in outputs:
            outputs[o.name] = sum_
            notes.append(f"{o.name} is derived: {formula}")
            continue
        there = np.isfinite(sum_) & np.isfinite(outputs[o.name])
        difference = np.sqrt(np.mean((sum_ - outputs[o.name])[there] ** 2)) if there.any() else 0.0
        size = np.sqrt(np.mean(outputs[o.name][there] ** 2)) if there.any() else 0.0
        if difference > 1e-3 * size:
            notes.append(
                f"{o.name} differs from {formula} by {difference:.3g} V rms, with {size:.3g} V rms "
                "of its own: check the order and the signs of the voltages"
            )


def _derive_acceleration(
    channels: dict[str, Array],
    placed: dict[str, Array],
    grid: Grid,
    valid: Mask,
    notes: list[str],
    derivative: Derivative,
) -> None:
    missing = [n for n in ANGULAR_ACCELERATION if n not in channels]
    if not missing:
        return
    for name, rate_name in zip(ANGULAR_ACCELERATION, ANGULAR_RATE, strict=True):
        derived, sure = differentiated(placed[rate_name], grid, derivative)
        # A sample that stands alone between two gaps has no derivative.
        valid &= sure
        channels[name] = _filled(derived, name)
    notes.append(derivative.note)


def _check_gradient(channels: dict[str, Array], notes: list[str]) -> None:
    given = [n for n in GRADIENT if n in channels]
    if given and len(given) < len(GRADIENT):
        notes.append("of the gravity gradient only " + ", ".join(given) + " are given")
    if all(n in given for n in ("Gamma_xx", "Gamma_yy", "Gamma_zz")):
        trace = float(np.max(np.abs(sum(channels[n] for n in ("Gamma_xx", "Gamma_yy", "Gamma_zz")))))
        if trace > _TRACE_NOTED:
            notes.append(
                f"Gamma_xx + Gamma_yy + Gamma_zz reaches {trace / 1e-9:.3g} Eo; outside matter it is 0"
            )
