"""The numerical model, Eq. 49-52: from the true motion to the voltages; effects hook in stage by stage."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.reference.effects import Injected, force, geometry, transducer
from ragg_runtime.reference.geometry import (
    Mount,
    Rotations,
    Taylor,
    carry,
    carry_rigidly,
    disc_attitude,
    frame_rotation,
    mount,
    spin,
)
from ragg_runtime.reference.gravity import Gravity
from ragg_runtime.reference.motion import MotionSignals, MotionState, Turning

Array = NDArray[np.float64]
Triple = tuple[Array, Array, Array]
Triad = tuple[Taylor, Taylor, Taylor]
Auxiliary = Callable[[Array], Array]
Index = NDArray[np.intp]
Sense = Callable[[Index, float], Array]  # accelerometers (m,), how much earlier, s -> their voltages (m, N)

_ARM_ITERATIONS = 3  # the arm's stretch changes the force that stretches it by a part in a million
_STEP = 0.01  # between the instants at which an arm's length is looked at to learn how fast it changes, s
_WARMING = 1e-4  # half the segment over which the rate of a temperature is taken, s

_FIRST = (1 / 12, -2 / 3, 0.0, 2 / 3, -1 / 12)
# derivatives by central differences over five instants, good to the fourth power of the step
_SECOND = (-1 / 12, 4 / 3, -5 / 2, 4 / 3, -1 / 12)


@dataclass(frozen=True)
class Instant:
    """The truth at N instants: time (N,) s, angle (N,) rad of each disc and its rates, motion, auxiliary channels."""

    time: Array
    phi: tuple[Taylor, ...]
    motion: MotionState
    auxiliaries: Mapping[str, Array]
    around: tuple[Instant, ...] = ()
    """Two instants earlier, two later, where arms bend and it matters how fast."""


@dataclass(frozen=True)
class Chain:
    """An instrument in a world: everything that determines its noise-free voltages.

    ``rotations``: how mounting angles turn, ``first-order`` (the paper), ``second-order`` or ``exact``;
    ``misalignment``: ``first-order`` (Eq. 2) or ``exact``. ``spin``: share of the disc's own turning in the kinematics,
    0 is Eq. 49, 1 nature.
    """

    instrument: Instrument
    motion: MotionSignals
    gravity: Gravity | None
    rotations: Rotations
    effects: Injected
    auxiliaries: Mapping[str, Auxiliary]
    turning: tuple[Turning, ...]
    spin: float = 0.0
    misalignment: Literal["first-order", "exact"] = "first-order"

    @property
    def size(self) -> int:
        """Number of accelerometers."""
        return self.instrument.layout.size

    @cached_property
    def attitudes(self) -> tuple[Array | None, ...]:
        """How each disc is oriented in the measurement frame."""
        return tuple(disc_attitude(d) for d in self.instrument.layout.discs)

    def voltages(self, time: Array, angle_error: Array) -> Array:
        """V_1 ... V_n without noise, (n, N) V, at (N,) s; ``angle_error`` (N,) rad: random part of phi."""
        shaken = force.vibration(self.effects, "vibration-rectification", "P")

        def sense(members: Index, earlier: float) -> Array:
            instant = self._instant(time, earlier, angle_error)
            return np.stack([self._average(j, instant, shaken) for j in members.tolist()])

        b = float(self.effects["output-filter"]["b"]) if "output-filter" in self.effects else 0.0
        lagging = _smear(sense, transducer.lags(self.effects, self.size), transducer.lag_quadrature)
        looped = _smear(lagging, transducer.widths(self.effects, self.size), transducer.loop_quadrature)
        return _smear(looped, np.full(self.size, b), transducer.averaging)(np.arange(self.size), 0.0)

    def forces(self, time: Array) -> Array:
        """f_x, f_y, f_z of the accelerometers, (n, 3, N) m/s^2, at (N,) s."""
        state, shake = self._instant(time, 0.0, np.zeros(time.size)), np.zeros((3, 1))
        return np.array([self._nominal_force(j, *self._mount(j), state, shake)[0] for j in range(self.size)])

    def scale(self, time: Array) -> Array:
        """k_VI K1 of the accelerometers as they are at the time, (n, N) V/(m/s^2)."""
        auxiliaries, k = self._auxiliaries_at(time), self.instrument.accelerometers
        gains = [transducer.gain(j, time, auxiliaries, self.effects) for j in range(self.size)]
        return np.stack([k["k_VI"][j] * k["K1"][j] * g * np.ones(time.size) for j, g in enumerate(gains)])

    def _mount(self, j: int) -> tuple[Mount, float]:
        """Accelerometer j where it really is, and its radius, m, before forces stretch the arm."""
        place, k = self.instrument.layout.places[j], self.instrument.accelerometers
        longer = float(self.effects["arm-length"]["delta_R"]) if "arm-length" in self.effects else 0.0
        radius = place.radius + float(k["dR"][j]) + longer
        return mount(place, float(k["beta_x"][j]), float(k["beta_z"][j]), self.rotations), radius

    def _instant(self, time: Array, delay: float, angle_error: Array, alone: bool = False) -> Instant:
        bending = not alone and any(geometry.bends(j, self.effects) for j in range(self.size))
        around = tuple(
            self._instant(time, delay - n * _STEP, angle_error, alone=True)
            for n in ((-2, -1, 1, 2) if bending else ())
        )
        past = time - delay
        return Instant(
            time=past,
            phi=self._angles(time, delay, angle_error),
            motion=self.motion.at(time, delay),
            auxiliaries=self._auxiliaries_at(past),
            around=around,
        )

    def _angles(self, time: Array, delay: float, error: Array) -> tuple[Taylor, ...]:
        """The true angle of each disc, (N,) rad each."""
        past = time - delay
        angles = [geometry.disc_angle(t.at(time, delay), past, error, self.effects) for t in self.turning]
        if "spin-servo" in self.effects:  # the disc falls behind where the platform is turned about its axis
            near = [self.motion.at(time, delay - n * _STEP).omegadot for n in range(-2, 3)]
            for k, d in enumerate(self.instrument.layout.discs):
                about = np.stack([np.asarray(d.axis) @ m for m in near])
                turning = Taylor(about[2], _FIRST @ about / _STEP, _SECOND @ about / _STEP**2)
                angles[k] += turning * -float(self.effects["spin-servo"]["c"])
        return tuple(angles)

    def _auxiliaries_at(self, time: Array) -> dict[str, Array]:
        values = {name: channel(time) for name, channel in self.auxiliaries.items()}
        if "thermal-lag" in self.effects:
            temperature = self.auxiliaries["temperature"]
            change = temperature(time + _WARMING) - temperature(time - _WARMING)
            values["d_temperature"] = change / (2 * _WARMING)
        return values

    def _average(self, j: int, instant: Instant, shaken: tuple[tuple[Array, float], ...]) -> Array:
        """Voltage of accelerometer j, averaged over the instances of the unrecorded vibration."""
        shakes = [
            (v + u * instant.auxiliaries["vibration_rms"] if np.any(u) else v, weight * w)
            for v, weight in shaken
            for u, w in force.vibration(self.effects, "vibration-level", "L")
        ]
        voltages = (weight * self._voltage(j, instant, v) for v, weight in shakes)
        return np.asarray(sum(voltages), dtype=np.float64)

    def _voltage(self, j: int, instant: Instant, shake: Array) -> Array:
        """Eq. 49-52 for accelerometer j, counted from 0, (N,) V."""
        k = {name: float(values[j]) for name, values in self.instrument.accelerometers.items()}
        actual, radius = self._mount(j)
        nominal, triad = self._nominal_force(j, actual, radius, instant, shake)
        angles = (k["vartheta_x"], k["vartheta_y"], k["vartheta_z"])
        time, auxiliaries = instant.time, instant.auxiliaries
        turned = geometry.misalignment(j, angles, nominal, time, auxiliaries, self.effects)
        C = frame_rotation(*turned, self.misalignment)
        i, o, p = measured = _rows(C, nominal)
        # 1: the second-order terms see the force along the measured axes (Eq. 52); 0 in the analytical model
        kappa = float(self.effects.get("second-order-misalignment", {"kappa": 1.0})["kappa"])
        if kappa != 1:
            level = mount(self.instrument.layout.places[j], 0.0, 0.0, self.rotations)
            unturned, _ = self._nominal_force(j, level, radius, instant, shake)
            i, o, p = (n + kappa * (m - n) for n, m in zip(unturned, measured, strict=True))
        bracket = (
            measured[0]
            + transducer.bias(j, k["K0"], time, auxiliaries, self.effects)
            + sum(transducer.follow("K2", j, time, auxiliaries, self.effects), k["K2"]) * i**2
            + k["K5"] * o**2
            + k["K7"] * p**2
            + k["K4"] * i * p
            + k["K6"] * i * o
            + k["K8"] * o * p
            + transducer.further_terms(j, measured, triad, instant.motion, auxiliaries, self.effects)
        )
        bracket = bracket * transducer.torque_gain(j, triad, auxiliaries, self.effects)
        bracket = transducer.convert(j, bracket, self.effects)
        gain = transducer.gain(j, time, auxiliaries, self.effects)
        return np.asarray(k["k_VI"] * k["K1"] * gain * bracket, dtype=np.float64)

    def _nominal_force(
        self, j: int, fixed: Mount, radius: float, instant: Instant, shake: Array
    ) -> tuple[Triple, Triad]:
        """f_x, f_y, f_z of accelerometer j, (N,) m/s^2, and the triad they are along."""
        arm, triad, lift = self._in_measurement_frame(j, fixed, instant)
        if not geometry.bends(j, self.effects):
            return self._specific_force(j, _lift(arm * radius, lift), triad, instant, shake), triad
        length, f = self._settle(j, fixed, radius, instant, shake)
        around = [self._settle(j, fixed, radius, near, shake)[0] for near in instant.around]
        beside = np.stack([*around[:2], length, *around[2:]])
        changing = Taylor(length, _FIRST @ beside / _STEP, _SECOND @ beside / _STEP**2)
        m = instant.motion
        moved, rigid = (carry(arm * x, m.omega, m.omegadot) for x in (changing, length))
        further = moved - rigid
        x, y, z = (part + np.sum(further * tau.value, axis=0) for part, tau in zip(f, triad, strict=True))
        return (x, y, z), triad

    def _settle(
        self, j: int, fixed: Mount, radius: float, instant: Instant, shake: Array
    ) -> tuple[Array, Triple]:
        """Radius under the force that acts at this radius, (N,) m, and that force."""
        arm, triad, lift = self._in_measurement_frame(j, fixed, instant)
        f = self._specific_force(j, _lift(arm * radius, lift), triad, instant, shake)
        length = np.full(instant.time.shape, radius)
        for _ in range(_ARM_ITERATIONS):
            length = geometry.arm_length(j, radius, f, self.effects)
            f = self._specific_force(j, _lift(arm * length, lift), triad, instant, shake)
        return length, f

    def _in_measurement_frame(
        self, j: int, fixed: Mount, instant: Instant
    ) -> tuple[Taylor, Triad, Taylor | None]:
        """Arm, triad, and lift out of the disc's plane, (3, N) each, as the disc turns; no lift: ``None``."""
        disc = self.instrument.layout.places[j].disc
        lifts = bool(np.any(fixed.lift))
        vectors = np.stack([fixed.arm, *fixed.triad, *([fixed.lift] if lifts else [])])
        if (lean := geometry.lean(self.effects, "spin-axis-wobble", "w")) is not None:
            vectors = vectors @ lean.T
        turned = spin(vectors, instant.phi[disc])
        if (axis := geometry.lean(self.effects, "spin-axis-tilt", "alpha")) is not None:
            turned = [v.turn(axis) for v in turned]
        if (axes := self.attitudes[disc]) is not None:
            turned = [v.turn(axes) for v in turned]
        arm, tau_x, tau_y, tau_z, *lift = turned
        return arm, (tau_x, tau_y, tau_z), lift[0] if lift else None

    def _centre(self, j: int, instant: Instant) -> Taylor | None:
        """Where the centre of accelerometer j's disc wanders to, (3, N) m."""
        disc = self.instrument.layout.places[j].disc
        away = geometry.run_out(instant.phi[disc], self.effects)
        axes = self.attitudes[disc]
        return away if away is None or axes is None else away.turn(axes)

    def _specific_force(self, j: int, r: Taylor, triad: Triad, instant: Instant, shake: Array) -> Triple:
        """Eq. 49 at position r (3, N), or the specific force of a point moving like r, and Eq. 50: along the triad."""
        centre = self._centre(j, instant)
        r = _lift(r, centre)
        m, position = instant.motion, r.value
        of_platform = carry_rigidly(position, m.omega, m.omegadot)
        f = m.a + shake + of_platform
        if self.spin:
            f = f + self.spin * (carry(r, m.omega, m.omegadot) - of_platform)
        if centre is not None and self.spin != 1:  # the path of the centre counts in any kinematics
            rigid = carry_rigidly(centre.value, m.omega, m.omegadot)
            f = f + (1 - self.spin) * (carry(centre, m.omega, m.omegadot) - rigid)
        if self.gravity is not None:
            f = f - self.gravity.difference(instant.time, position)
        f = f - force.attraction(position, instant.auxiliaries, self.effects)
        f = f + force.jittered(position, instant.auxiliaries, self.effects)
        x, y, z = (np.sum(f * tau.value, axis=0) for tau in triad)
        return x, y, z


def _smear(
    sense: Sense, lengths: Array, quadrature: Callable[[float], Sequence[tuple[float, float]]]
) -> Sense:
    """Voltages averaged over the delays, and with the weights, that a quadrature has for the length of each accelerometer, (n,)."""

    def smeared(members: Index, earlier: float) -> Array:
        present = sense(members, earlier)
        change = np.zeros_like(present)
        for length in np.unique(lengths[lengths != 0]):
            rows = np.flatnonzero(lengths[members] == length)
            # Adding the difference to the present, rather than the past itself, keeps a tiny lag accurate.
            for delay, weight in quadrature(float(length)) if len(rows) else ():
                change[rows] += weight * (sense(members[rows], earlier + delay) - present[rows])
        return np.asarray(present + change)

    return smeared


def _lift(r: Taylor, lift: Taylor | None) -> Taylor:
    return r if lift is None else r + lift


def _rows(C: Array, f: Triple) -> Triple:
    i, o, p = (row[0] * f[0] + row[1] * f[1] + row[2] * f[2] for row in C)
    return i, o, p
