"""Disc angle that is not as recorded."""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import Effect, Values, shared


def spin_phase_offset(p: Values, c: Context) -> sp.Expr:
    return p.phi_0


SPIN_PHASE_OFFSET = Effect(
    id="spin-phase-offset",
    title="Offset of the disc angle",
    physics="The encoder's zero is not at the angle where A1 is on the x axis.",
    source="definition of the disc angle (paper, Section II.A.1)",
    equation=r"\phi \leftarrow \phi + \phi_0",
    limits=(
        "Exact. A common part of beta_z is equivalent and absorbs it; rotating the motion record about z is equivalent except for the "
        "gradients."
    ),
    parameters=(shared("phi_0", r"\phi_0", "rad", "true disc angle less the recorded one", 1e-4),),
    disc_angle=spin_phase_offset,
)


def spin_rate_offset(p: Values, c: Context) -> sp.Expr:
    return p.epsilon * c.Omega * c.time


SPIN_RATE_OFFSET = Effect(
    id="spin-rate-offset",
    title="Offset of the spin rate",
    physics=(
        "The clock of the spin servo and that of the recorder differ, or the encoder's turns are counted at a wrong rate: the true disc "
        "angle departs steadily from the recorded one."
    ),
    source="frequency accuracy of quartz oscillators (IEEE Std 1139): 1e-8 with an oven, 1e-5 without",
    equation=r"\phi \leftarrow \phi + \epsilon\,\Omega\,t",
    limits=(
        "Steady over the record, from the instant 0 of its time column (another one is spin-phase-offset). With a steady horizontal "
        "force it looks like a drift of scale factors and misalignments."
    ),
    parameters=(shared("epsilon", r"\epsilon", "1", "true spin rate over the believed one, less one", 1e-7),),
    disc_angle=spin_rate_offset,
)


def spin_rate_jitter(p: Values, c: Context) -> sp.Expr:
    # The sensitivity to the angle; the random angle itself is the runtime's business.
    return p.sigma_phi + p.sigma_walk


SPIN_RATE_JITTER = Effect(
    id="spin-rate-jitter",
    title="Jitter of the spin rate",
    physics=(
        "Drive and bearing let the disc run unevenly: its true angle deviates from the recorded one, independently at every sample or as "
        "a random walk. Steady horizontal force turns it into noise of the output."
    ),
    source="angle noise of a spin servo",
    equation=r"\phi \leftarrow \phi + \delta\phi(t)",
    limits=(
        "To first order in the angle, uncorrelated with the motion. The tangential force of the uneven spin itself, R phi'', is common "
        "to the four accelerometers, stationary, and part of the noise of G_out."
    ),
    kind="random",
    parameters=(
        shared("sigma_phi", r"\sigma_\phi", "rad", "standard deviation, independent at every sample", 1e-6),
        shared("sigma_walk", r"\sigma_w", "rad/s^0.5", "random walk: growth with the root of time", 1e-6),
    ),
    disc_angle=spin_rate_jitter,
)


def spin_servo(p: Values, c: Context) -> sp.Expr:
    return -p.c * c.motion.omegadot[2]


SPIN_SERVO = Effect(
    id="spin-servo",
    title="Compliance of the spin servo",
    physics=(
        "The disc's inertia holds it back when the platform is turned about the spin axis; the servo that drives it is no stiffer than "
        "its bandwidth, so the true angle lags by the torque over the stiffness."
    ),
    source="a position loop of bandwidth f is as stiff as its inertia times (2 pi f)^2: c = 1/(2 pi f)^2, 2.5e-4 s^2 for 10 Hz",
    equation=r"\phi \leftarrow \phi - c\,\dot\omega_{imz}",
    limits=(
        "Slow against the servo's bandwidth, and only if the recorded angle does not contain it (no encoder, or one on the motor). The "
        "force of the uneven spin, R phi'', is in a model of full kinematics (or with disc-spin)."
    ),
    parameters=(shared("c", "c", "s^2", "angle lost per angular acceleration", 1e-4),),
    disc_angle=spin_servo,
)


HARMONICS = (1, 2, 3, 4)


def encoder_harmonic(p: Values, c: Context) -> sp.Expr:
    increment = sp.Integer(0)
    for n in HARMONICS:
        cosine, sine = c.harmonic(n)
        increment += p[f"c_{n}"] * cosine + p[f"s_{n}"] * sine
    return increment


ENCODER_HARMONIC = Effect(
    id="encoder-harmonic",
    title="Harmonic error of the encoder",
    physics=(
        "An eccentric encoder scale, or a drive torque that ripples with the turn, makes the true disc angle swing about the recorded "
        "one with the harmonics of the turn."
    ),
    source="eccentricity and ripple errors of rotary encoders",
    equation=r"\phi \leftarrow \phi + \sum_{n=1}^4 c_n \cos n\phi + s_n \sin n\phi",
    limits=(
        "Harmonics one to four; phi on the right is the recorded angle. The force of an uneven spin, R phi'', is in a model of full "
        "kinematics (or with disc-spin), with the true angle's derivatives: it acts on a disc that really swings, not on one that turns "
        "steadily behind an uneven encoder."
    ),
    parameters=tuple(
        shared(f"{a}_{n}", f"{a}_{n}", "rad", f"{word} of harmonic {n}", 1e-5)
        for n in HARMONICS
        for a, word in (("c", "cosine"), ("s", "sine"))
    ),
    disc_angle=encoder_harmonic,
)
