import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    def unscaled(v: sp.Matrix) -> sp.Matrix:
        return sp.Matrix([v[n] / (1 + p[f"s_{k}"]) for n, k in enumerate("xyz")])

    return m._replace(omega=unscaled(m.omega), omegadot=unscaled(m.omegadot))


EFFECT = Effect(
    id="gyro-scale",
    title="Scale error of the gyroscopes",
    physics="Each gyroscope reports (1 + s) times the rate about its axis, and so does its derivative.",
    source="IEEE Std 528, scale-factor error of a gyroscope",
    equation=r"\omega_k = \omega_{k,rec}/(1 + s_k),\; \dot\omega_k = \dot\omega_{k,rec}/(1 + s_k)",
    limits="Exact in s; one scale an axis, no asymmetry between the senses of turning.",
    parameters=components(
        "s", "xyz", "1", "relative scale error of the gyroscope about {k}", 1e-4, like="K1"
    ),
    sensing=sensing,
)
