import sympy as sp

from derive.effect import Context, Effect, Motion, Values, shared
from derive.symbols import TRACELESS, traceless

ATTITUDE = ("roll", "pitch")


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    gradients = (sp.sin(c.channel(angle)) * traceless(p, f"G_{{}}_{angle}") for angle in ATTITUDE)
    return m._replace(Gamma=sum(gradients, m.Gamma))


EFFECT = Effect(
    id="self-gradient",
    title="Self-gradient of the platform",
    physics=(
        "The masses of aircraft and gimbals move around the stabilised instrument as the carrier rolls and pitches; their gravity "
        "gradient changes with the attitude."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G_{roll} \sin(roll) + \bm G_{pitch} \sin(pitch)",
    limits=(
        "First harmonic of small attitude angles; masses fixed to one rigid carrier, and its fuel, are carrier-gradient. "
        "Parts that move with the instrument have a constant gradient and no effect. Without roll, or pitch, in the record its five "
        "values are omitted."
    ),
    channels=ATTITUDE,
    either=True,
    parameters=tuple(
        shared(
            f"G_{k}_{angle}",
            rf"G_{{{k},\mathrm{{{angle}}}}}",
            "Eo/rad",
            f"gradient {k} per sine of {angle}",
            100.0,
            channel=angle,
        )
        for angle in ATTITUDE
        for k in TRACELESS
    ),
    sensing=sensing,
)
