"""Delays and filters: of an accelerometer's loop, of the output, of the motion record."""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values, shared
from derive.stages import Motion, SensedForce


def lag(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    # 1/(1 + tau s) = 1 - tau s + tau^2 s^2 - ...
    first = c.rate(f.i)
    return i - p.tau * first + p.tau**2 * c.rate(first)


LAG = Effect(
    id="lag",
    title="Lag of the accelerometer loop",
    physics=(
        "The closed rebalance loop follows the specific force with a first-order lag. Since the disc turns a steady horizontal force "
        "into one at the spin frequency, even nanoseconds show."
    ),
    source="closed-loop transfer function of a force-rebalance accelerometer, 1/(1 + tau s)",
    equation=r"V_j \leftarrow V_j/(1 + \tau_j s)",
    limits=(
        "Expanded to second order in tau: tau must be far below the time scale of the force (0.1 s). Cross-talk, a share of another "
        "voltage some time late, is in G_out a gain and a lag of the accelerometer that it comes from: the two are degenerate there, and "
        "tau may then be negative."
    ),
    parameters=(EffectParameter("tau", r"\tau", "s", "time constant of the loop", 1e-8),),
    transducer=lag,
)


def curve_response(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + p.b * c.rate(c.rate(i))


SECOND_ORDER_LOOP = Effect(
    id="second-order-loop",
    title="Second-order response of the loop",
    physics=(
        "The closed rebalance loop has a mass and a spring: beyond the delay that a lag describes it amplifies or attenuates fast "
        "forces, differently in each accelerometer."
    ),
    source=(
        "closed-loop transfer function 1/(1 + 2 zeta s/w + s^2/w^2), whose delay is the lag tau = 2 zeta/w; b = (2 zeta^2 - 1)/w^2, 3e-7 "
        "s^2 for 300 Hz"
    ),
    equation=r"V_j \leftarrow V_j + b_j\,\ddot V_j",
    limits=(
        "First order in b, for forces slow against the loop. The delay itself is lag; a b common to all accelerometers is output-filter, "
        "one of the motion only imu-filter. A mount that resonates at w has b = -1/w^2; near the force's frequencies it is "
        "accelerometer-resonance. The simulator has loops without a resonance (b not negative)."
    ),
    parameters=(
        EffectParameter("b", "b", "s^2", "curvature of the loop's response at low frequencies", 1e-8),
    ),
    transducer=curve_response,
)


OUTPUT_FILTER = Effect(
    id="output-filter",
    title="Filter of the output",
    physics=(
        "Before it is recorded, G_out is averaged or low-passed. If the filter's delay has been corrected, its droop remains: it "
        "attenuates the harmonics of the spin more than slow signals."
    ),
    source=(
        "Taylor series of a low-pass of linear phase: b is a 24th of the square of the averaging interval (1.6e-4 s^2 for a sixteenth of "
        "a second), or half the square of a first-order filter's time constant"
    ),
    equation=r"G_{out} \leftarrow G_{out} + b\,\ddot G_{out}",
    limits=(
        "First order in b, for signals slow against the filter; b is positive. The delay itself is time-offset, except for the disc "
        "angle's part, which beta_z absorbs."
    ),
    parameters=(shared("b", "b", "s^2", "curvature of the filter's response at low frequencies", 1e-6),),
    transducer=curve_response,
)


def imu_filter(m: Motion, p: Values, c: Context) -> Motion:
    def unfiltered(v: sp.Matrix, b: sp.Expr) -> sp.Matrix:
        return v.applyfunc(lambda e: e - b * c.rate(c.rate(e)))

    return m._replace(
        a=unfiltered(m.a, p.b_a), omega=unfiltered(m.omega, p.b_w), omegadot=unfiltered(m.omegadot, p.b_w)
    )


IMU_FILTER = Effect(
    id="imu-filter",
    title="Filter between motion sensor and disc",
    physics=(
        "The motion sensor averages over its sampling interval or has a low-pass, or a mount between it and the disc resonates: fast "
        "motion is recorded smaller, or larger, than it acts on the disc."
    ),
    source=(
        "Taylor series of a response without delay: b is a 24th of the square of the averaging interval, and 1/w^2 of a mount on which "
        "the disc resonates at w: 3e-3 s^2 at 3 Hz"
    ),
    equation=(
        r"\bm a = \bm a_{rec} - b_a\,\ddot{\bm a}_{rec},\; \bm\omega_{im} = \bm\omega_{rec} - b_\omega\,\ddot{\bm\omega}_{rec}"
    ),
    limits=(
        "First order in b, for motion slow against filter or resonance, whose quality factor does not matter there; alike along all "
        "axes. The delay is time-offset or gyro-delay. A resonance near the motion's frequencies is mount-resonance, one of an "
        "accelerometer accelerometer-resonance."
    ),
    parameters=tuple(
        shared(f"b_{n}", latex, "s^2", f"curvature of the response to {of}", 1e-5)
        for n, latex, of in (("a", "b_a", "specific force"), ("w", r"b_\omega", "angular rate"))
    ),
    sensing=imu_filter,
)


def time_offset(m: Motion, p: Values, c: Context) -> Motion:
    return m.with_each(lambda e: c.shifted(e, p.delta_t))


TIME_OFFSET = Effect(
    id="time-offset",
    title="Clock offset of the motion record",
    physics=(
        "Motion sensor and output are sampled by different clocks or filtered with different delays: the motion of instant t is recorded "
        "at t + delta_t."
    ),
    source="time synchronisation of inertial sensors",
    equation=r"\bm v(t) = \bm v_{rec}(t + \delta t),\; \bm v = \bm a, \bm\omega_{im}, \dot{\bm\omega}_{im}",
    limits=(
        "Fits interpolate the recorded motion; exported programs approximate the delay to second order in delta_t, which must be far "
        "below the time scale of the motion. Gradients and the disc angle, which belong to the output's clock, are not moved."
    ),
    parameters=(
        shared(
            "delta_t",
            r"\delta t",
            "s",
            "lateness of the motion record",
            1e-3,
            late=("a", "omega", "omegadot"),
        ),
    ),
    sensing=time_offset,
)


def clock_drift(m: Motion, p: Values, c: Context) -> Motion:
    return m.with_each(lambda e: c.shifted(e, p.epsilon * c.time))


CLOCK_DRIFT = Effect(
    id="clock-drift",
    title="Drift of the motion record's clock",
    physics="Motion sensor and output are sampled by clocks that drift apart: the motion of instant t is recorded at t + epsilon t.",
    source="frequency accuracy of quartz oscillators (IEEE Std 1139): 1e-8 with an oven, 1e-5 without",
    equation=(
        r"\bm v(t) = \bm v_{rec}(t + \epsilon t),\; \bm v = \bm a, \bm\omega_{im}, \dot{\bm\omega}_{im}"
    ),
    limits=(
        "From the instant 0 of the record's time column (another one is time-offset). Fits interpolate the recorded motion; exported "
        "programs approximate the delay to second order in epsilon t, which must be far below the time scale of the motion."
    ),
    parameters=(
        shared(
            "epsilon",
            r"\epsilon",
            "1",
            "lateness of the motion record that a second adds",
            1e-6,
            late=("a", "omega", "omegadot"),
            growing=True,
        ),
    ),
    sensing=clock_drift,
)


def gyro_delay(m: Motion, p: Values, c: Context) -> Motion:
    def rate(e: sp.Expr) -> sp.Expr:
        # The recorded acceleration is the rate of the recorded one only where both are equally late.
        change = c.rate(e)
        return e + p.delta_w * change + (p.delta_w * p.delta_d - p.delta_w**2 / 2) * c.rate(change)

    omega = m.omega.applyfunc(rate)
    return m._replace(omega=omega, omegadot=m.omegadot.applyfunc(lambda e: c.shifted(e, p.delta_d)))


GYRO_DELAY = Effect(
    id="gyro-delay",
    title="Delay of the gyroscopes against the accelerometers",
    physics=(
        "Gyroscopes and accelerometers of a motion sensor pass filters of different delay, or are read one after the other: the rate of "
        "instant t is recorded at t + delta, together with the specific force of t."
    ),
    source="group delays of the digital filters of inertial sensors; found in a record of real sensors",
    equation=(
        r"\bm\omega_{im}(t) = \bm\omega_{rec}(t + \delta_\omega),\;"
        r" \dot{\bm\omega}_{im}(t) = \dot{\bm\omega}_{rec}(t + \delta_{\dot\omega})"
    ),
    limits=(
        "Specific force keeps its clock (time-offset moves both). Fits interpolate the recorded rates; exported programs approximate the "
        "delays to second order. The two delays are equal where the angular acceleration is derived from the rate."
    ),
    parameters=(
        shared("delta_w", r"\delta_\omega", "s", "lateness of the angular rate", 1e-3, late=("omega",)),
        shared(
            "delta_d",
            r"\delta_{\dot\omega}",
            "s",
            "lateness of the angular acceleration",
            1e-3,
            late=("omegadot",),
        ),
    ),
    sensing=gyro_delay,
)


def imu_skew(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=sp.Matrix([c.shifted(m.a[0], p.delta_x), c.shifted(m.a[1], p.delta_y), m.a[2]]))


IMU_SKEW = Effect(
    id="imu-skew",
    title="Sampling skew of the motion sensor's accelerometers",
    physics="One converter reads the channels in turn, or their filters differ: a_x and a_y are recorded later than a_z.",
    source="multiplexed converters: the sampling interval over the number of channels; filters with capacitors of 5 %",
    equation=r"a_x(t) = a_{x,rec}(t + \delta_x),\; a_y(t) = a_{y,rec}(t + \delta_y)",
    limits=(
        "Relative to a_z, whose own delay is time-offset; indistinguishable where a_z hardly matters. Fits interpolate the recorded a_x "
        "and a_y; exported programs approximate the delays to second order."
    ),
    parameters=tuple(
        shared(f"delta_{k}", rf"\delta_{k}", "s", f"lateness of a_{k}", 1e-3, late=(f"a_{k}",)) for k in "xy"
    ),
    sensing=imu_skew,
)
