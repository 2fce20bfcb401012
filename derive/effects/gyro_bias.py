import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(omega=m.omega - sp.Matrix([p.b_x, p.b_y, p.b_z]))


EFFECT = Effect(
    id="gyro-bias",
    title="Bias of the gyroscopes",
    physics="Each gyroscope reports a constant false rate, which does not change its derivative.",
    source="IEEE Std 528, bias of a gyroscope: 0.01 deg/h (navigation grade) to 10 deg/h (tactical grade)",
    equation=r"\bm\omega_{im} = \bm\omega_{rec} - \bm b",
    limits=(
        "Constant over the record. It acts through the product with the rate, and in full kinematics with the spin; null biases absorb "
        "the constant part."
    ),
    parameters=components("b", "xyz", "deg/h", "bias of the gyroscope about {k}", 1.0, like="K0"),
    sensing=sensing,
)
