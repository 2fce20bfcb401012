import sympy as sp

from derive.effect import Context, Effect, Values, shared

HARMONICS = (1, 2, 3, 4)


def disc_angle(p: Values, c: Context) -> sp.Expr:
    increment = sp.Integer(0)
    for n in HARMONICS:
        cosine, sine = c.harmonic(n)
        increment += p[f"c_{n}"] * cosine + p[f"s_{n}"] * sine
    return increment


EFFECT = Effect(
    id="encoder-harmonic",
    title="Harmonic error of the encoder",
    physics=(
        "An eccentric encoder scale, or a drive torque that ripples with the turn, makes the true disc angle "
        "swing about the recorded one with the harmonics of the turn."
    ),
    source="eccentricity and ripple errors of rotary encoders",
    equation=r"\phi \leftarrow \phi + \sum_{n=1}^4 c_n \cos n\phi + s_n \sin n\phi",
    limits=(
        "Harmonics one to four; phi on the right is the recorded angle. The force of an uneven spin, R phi'', "
        "is in a model of full kinematics (or with disc-spin), with the true angle's derivatives: it acts on a disc that really swings, "
        "not on one that turns steadily behind an uneven encoder."
    ),
    parameters=tuple(
        shared(f"{a}_{n}", f"{a}_{n}", "rad", f"{word} of harmonic {n}", 1e-5)
        for n in HARMONICS
        for a, word in (("c", "cosine"), ("s", "sine"))
    ),
    disc_angle=disc_angle,
)
