"""Accelerometers and gyroscopes of the motion sensor: bias, scale, axes, place."""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import Effect, Values, shared, shared_components
from derive.effects.rotation import small_rotation
from derive.stages import Motion

PAIRS = ("xy", "xz", "yx", "yz", "zx", "zy")


def vector(p: Values, letter: str) -> sp.Matrix:
    """(3,): the parameters ``letter_x``, ``letter_y``, ``letter_z``."""
    return sp.Matrix([p[f"{letter}_{k}"] for k in "xyz"])


def unscale(v: sp.Matrix, p: Values) -> sp.Matrix:
    """What sensors with relative scale errors s reported, without them."""
    return sp.Matrix([v[n] / (1 + p[f"s_{k}"]) for n, k in enumerate("xyz")])


def straighten(v: sp.Matrix, p: Values) -> sp.Matrix:
    """What sensors reported that have shares m of the other axes, without these, to second order."""
    skewed = sp.Matrix(3, 3, lambda i, k: 0 if i == k else p[f"m_{'xyz'[i]}{'xyz'[k]}"])
    return v - skewed * v + skewed * skewed * v


def imu_acceleration_bias(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=m.a - vector(p, "b"))


IMU_ACCELERATION_BIAS = Effect(
    id="imu-acceleration-bias",
    title="Bias of the motion sensor's accelerometers",
    physics="The motion sensor reports a constant false specific force.",
    source="IEEE Std 1293, null bias: 25 ug (navigation grade) to 1 mg (tactical grade)",
    equation=r"\bm a = \bm a_{rec} - \bm b",
    limits=(
        "Constant over the record. Horizontal biases look like a constant force that turns in the disc's frame; b_z is absorbed by null "
        "biases."
    ),
    parameters=shared_components("b", "xyz", "ug", "bias of the accelerometer along {k}", 50.0, like="K0"),
    sensing=imu_acceleration_bias,
)


def imu_acceleration_scale(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=unscale(m.a, p))


IMU_ACCELERATION_SCALE = Effect(
    id="imu-acceleration-scale",
    title="Scale error of the motion sensor's accelerometers",
    physics="Each accelerometer of the motion sensor reports (1 + s) times the specific force along its axis.",
    source="IEEE Std 1293, scale-factor error: 50 ppm (navigation grade) to 1000 ppm (tactical grade)",
    equation=r"a_k = a_{k,rec}/(1 + s_k)",
    limits=(
        "Exact in s; one scale an axis, the same for both signs. What is common to s_x and s_y acts like a scale factor common to the "
        "four accelerometers; only gradients and rates distinguish them."
    ),
    parameters=shared_components(
        "s", "xyz", "1", "relative scale error of the accelerometer along {k}", 1e-4, like="K1"
    ),
    sensing=imu_acceleration_scale,
)


def imu_acceleration_quadratic(m: Motion, p: Values, c: Context) -> Motion:
    x, y, z = m.a
    return m._replace(a=sp.Matrix([x - p.q_x * x**2, y - p.q_y * y**2, z]))


IMU_ACCELERATION_QUADRATIC = Effect(
    id="imu-acceleration-quadratic",
    title="Curvature of the motion sensor's accelerometers",
    physics="Each accelerometer of the motion sensor reports a little of the square of the force along its axis.",
    source="IEEE Std 1293, second-order coefficient: 10 ug/g^2 (navigation grade) to 1 mg/g^2 (MEMS)",
    equation=r"a_k = a_{k,rec} - q_k a_{k,rec}^2",
    limits=(
        "It does not turn with the disc: the square of a horizontal force appears at the spin frequency, where the instrument's K2 ... "
        "K8 have no term. For a_z, which hardly changes, it is a bias, and neglected."
    ),
    parameters=shared_components(
        "q", "xy", "ug/g^2", "curvature of the accelerometer along {k}", 20.0, like="K2"
    ),
    sensing=imu_acceleration_quadratic,
)


def imu_acceleration_misalignment(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=straighten(m.a, p))


IMU_ACCELERATION_MISALIGNMENT = Effect(
    id="imu-acceleration-misalignment",
    title="Misalignment of the motion sensor's accelerometers",
    physics=(
        "Each accelerometer of the motion sensor is misaligned individually, so that it reports a little of the force along the other "
        "axes; the gyroscopes' axes are those of the measurement frame."
    ),
    source="IEEE Std 1293, input-axis misalignment: 10 to 1000 microradians",
    equation=r"\bm a_{rec} = (\bm 1 + \bm m)\,\bm a,\; m_{kk} = 0",
    limits=(
        "To second order in m. A common rotation of the three accelerometers is imu-misalignment without the gyroscopes; only the "
        "angular rate distinguishes the two."
    ),
    parameters=shared_components(
        "m",
        PAIRS,
        "rad",
        "share of the force along {1} in what is reported along {0}",
        1e-4,
        like="vartheta_z",
    ),
    sensing=imu_acceleration_misalignment,
)


def gyro_bias(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(omega=m.omega - vector(p, "b"))


GYRO_BIAS = Effect(
    id="gyro-bias",
    title="Bias of the gyroscopes",
    physics="Each gyroscope reports a constant false rate, which does not change its derivative.",
    source="IEEE Std 528, bias of a gyroscope: 0.01 deg/h (navigation grade) to 10 deg/h (tactical grade)",
    equation=r"\bm\omega_{im} = \bm\omega_{rec} - \bm b",
    limits=(
        "Constant over the record. It acts through the product with the rate, and in full kinematics with the spin; null biases absorb "
        "the constant part."
    ),
    parameters=shared_components("b", "xyz", "deg/h", "bias of the gyroscope about {k}", 1.0, like="K0"),
    sensing=gyro_bias,
)


def gyro_scale(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(omega=unscale(m.omega, p), omegadot=unscale(m.omegadot, p))


GYRO_SCALE = Effect(
    id="gyro-scale",
    title="Scale error of the gyroscopes",
    physics="Each gyroscope reports (1 + s) times the rate about its axis, and so does its derivative.",
    source="IEEE Std 528, scale-factor error of a gyroscope",
    equation=r"\omega_k = \omega_{k,rec}/(1 + s_k),\; \dot\omega_k = \dot\omega_{k,rec}/(1 + s_k)",
    limits="Exact in s; one scale an axis, no asymmetry between the senses of turning.",
    parameters=shared_components(
        "s", "xyz", "1", "relative scale error of the gyroscope about {k}", 1e-4, like="K1"
    ),
    sensing=gyro_scale,
)


def gyro_misalignment(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(omega=straighten(m.omega, p), omegadot=straighten(m.omegadot, p))


GYRO_MISALIGNMENT = Effect(
    id="gyro-misalignment",
    title="Misalignment and cross-axis scale of the gyroscopes",
    physics=(
        "Each gyroscope is misaligned individually, or its electronics couple, so that it reports a little of the rate about the other "
        "axes."
    ),
    source="IEEE Std 528, misalignment and cross-axis sensitivity: 0.1 mrad (navigation grade) to 2 % (MEMS data sheets)",
    equation=r"\bm\omega_{rec} = (\bm 1 + \bm m)\,\bm\omega_{im},\; m_{kk} = 0",
    limits=(
        "To second order in m. A common rotation of gyroscopes and accelerometers is imu-misalignment, of the accelerometers only "
        "imu-acceleration-misalignment; the force distinguishes them."
    ),
    parameters=shared_components(
        "m",
        PAIRS,
        "rad",
        "share of the rate about {1} in what is reported about {0}",
        1e-4,
        like="vartheta_z",
    ),
    sensing=gyro_misalignment,
)


def gyro_g_sensitivity(m: Motion, p: Values, c: Context) -> Motion:
    D = sp.Matrix(3, 3, lambda i, k: p[f"d_{'xyz'[i]}{'xyz'[k]}"])
    a_rate = m.a.applyfunc(c.rate)
    return m._replace(omega=m.omega - D * m.a, omegadot=m.omegadot - D * a_rate)


GYRO_G_SENSITIVITY = Effect(
    id="gyro-g-sensitivity",
    title="Sensitivity of the gyroscopes to specific force",
    physics=(
        "Unbalanced or elastic suspension lets specific force move a gyroscope's proof mass like a rate; the recorded angular "
        "acceleration contains its derivative."
    ),
    source="IEEE Std 528, acceleration-sensitive drift: 0.1 (ring laser: none) to 50 deg/h/g (MEMS)",
    equation=(
        r"\bm\omega_{im} = \bm\omega_{rec} - \bm D\,\bm a,\;"
        r" \dot{\bm\omega}_{im} = \dot{\bm\omega}_{rec} - \bm D\,\dot{\bm a}"
    ),
    limits="Linear in the force at the disc centre; the square of the force is neglected.",
    parameters=tuple(
        shared(
            f"d_{i}{k}",
            f"D_{{{i}{k}}}",
            "deg/h/g",
            f"rate about {i} per specific force along {k}",
            1.0,
            like="K0",
        )
        for i in "xyz"
        for k in "xyz"
    ),
    sensing=gyro_g_sensitivity,
)


def imu_misalignment(m: Motion, p: Values, c: Context) -> Motion:
    # A sensor turned by e records v - e x v: turning by e gives the components in the measurement frame.
    back = small_rotation(vector(p, "e"), "imu_turn", c)
    return m._replace(a=back * m.a, omega=back * m.omega, omegadot=back * m.omegadot)


IMU_MISALIGNMENT = Effect(
    id="imu-misalignment",
    title="Misalignment of the motion sensor",
    physics="The axes of the motion sensor are turned by small angles against the measurement frame.",
    source="rigid-body kinematics",
    equation=(
        r"\bm v = \bm v_{rec} + \bm e \times \bm v_{rec},\;"
        r" \bm v = \bm a, \bm\omega_{im}, \dot{\bm\omega}_{im}"
    ),
    limits=(
        "Rotation to second order in e, one for accelerometers and gyroscopes; gradients are not turned. only gradients distinguish e_x, "
        "e_y from spin-axis-tilt, and e_z from spin-phase-offset."
    ),
    parameters=shared_components(
        "e", "xyz", "rad", "turn of the motion sensor about {k}", 1e-4, like="vartheta_z"
    ),
    sensing=imu_misalignment,
)


def imu_lever_arm(m: Motion, p: Values, c: Context) -> Motion:
    arm = vector(p, "l")
    return m._replace(a=m.a - m.omegadot.cross(arm) - m.omega.cross(m.omega.cross(arm)))


IMU_LEVER_ARM = Effect(
    id="imu-lever-arm",
    title="Lever arm of the motion sensor",
    physics="The motion sensor sits at l from the disc centre and records the specific force of that place.",
    source="rigid-body kinematics (as paper, Eq. 9)",
    equation=(
        r"\bm a = \bm a_{rec} - \dot{\bm\omega}_{im} \times \bm l"
        r" - \bm\omega_{im} \times (\bm\omega_{im} \times \bm l)"
    ),
    limits=(
        "The gradient between the two places, Gamma l (3e-7 m/s^2 for 0.1 m), is neglected: it is constant and below any accelerometer's "
        "bias."
    ),
    parameters=shared_components("l", "xyz", "m", "position of the motion sensor, {k}", 0.01),
    sensing=imu_lever_arm,
)
