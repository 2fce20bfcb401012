import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    x, y, z = m.a
    return m._replace(a=sp.Matrix([x - p.q_x * x**2, y - p.q_y * y**2, z]))


EFFECT = Effect(
    id="imu-acceleration-quadratic",
    title="Curvature of the motion sensor's accelerometers",
    physics="Each accelerometer of the motion sensor reports a little of the square of the force along its axis.",
    source="IEEE Std 1293, second-order coefficient: 10 ug/g^2 (navigation grade) to 1 mg/g^2 (MEMS)",
    equation=r"a_k = a_{k,rec} - q_k a_{k,rec}^2",
    limits=(
        "It does not turn with the disc: the square of a horizontal force appears at the spin frequency, where the instrument's K2 ... "
        "K8 have no term. For a_z, which hardly changes, it is a bias, and neglected."
    ),
    parameters=components("q", "xy", "ug/g^2", "curvature of the accelerometer along {k}", 20.0, like="K2"),
    sensing=sensing,
)
