import sympy as sp

from derive import stages
from derive.effect import Context, Effect, Values, shared

HARMONICS = (1, 2)


def field(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    waves = {1: (c.cos_phi, c.sin_phi), 2: (c.cos_phi**2 - c.sin_phi**2, 2 * c.cos_phi * c.sin_phi)}
    away = sp.zeros(3, 1)
    for n in HARMONICS:
        cosine, sine = waves[n]
        away += sp.Matrix([p[f"c_{k}{n}"] * cosine + p[f"s_{k}{n}"] * sine for k in "xyz"])
    d = c.tape.let_each("run_out", away)
    velocity = c.tape.let_each("run_out_velocity", d.applyfunc(c.rate))
    m = c.motion
    return stages.gradient(m) * d + 2 * m.omega.cross(velocity) + velocity.applyfunc(c.rate)


EFFECT = Effect(
    id="bearing-run-out",
    title="Run-out of the bearing",
    physics=(
        "Races and balls of the spin bearing are not round: the disc's centre moves on a small closed path with every turn, and its "
        "acceleration acts on all accelerometers alike."
    ),
    source="synchronous run-out of precision spindle bearings (ISO 230-7): below a micrometre",
    equation=(
        r"\bm f \mathrel{+}= \ddot{\bm d} + 2\bm\omega\times\dot{\bm d} + \bm M\bm d,\;"
        r" \bm d = \sum_{n=1}^2 \bm c_n \cos n\phi + \bm s_n \sin n\phi"
    ),
    limits=(
        "Once and twice a turn, without tilt (else spin-axis-wobble), along axes that do not turn. What turns with the disc once a turn "
        "is a constant force there, absorbed by null biases. phi is the true angle."
    ),
    parameters=tuple(
        shared(f"{a}_{k}{n}", f"{a}_{{{k}{n}}}", "um", f"{word} of harmonic {n} along {k}", 1.0)
        for n in HARMONICS
        for k in "xyz"
        for a, word in (("c", "cosine"), ("s", "sine"))
    ),
    field=field,
)
