import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components
from derive.hooks import small_rotation


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    # A sensor turned by e records v - e x v: turning by e gives the components in the measurement frame.
    back = small_rotation(sp.Matrix([p.e_x, p.e_y, p.e_z]), "imu_turn", c)
    return m._replace(a=back * m.a, omega=back * m.omega, omegadot=back * m.omegadot)


EFFECT = Effect(
    id="imu-misalignment",
    title="Misalignment of the motion sensor",
    physics="The axes of the motion sensor are turned by small angles against the measurement frame.",
    source="rigid-body kinematics",
    equation=(
        r"\bm v = \bm v_{rec} + \bm e \times \bm v_{rec},\;"
        r" \bm v = \bm a, \bm\omega_{im}, \dot{\bm\omega}_{im}"
    ),
    limits=(
        "Rotation to second order in e, one for accelerometers and gyroscopes; gradients are not turned. "
        "only gradients distinguish e_x, e_y from spin-axis-tilt, and e_z from spin-phase-offset."
    ),
    parameters=components("e", "xyz", "rad", "turn of the motion sensor about {k}", 1e-4, like="vartheta_z"),
    sensing=sensing,
)
