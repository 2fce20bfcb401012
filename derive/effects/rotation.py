"""Rotation of the disc: its axis, its bearing, and what the accelerometers feel of its turning."""

from __future__ import annotations

import sympy as sp

from derive import stages
from derive.context import Context
from derive.effect import Effect, EffectParameter, Values, shared, shared_components
from derive.stages import Geometry, Motion, SensedForce, skew, spin_gradient


def small_rotation(vector: sp.Matrix, name: str, c: Context) -> sp.Matrix:
    """Right-handed rotation about ``vector`` by its length (rad), to second order, (3, 3).

    Polynomial, hence differentiable where the vector vanishes (unlike Rodrigues' formula with its length);
    it departs from a rotation by vector^3/6, 2e-13 for 1e-4 rad. Its entries are named ``name_xx`` ... on
    the tape.
    """
    k = skew(vector)
    turn = sp.eye(3) + k + k * k / 2
    return sp.Matrix(3, 3, lambda i, j: c.tape.let(f"{name}_{'xyz'[i]}{'xyz'[j]}", turn[i, j]))


def lean(g: Geometry, vector: sp.Matrix, name: str, c: Context) -> Geometry:
    """Position and triad, turned together by a small rotation ``vector`` (rad) of the same frame."""
    turn = small_rotation(vector, name, c)
    return Geometry(turn * g.r, (turn * g.tau.T).T)


def spin_axis_tilt(m: Motion, p: Values, c: Context) -> Motion:
    # Seen by a disc that leans by alpha, everything else leans by -alpha: the spin axis stays its z.
    back = small_rotation(sp.Matrix([-p.alpha_x, -p.alpha_y, 0]), "tilt", c)
    if (
        c.standing is not None
    ):  # about the disc's own axes: about the measurement frame's, one may be the spin's
        own = c.standing * back * c.standing.T
        back = sp.Matrix(3, 3, lambda i, k: c.tape.let(f"tilt_on_disc_{'xyz'[i]}{'xyz'[k]}", own[i, k]))
    return Motion(back * m.a, back * m.omega, back * m.omegadot, back * m.Gamma * back.T)


SPIN_AXIS_TILT = Effect(
    id="spin-axis-tilt",
    title="Tilt of the spin axis",
    physics=(
        "The disc's bearing is not along the z axis of the motion sensor: the plane in which the accelerometers turn is tilted in the "
        "measurement frame, and the spin with it."
    ),
    source="rigid-body kinematics",
    equation=(
        r"\bm r_j \leftarrow \bm R(\bm\alpha)\, \bm r_j,\; \bm\tau_j \leftarrow \bm R(\bm\alpha)\, \bm\tau_j,"
        r"\; \bm e_z \leftarrow \bm R(\bm\alpha)\, \bm e_z,\; \bm\alpha = (\alpha_x, \alpha_y, 0)"
    ),
    limits=(
        "Rotation to second order in alpha. The same as rotating the motion record back (imu-misalignment), except for the gradients, "
        "which alpha rotates too."
    ),
    parameters=tuple(
        shared(f"alpha_{k}", rf"\alpha_{k}", "rad", f"lean about the {k} axis of the disc at rest", 1e-4)
        for k in "xy"
    ),
    sensing=spin_axis_tilt,
)


def spin_axis_wobble(g: Geometry, p: Values, c: Context) -> Geometry:
    turned = [c.cos_phi * p.w_x - c.sin_phi * p.w_y, c.sin_phi * p.w_x + c.cos_phi * p.w_y, 0]
    return lean(g, sp.Matrix(turned), "wobble", c)


SPIN_AXIS_WOBBLE = Effect(
    id="spin-axis-wobble",
    title="Wobble of the disc",
    physics="The disc does not sit square on its shaft: its plane is tilted, and the tilt turns with the disc.",
    source="rigid-body kinematics",
    equation=(
        r"\bm r_j \leftarrow \bm R(\bm w)\, \bm r_j,\; \bm\tau_j \leftarrow \bm R(\bm w)\, \bm\tau_j,\;"
        r" \bm w = w_x \bm e_r(\phi) + w_y \bm e_t(\phi)"
    ),
    limits=(
        "Rotation to second order in w; the shaft about which the disc turns is unchanged. To first order it is a pattern of the "
        "mounting angles of the four accelerometers, which beta_x and vartheta_y absorb."
    ),
    parameters=shared_components("w", "xy", "rad", "lean of the disc about its own {k} axis", 1e-5),
    geometry=spin_axis_wobble,
)


HARMONICS = (1, 2)


def bearing_run_out(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    waves = {1: (c.cos_phi, c.sin_phi), 2: (c.cos_phi**2 - c.sin_phi**2, 2 * c.cos_phi * c.sin_phi)}

    def named(name: str, v: sp.Matrix) -> sp.Matrix:
        return sp.Matrix([c.tape.let(f"{name}_{'xyz'[n]}", v[n]) for n in range(3)])

    away = sp.zeros(3, 1)
    for n in HARMONICS:
        cosine, sine = waves[n]
        away += sp.Matrix([p[f"c_{k}{n}"] * cosine + p[f"s_{k}{n}"] * sine for k in "xyz"])
    d = named("run_out", away)
    velocity = named("run_out_velocity", d.applyfunc(c.rate))
    m = c.motion
    return stages.gradient(m) * d + 2 * m.omega.cross(velocity) + velocity.applyfunc(c.rate)


BEARING_RUN_OUT = Effect(
    id="bearing-run-out",
    title="Run-out of the bearing",
    physics=(
        "Races and balls of the spin bearing are not round: the disc's centre moves on a small closed path with every turn, and its "
        "acceleration acts on all accelerometers alike."
    ),
    source="synchronous run-out of precision spindle bearings (ISO 230-7): below a micrometre",
    equation=(
        r"\bm f \mathrel{+}= \ddot{\bm d} + 2\bm\omega\times\dot{\bm d} + \bm M\bm d,\;"
        r" \bm d = \sum_{n=1}^2 \bm c_n \cos n\phi + \bm s_n \sin n\phi"
    ),
    limits=(
        "Once and twice a turn, without tilt (else spin-axis-wobble), along axes that do not turn. What turns with the disc once a turn "
        "is a constant force there, absorbed by null biases. phi is the true angle."
    ),
    parameters=tuple(
        shared(f"{a}_{k}{n}", f"{a}_{{{k}{n}}}", "um", f"{word} of harmonic {n} along {k}", 1.0)
        for n in HARMONICS
        for k in "xyz"
        for a, word in (("c", "cosine"), ("s", "sine"))
    ),
    field=bearing_run_out,
)


def disc_spin(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    added = spin_gradient(c.motion, c.spin)
    named = sp.Matrix(3, 3, lambda i, k: c.tape.let(f"spin_{'xyz'[i]}{'xyz'[k]}", added[i, k]))
    return p.share * named * r


DISC_SPIN = Effect(
    id="disc-spin",
    title="Spin of the disc",
    physics=(
        "The accelerometers turn with the disc, whose angular rate is the platform's and the spin's together. Eq. 9 has the platform's "
        "rate only: it lacks the Coriolis force of the platform's rate and the spin, the centripetal force of the spin, and the Euler "
        "force of a spin that varies."
    ),
    source="rigid-body kinematics: paper, Eq. 9 and 49, with the rate of the disc instead of the platform's",
    equation=(
        r"\bm f_j \mathrel{+}= share\,[2\,\bm\omega_{im} \times (\dot\phi\,\bm e_z \times \bm r_j)"
        r" + \dot\phi^2\,\bm e_z \times (\bm e_z \times \bm r_j) + \ddot\phi\,\bm e_z \times \bm r_j]"
    ),
    limits=(
        "share is 0 (Eq. 9) or 1 (physical); nothing in between is physical. The centripetal force of a steady spin is constant, and "
        "absorbed by K0, K1, vartheta_y and vartheta_z. The rate is that of spin_angle, or 2 pi spin_frequency where it is not recorded. "
        'A model with kinematics = "full" has all of it.'
    ),
    parameters=(shared("share", "share", "1", "share of the spin in the kinematics", 1.0, physical=1.0),),
    field=disc_spin,
    moot=lambda order, kinematics: kinematics == "full",
)


def anisoinertia(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    assert c.geometry is not None
    rate = c.case.omega
    return i + p.K_ip * rate.dot(c.geometry.tau[0, :]) * rate.dot(c.geometry.tau[2, :])


ANISOINERTIA = Effect(
    id="anisoinertia",
    title="Anisoinertia of the pendulum",
    physics=(
        "The pendulum's moments of inertia about its input and its pendulous axis differ: turning about both at once twists it about its "
        "output axis. The case spins about the pendulous axis all the time, so the platform's rate about the input axis appears "
        "multiplied by the spin."
    ),
    source="IEEE Std 1293, angular-velocity-sensitive terms of a pendulous accelerometer",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_{ip}\,(\bm\omega \cdot \bm\tau_{jx})(\bm\omega \cdot \bm\tau_{jz}),\;"
        r" \bm\omega = \bm\omega_{im} + \dot\phi\,\bm e_z"
    ),
    limits=(
        "Rate of the case along the nominal axes. With a steady spin it acts like the omega x Omega term of pendulum-angular: the two "
        "differ only by the angular acceleration."
    ),
    parameters=(
        EffectParameter(
            "K_ip",
            "K_{ip}",
            "ug/(rad/s)^2",
            "bias per product of the rates about input and pendulous axis",
            10.0,
        ),
    ),
    transducer=anisoinertia,
)


def pendulum_angular(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    assert c.geometry is not None
    return i + p.K_pa * c.case.omegadot.dot(c.geometry.tau[1, :])


PENDULUM_ANGULAR = Effect(
    id="pendulum-angular",
    title="Sensitivity to angular acceleration",
    physics=(
        "The proof mass is a pendulum about the output axis, which lies along the radius: angular acceleration of its case about that "
        "axis has to be balanced like a force."
    ),
    source="IEEE Std 1293, angular-acceleration sensitivity of a pendulous accelerometer",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_{pa}\, (\dot{\bm\omega}_{im} + \bm\omega_{im} \times \dot\phi\,\bm e_z"
        r" + \ddot\phi\,\bm e_z) \cdot \bm\tau_{jy}"
    ),
    limits=(
        "Angular acceleration of the case, which turns with the disc: that of the platform, and the turning of the spin axis by the "
        "platform, omega x Omega, which is as large. In the omegadot terms it shifts the effective position of the accelerometer along z "
        "by -K_pa, as beta_x does."
    ),
    parameters=(
        EffectParameter("K_pa", "K_{pa}", "ug/(rad/s^2)", "bias per angular acceleration about tau_y", 10.0),
    ),
    transducer=pendulum_angular,
)
