import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    D = sp.Matrix(3, 3, lambda i, k: p[f"d_{'xyz'[i]}{'xyz'[k]}"])
    a_rate = m.a.applyfunc(c.rate)
    return m._replace(omega=m.omega - D * m.a, omegadot=m.omegadot - D * a_rate)


EFFECT = Effect(
    id="gyro-g-sensitivity",
    title="Sensitivity of the gyroscopes to specific force",
    physics=(
        "Unbalanced or elastic suspension lets specific force move a gyroscope's proof mass like a rate; the recorded angular "
        "acceleration contains its derivative."
    ),
    source="IEEE Std 528, acceleration-sensitive drift: 0.1 (ring laser: none) to 50 deg/h/g (MEMS)",
    equation=(
        r"\bm\omega_{im} = \bm\omega_{rec} - \bm D\,\bm a,\;"
        r" \dot{\bm\omega}_{im} = \dot{\bm\omega}_{rec} - \bm D\,\dot{\bm a}"
    ),
    limits="Linear in the force at the disc centre; the square of the force is neglected.",
    parameters=components(
        "d",
        [i + k for i in "xyz" for k in "xyz"],
        "deg/h/g",
        "rate about {0} per specific force along {1}",
        1.0,
        latex="D",
        like="K0",
    ),
    sensing=sensing,
)
