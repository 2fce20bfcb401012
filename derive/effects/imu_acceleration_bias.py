import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=m.a - sp.Matrix([p.b_x, p.b_y, p.b_z]))


EFFECT = Effect(
    id="imu-acceleration-bias",
    title="Bias of the motion sensor's accelerometers",
    physics="The motion sensor reports a constant false specific force.",
    source="IEEE Std 1293, null bias: 25 ug (navigation grade) to 1 mg (tactical grade)",
    equation=r"\bm a = \bm a_{rec} - \bm b",
    limits=(
        "Constant over the record. Horizontal biases look like a constant force that turns in the disc's frame; b_z is "
        "absorbed by null biases."
    ),
    parameters=components("b", "xyz", "ug", "bias of the accelerometer along {k}", 50.0, like="K0"),
    sensing=sensing,
)
