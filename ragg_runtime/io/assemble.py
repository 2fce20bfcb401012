"""From a table under the names of the contract to a flight: SI units, the uniform grid, what is missing, what can be derived."""

from __future__ import annotations

from collections.abc import Collection, Container, Mapping, Sequence
from dataclasses import replace

import numpy as np

from derive.names import EXPECTED
from ragg_runtime.base.errors import UserError, at, count, did_you_mean, is_column, one_line
from ragg_runtime.instrument.layout import PAPER
from ragg_runtime.instrument.layout import Layout as Accelerometers
from ragg_runtime.instrument.units import units
from ragg_runtime.io.mapping import NEEDED
from ragg_runtime.io.record import (
    ANGULAR_ACCELERATION,
    ANGULAR_RATE,
    AUXILIARY,
    DEMODULATED,
    GRADIENT,
    RATES,
    SI_UNITS,
    SPECIFIC_FORCE,
    WIDEST_SPIKE,
    Array,
    Flight,
    Mask,
    is_disc_angle,
)
from ragg_runtime.io.sampling import Grid, make_grid
from ragg_runtime.io.tables import DataTable
from ragg_runtime.io.text_tables import TWO_ROWS
from ragg_runtime.signals.derivative import NOTE, bridge_gaps, derive_accelerations, predict_missing, runs
from ragg_runtime.signals.fir import find_step

# longest stretch, s, over which an auxiliary channel is interpolated as if it had been recorded
BRIDGED = 2.0
ENDLESS = 1e100  # in SI: beyond it a value counts as missing, as infinity does
# share of a file's samples from which on, if something lacks in them, the rest is no evidence
MOST_UNUSED = 0.5
# share of the rows with motion, or with an output, that have both, up to which they are two records
JOINED = 0.1
_TRACE_NOTED = 1e-9  # s^-2: above it Gamma_xx + Gamma_yy + Gamma_zz = 0 (Laplace) is plainly violated


def make_flight(
    table: DataTable,
    g0: float,
    *,
    need_output: bool = True,
    accelerometers: Accelerometers = PAPER,
    leave: frozenset[str] = frozenset(),
) -> Flight:
    """The flight of a table, in SI on a uniform grid.

    Parameters
    ----------
    table
        Columns (n,) with their units.
    g0
        The g of these units, m/s^2.
    need_output
        False lets a record of motion alone pass.
    accelerometers
        The instrument's, whose outputs and voltages the columns are.
    leave
        Channels that are left aside.

    Raises
    ------
    UserError
        If a column is missing, has no unit or another one, if the record is not uniformly sampled, or half of the file's rows or more
        lack something: the rest must not make a model look adequate.
    """
    _require_names(table, NEEDED, "the motion needs")
    if any(n in table.names for n in ANGULAR_ACCELERATION):
        _require_names(table, ANGULAR_ACCELERATION, "angular acceleration, if given, needs")
    kept = tuple(c for c in table.columns if is_column(c.name) and c.name not in leave)
    table = replace(table, columns=kept, notes=(*table.notes, *_pass_over(table.names)))
    si, si_units = _convert(table, g0, accelerometers)
    left_out = _leave_out_rows(si, table)
    _require_rows_in_common(si, [c for c in (*accelerometers.columns, *DEMODULATED) if c in si], table.place)
    grid = make_grid(si.pop("time"), table.place)
    notes = [*table.notes, *left_out, *_leave_out_impossible(si, si_units), *grid.notes]
    placed = {c: _place(si.pop(c), grid) for c in [*si]}  # of a day at 100 Hz each is 70 MB
    _drop_empty(placed, notes, table.place)
    if need_output:
        _require_output(replace(table, notes=tuple(notes)), ("time", *placed), accelerometers)
    outputs = {c: placed.pop(c) for c in (*accelerometers.columns, *DEMODULATED) if c in placed}
    _interpolate_auxiliaries(placed, si_units, grid, notes)
    notes += [f"{c}: not used; models form this derivative themselves" for c in placed if c in RATES]
    valid = _find_valid(placed | outputs, outputs, grid, notes)
    _derive_outputs(outputs, notes, accelerometers)
    channels = {c: bridge_gaps(v, np.isfinite(v), turning=is_disc_angle(c)) for c, v in placed.items()}
    _check_gradient(channels, notes)
    flight = Flight(
        time=grid.time,
        channels=channels,
        outputs=outputs,
        notes=tuple(notes),
        valid=valid,
        units=si_units,
        written={c.name: c.unit for c in table.columns},
        demodulation=table.demodulation,
        instants=table.instants,
        origin=table.origin,
        lacking=_find_lacking_rates(placed),
    )
    if ANGULAR_ACCELERATION[0] not in channels:
        flight = replace(derive_acceleration(flight), notes=(*notes, NOTE))
    used = int(np.sum(flight.valid))
    if used <= (1 - MOST_UNUSED) * len(table):
        raise UserError(
            "most samples of the flight are incomplete",
            where=table.place,
            found=f"{len(table) - used} of {len(table)} samples cannot be used ({'; '.join(flight.notes)})",
            expected=f"fewer than {100 * MOST_UNUSED:.0f} % without a value",
            remedy="record all columns at one rate, or resample the file to the lowest rate needed",
        )
    return flight


def _find_lacking_rates(placed: Mapping[str, Array]) -> Mask:
    """(N,): samples without a rate; one of zero beside a specific force that lacks is none, either: the sensor was off."""
    forces, rates = (np.array([placed[n] for n in names]) for names in (SPECIFIC_FORCE, ANGULAR_RATE))
    off = np.any(np.isnan(forces), axis=0) & np.any(rates == 0.0, axis=0)
    return np.asarray(np.any(np.isnan(rates), axis=0) | off)


def derive_acceleration(x: Flight, lost: Mask | None = None) -> Flight:
    """The flight with its angular acceleration derived anew, unless it was recorded; some rates are ``lost`` (N,).

    Over few samples without a rate, spikes among them, it is derived from rates that are filled in.
    """
    if not x.written or ANGULAR_ACCELERATION[0] in x.written or ANGULAR_RATE[0] not in x.channels:
        return x
    nowhere = np.zeros(len(x), dtype=np.bool_)
    lacking = (nowhere if x.lacking is None else x.lacking) | (nowhere if lost is None else lost)
    gap = np.zeros_like(lacking)
    for run in runs(lacking):
        gap[run] = run.stop - run.start > WIDEST_SPIKE or run.start == 0 or run.stop == len(x)
    bridged = (predict_missing(x.channels[n], ~lacking) for n in ANGULAR_RATE)
    rates = [np.where(gap, np.nan, v) for v in bridged]
    slopes, sure = derive_accelerations(rates, x.time)
    omegadot = {n: bridge_gaps(v, np.isfinite(v)) for n, v in zip(ANGULAR_ACCELERATION, slopes, strict=True)}
    return replace(x, channels={**x.channels, **omegadot}, valid=x.valid & sure, lacking=lacking)


# --- columns and units ---------------------------------------------------------------------------------


def _pass_over(names: Sequence[str]) -> list[str]:
    """A note of columns whose names nothing can have."""
    odd = [repr(n[:80]) for n in names if not is_column(n)]
    shown = ", ".join(odd[:6]) + (" ..." if len(odd) > 6 else "")
    return [one_line(f"skipped because of their names ({EXPECTED}): {shown}")] if odd else []


def _convert(
    table: DataTable, g0: float, accelerometers: Accelerometers
) -> tuple[dict[str, Array], dict[str, str]]:
    """The columns in SI, NaN for what is beyond all bounds, and their units; UserError if one has no unit or another one."""
    fixed = {**SI_UNITS, **dict.fromkeys(accelerometers.columns, "V")}
    fixed |= {d.angle_column: "rad" for d in accelerometers.discs}
    registry = units(g0)
    columns, si_units = {}, {}
    for c in table.columns:
        where = at(table.place, f"column {c.name!r}")
        if not c.unit:
            raise UserError(
                "the column has no unit",
                where=where,
                found=repr(c.name),
                expected=f"{c.name} [unit], such as {c.name if c.name in SI_UNITS else 'temperature'} [{SI_UNITS.get(c.name, 'K')}]",
                remedy="write the unit; a pure number has the unit 1; none is guessed. Or describe the columns "
                "once for all files: ragg map FLIGHT -o mapping.toml",
            )
        si_units[c.name] = fixed[c.name] if c.name in fixed else registry.base_unit(c.unit, where)
        values = registry.to_si(c.values, c.unit, si_units[c.name], where)
        with np.errstate(invalid="ignore"):
            columns[c.name] = np.where(np.abs(values) < ENDLESS, values, np.nan)
    return columns, si_units


def _leave_out_rows(si: dict[str, Array], table: DataTable) -> list[str]:
    """Leave out, with notes, rows without which time increases; where it does not, the message about it says more.

    Rows of zeros, which recorders reserve ahead or write until they are ready; rows that are in the file once more, to the last digit,
    as one was appended to another with an overlap; rows whose stamp alone does not lie between those beside it.
    """
    notes = list[str]()

    def leave_out(wrong: Mask, what: str, first: str) -> None:
        rest = si["time"][~wrong]
        if wrong.any() and len(rest) > 1 and np.all(np.diff(rest) > 0):
            notes.append(f"{count(int(np.sum(wrong)), 'row')} {what} left out (the first {first})")
            si.update({n: x[~wrong] for n, x in si.items()})

    if np.all(np.diff(si["time"]) > 0):
        return notes
    empty = np.all([(c.values == 0.0) | np.isnan(c.values) for c in table.columns], axis=0)
    leave_out(empty, "of zeros", f"is row {np.argmax(empty) + 1}")
    import pandas as pd  # slow to import, and few records need it

    twice = pd.DataFrame(si).duplicated().to_numpy()
    leave_out(twice, "that the file has twice", f"at t = {si['time'][np.argmax(twice)]:.10g} s")
    time, apart = si["time"], np.zeros(len(si["time"]), dtype=np.bool_)
    before, here, after = time[:-2], time[1:-1], time[2:]
    apart[1:-1] = (before < after) & ((here < before) | (here > after))
    leave_out(apart, "whose time stamp is out of order", f"after t = {time[np.argmax(apart) - 1]:.10g} s")
    return notes


def _leave_out_impossible(si: dict[str, Array], si_units: Mapping[str, str]) -> list[str]:
    """Leave out temperatures that no sensor can have read, with a note.

    Where those above 0 K are farther from it than from each other, a column holds temperatures; else differences of them.
    """
    notes = []
    for name in [n for n, u in si_units.items() if u == "K" and n in si]:
        with np.errstate(invalid="ignore"):
            cold, warm = si[name] <= 0.0, si[name][si[name] > 0.0]
        if cold.any() and len(warm) and np.min(warm) > np.ptp(warm):
            si[name] = np.where(cold, np.nan, si[name])
            notes.append(f"{name}: {count(int(np.sum(cold)), 'sample')} not above absolute zero, left out")
    return notes


def _require_rows_in_common(si: Mapping[str, Array], outputs: Sequence[str], place: str) -> None:
    """UserError if motion and ``outputs`` are in different rows, be the others empty or filled with the value before."""

    def find_new(names: Sequence[str]) -> Mask:
        x = np.array([si[n] for n in names])
        # of an empty row's neighbours the difference is no number, and not zero
        return np.asarray(np.isfinite(x).all(axis=0) & (np.diff(x, prepend=np.nan) != 0.0).any(axis=0))

    moving = find_new((*SPECIFIC_FORCE, *ANGULAR_RATE))
    recorded = np.any([find_new([n]) for n in outputs] or [moving], axis=0)
    both, fewer = int(np.sum(moving & recorded)), int(min(np.sum(moving), np.sum(recorded)))
    if both < JOINED * fewer:
        raise UserError(
            "motion and output are in different rows: two records joined by their times?",
            where=place,
            found=f"new motion in {np.sum(moving)} of {len(moving)} rows, a new output in {np.sum(recorded)}, both in {both}",
            expected="motion and output at the same instants",
            remedy="join them without filling, interpolate the motion at the instants of the output by splines (pandas: set_index"
            " of the time, then interpolate('cubicspline') of the motion), and keep the rows with an output",
        )


def _require_names(table: DataTable, needed: Sequence[str], what: str) -> None:
    missing = [n for n in needed if n not in table.names]
    if not missing:
        return
    spare = [n for n in table.names if n not in SI_UNITS]
    near = did_you_mean(missing[0], spare) if len(missing) == 1 else None
    remedy = "describe the columns: ragg map FLIGHT -o mapping.toml"
    remedy = f"is {near[13:-1]} meant for {missing[0]}?" if near else remedy
    lack = (
        f"the column{'s' * (len(missing) > 1)} {', '.join(missing)} {'are' if missing[1:] else 'is'} missing"
    )
    raise _refuse(lack, table, table.names, f"{what} {', '.join(needed)}", remedy)


def _require_output(table: DataTable, names: Collection[str], a: Accelerometers) -> None:
    demodulated = len(a.outputs) == 1 and all(n in names for n in DEMODULATED)
    if demodulated or any(o.name in names or a.voltages(o, names) is not None for o in a.outputs):
        return
    volts = " ".join(a.voltage_columns(j)[0] for j in a.outputs[0].members)
    further = f"likewise {', '.join(a.output_names[1:])}" if len(a.outputs) > 1 else "or inline and cross"
    near = (did_you_mean(n, (*a.columns, *DEMODULATED)) for n in names if n not in SI_UNITS)
    expected = f"{a.output_names[0]}, or {volts}; {further}"
    raise _refuse(
        "the instrument's output is missing", table, names, expected, next(filter(None, near), None)
    )


def _refuse(
    what: str, table: DataTable, names: Collection[str], expected: str, remedy: str | None
) -> UserError:
    """That something is missing among the columns of these names; with the notes that may say why."""
    notes = [n for n in table.notes if n.startswith(("skipped,", TWO_ROWS)) or n.endswith("; it is left out")]
    columns = f"the columns {', '.join(filter(is_column, names))}"
    found = "; ".join([columns, *notes[:6], *_pass_over(table.names)])
    return UserError(what, where=table.place, found=found, expected=expected, remedy=remedy)


def _drop_empty(columns: dict[str, Array], notes: list[str], place: str) -> None:
    """Leave out columns without a single number, unless the motion would be incomplete."""
    for name in [n for n, v in columns.items() if np.isnan(v).all()]:
        if name in NEEDED:
            raise UserError(
                "the column holds no number: the motion needs it", where=at(place, f"column {name!r}")
            )
        del columns[name]
        notes.append(f"{name}: the column holds no number; it is left out")


# --- on the grid ---------------------------------------------------------------------------------------


def _place(values: Array, grid: Grid) -> Array:
    """A column at the samples of a grid, NaN where the file has none."""
    if len(values) == len(grid.time):
        return values
    column = np.full(len(grid.time), np.nan)
    column[grid.index] = values
    return column


def _find_valid(columns: dict[str, Array], outputs: Container[str], grid: Grid, notes: list[str]) -> Mask:
    """Samples with everything that is needed; counts the others in ``notes``."""
    present = np.zeros(len(grid.time), dtype=np.bool_)
    present[grid.index] = True
    valid = present.copy()
    for name, values in columns.items():
        missing = np.isnan(values)
        lost = missing & present
        few = np.zeros_like(lost)
        for run in runs(lost) if _is_auxiliary(name) and name not in outputs else ():
            inside = run.start > 0 and run.stop < len(lost)
            few[run] = inside and (run.stop - run.start + 1) * grid.step <= BRIDGED
        for mask, what in ((few, "interpolated"), (lost & ~few, "not used")):
            if mask.any():
                notes.append(f"{name}: without a value at {count(int(np.sum(mask)), 'sample')}, {what}")
        valid &= ~missing | few
    return valid


def _is_auxiliary(name: str) -> bool:
    return name not in SI_UNITS or name in AUXILIARY


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
        present = np.isfinite(sum_) & np.isfinite(outputs[o.name])
        y = outputs[o.name][present]
        difference, size = (float(np.median(np.abs(x))) if len(x) else 0.0 for x in (sum_[present] - y, y))
        if difference > 1e-3 * size:
            notes.append(
                f"{o.name} differs from {formula} by {100 * difference / max(size, difference / 10):.2g} %: "
                "check the order and the signs of the voltages"
            )


def _check_gradient(channels: dict[str, Array], notes: list[str]) -> None:
    components = [n for n in GRADIENT if n in channels]
    if components and len(components) < len(GRADIENT):
        notes.append("of the gravity gradient only " + ", ".join(components) + " are given")
    if {"Gamma_xx", "Gamma_yy", "Gamma_zz"} <= channels.keys():
        trace = float(np.max(np.abs(sum(channels[f"Gamma_{k}{k}"] for k in "xyz"))))
        if trace > _TRACE_NOTED:
            notes.append(
                f"Gamma_xx + Gamma_yy + Gamma_zz reaches {trace / 1e-9:.3g} Eo; outside matter it is 0"
            )


# --- channels of a lower rate --------------------------------------------------------------------------


# share of rows without a value from which a channel is one of a lower rate (rather than one with blanks)
SPARSE = 0.5
FEWEST_VALUES = 8  # values that are needed to judge a channel
BRIDGED_STEPS = 3.0  # longest gap, in steps of the channel, that is interpolated
FEWEST_LEVELS, MOST_LEVELS = 4, 256
"""Levels of a channel that is interpolated between its steps: fewer may be those of a switch, of more the steps are a thousandth of
the range."""

SLOW = 0.3
"""Largest error, over the channel's standard deviation, of a value that is interpolated between its neighbours. Of a
sinusoid that is one of eight values in a period; between the values, where half the step is bridged, the error is a
fourth of it at most, rms a twentieth."""


def _interpolate_slow(time: Array, values: Array, at: Array) -> Array | str:
    """A channel of a lower rate, from its values (n,) and their instants, s, at other ones, (N,): NaN before the first value, after
    the last and in gaps of more than ``BRIDGED_STEPS`` steps. Or why it cannot be interpolated linearly, in words.
    """
    if len(values) < FEWEST_VALUES:
        return f"it has {count(len(values), 'value')}"
    steps, whole = np.diff(time), float(at[-1] - at[0])
    step = float(np.median(steps))
    near = steps <= BRIDGED_STEPS * step
    a, b, both = steps[:-1], steps[1:], near[:-1] & near[1:]
    between = (values[:-2] * b + values[2:] * a) / (a + b)
    error = float(np.sqrt(np.mean((values[1:-1] - between)[both] ** 2))) if both.any() else np.inf
    if error > SLOW * float(np.std(values)):
        return f"it changes too fast for one value in {step:.3g} s"
    covered = float(np.sum(steps[near]))
    if covered < (1 - MOST_UNUSED) * whole:
        return f"its values cover {covered:.4g} s of {whole:.4g} s"
    after = np.clip(np.searchsorted(time, at), 1, len(time) - 1)
    lost = ~near[after - 1] & (at > time[after - 1]) & (at < time[after])
    lost |= (at < time[0]) | (at > time[-1])
    return np.where(lost, np.nan, np.interp(at, time, values))


def _interpolate_coarse(x: Array) -> tuple[Array, float | None]:
    """A channel (N,) that mostly stands still and else moves by one step of its resolution, interpolated, and that step.

    Where it moves the sensor was half way between the two: of temperatures in steps of 0.06 and 0.1 K that leaves 0.03 to 0.14 of a
    step, rms, instead of 0.29. Any other as it is.
    """
    present = np.flatnonzero(np.isfinite(x))
    v = x[present]
    at = np.flatnonzero(np.diff(v))
    if not FEWEST_LEVELS <= len(at) + 1 <= 1 + len(v) / 2 or len(np.unique(v)) < FEWEST_LEVELS:
        return x, None
    step = find_step(v)
    if step is None or np.ptp(v) > MOST_LEVELS * step or np.median(np.abs(np.diff(v)[at])) > 1.5 * step:
        return x, None
    smooth, knots = np.array(x), np.r_[0, at + 0.5, len(v) - 1]
    smooth[present] = np.interp(np.arange(len(v)), knots, np.r_[v[0], (v[at] + v[at + 1]) / 2, v[-1]])
    return smooth, step


def _interpolate_auxiliaries(
    placed: dict[str, Array], si_units: Mapping[str, str], grid: Grid, notes: list[str]
) -> None:
    """Interpolate, in place, auxiliary channels of coarse resolution or of a lower rate; leave out those that cannot be."""
    for name in filter(_is_auxiliary, list(placed)):
        if not is_disc_angle(name):
            placed[name], step = _interpolate_coarse(placed[name])
            if step is not None:
                notes.append(
                    f"{name}: recorded in steps of {step:.3g} {si_units[name]}; interpolated between them"
                )
        present = np.isfinite(placed[name])
        size = int(np.sum(present))
        if not 0 < size < (1 - SPARSE) * len(grid.index):
            continue
        time, values = grid.time[present], placed[name][present]
        values = np.unwrap(values) if si_units[name] == "rad" else values
        x, lacking = _interpolate_slow(time, values, grid.time), count(len(grid.index) - size, "sample")
        if isinstance(x, str):
            notes.append(f"{name}: without a value at {lacking}; left out: {x}")
            del placed[name]
        else:
            placed[name] = x
            spacing = float(np.median(np.diff(time)))
            notes.append(f"{name}: recorded every {spacing:.4g} s; interpolated (at {lacking})")
