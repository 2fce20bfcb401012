import sympy as sp

from derive.effect import Context, Effect, Motion, Values, shared
from derive.hooks import warmth


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    warmer = warmth(p, c)
    true = [(m.a[n] - p[f"db_{k}_dT"] * warmer) / (1 + p[f"ds_{k}_dT"] * warmer) for n, k in enumerate("xy")]
    return m._replace(a=sp.Matrix([*true, m.a[2]]))


EFFECT = Effect(
    id="imu-thermal",
    title="Temperature coefficients of the motion sensor's accelerometers",
    physics="Bias and scale factor of the motion sensor's accelerometers change as it warms, and what it reports with them.",
    source="IEEE Std 1293: 10 ug/K and 50 ppm/K (tactical grade) to 100 ug/K and 200 ppm/K (MEMS data sheets)",
    equation=(
        r"a_{k,rec} = a_k (1 + \partial_T s_k (T - 293.15\,\mathrm{K})) + \partial_T b_k (T - 293.15\,\mathrm{K})"
    ),
    limits=(
        "Linear in the temperature of the column, which is that of both instruments. The channel along the spin axis, to which no "
        "accelerometer should respond, is neglected. A changing scale factor of the motion sensor acts like that of all four "
        "accelerometers; its axes, which do not turn, distinguish it from thermal-scale."
    ),
    channels=("temperature",),
    parameters=tuple(
        shared(
            f"d{n}_{k}_dT", rf"\partial_T {n}_{k}", unit, f"change of the {word} along {k}", size, like=like
        )
        for n, unit, word, size, like in (
            ("b", "ug/K", "bias", 10.0, "K0"),
            ("s", "1/K", "scale", 1e-5, "K1"),
        )
        for k in "xy"
    ),
    sensing=sensing,
)
