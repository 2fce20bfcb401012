import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=sp.Matrix([m.a[n] / (1 + p[f"s_{k}"]) for n, k in enumerate("xyz")]))


EFFECT = Effect(
    id="imu-acceleration-scale",
    title="Scale error of the motion sensor's accelerometers",
    physics="Each accelerometer of the motion sensor reports (1 + s) times the specific force along its axis.",
    source="IEEE Std 1293, scale-factor error: 50 ppm (navigation grade) to 1000 ppm (tactical grade)",
    equation=r"a_k = a_{k,rec}/(1 + s_k)",
    limits=(
        "Exact in s; one scale an axis, the same for both signs. What is common to s_x and s_y acts like a scale factor common to the "
        "four accelerometers; only gradients and rates distinguish them."
    ),
    parameters=components(
        "s",
        "xyz",
        "1",
        "relative scale error of the accelerometer along {k}",
        1e-4,
        largest=0.02,  # at rest, or in the mean of a flight, the sensor reads g
        like="K1",
    ),
    sensing=sensing,
)
