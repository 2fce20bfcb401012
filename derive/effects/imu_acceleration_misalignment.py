import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components

PAIRS = ("xy", "xz", "yx", "yz", "zx", "zy")


def straighten(v: sp.Matrix, p: Values) -> sp.Matrix:
    skewed = sp.Matrix(3, 3, lambda i, k: 0 if i == k else p[f"m_{'xyz'[i]}{'xyz'[k]}"])
    return v - skewed * v + skewed * skewed * v


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=straighten(m.a, p))


EFFECT = Effect(
    id="imu-acceleration-misalignment",
    title="Misalignment of the motion sensor's accelerometers",
    physics=(
        "Each accelerometer of the motion sensor is misaligned individually, so that it reports a little of the force along the "
        "other axes; the gyroscopes' axes are those of the measurement frame."
    ),
    source="IEEE Std 1293, input-axis misalignment: 10 to 1000 microradians",
    equation=r"\bm a_{rec} = (\bm 1 + \bm m)\,\bm a,\; m_{kk} = 0",
    limits=(
        "To second order in m. A common rotation of the three accelerometers is imu-misalignment without the gyroscopes; only the "
        "angular rate distinguishes the two."
    ),
    parameters=components(
        "m",
        PAIRS,
        "rad",
        "share of the force along {1} in what is reported along {0}",
        1e-4,
        like="vartheta_z",
    ),
    sensing=sensing,
)
