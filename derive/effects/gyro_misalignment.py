from derive.effect import Context, Effect, Motion, Values, components
from derive.effects.imu_acceleration_misalignment import PAIRS, straighten


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(omega=straighten(m.omega, p), omegadot=straighten(m.omegadot, p))


EFFECT = Effect(
    id="gyro-misalignment",
    title="Misalignment and cross-axis scale of the gyroscopes",
    physics=(
        "Each gyroscope is misaligned individually, or its electronics couple, so that it reports a little of the rate about the "
        "other axes."
    ),
    source="IEEE Std 528, misalignment and cross-axis sensitivity: 0.1 mrad (navigation grade) to 2 % (MEMS data sheets)",
    equation=r"\bm\omega_{rec} = (\bm 1 + \bm m)\,\bm\omega_{im},\; m_{kk} = 0",
    limits=(
        "To second order in m. A common rotation of gyroscopes and accelerometers is imu-misalignment, of the accelerometers only "
        "imu-acceleration-misalignment; the force distinguishes them."
    ),
    parameters=components(
        "m",
        PAIRS,
        "rad",
        "share of the rate about {1} in what is reported about {0}",
        1e-4,
        like="vartheta_z",
    ),
    sensing=sensing,
)
