from derive.effect import Context, Effect, Motion, Values, components
from derive.symbols import TRACELESS, traceless


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(Gamma=m.Gamma + traceless(p, "G_{}"))


EFFECT = Effect(
    id="gradient-offset",
    title="Gradient of masses at rest around the disc",
    physics=(
        "Housing, gimbals and counterweights that do not turn with the disc attract it with a constant gradient, which is not in the "
        "recorded gradients."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G",
    limits=(
        "Constant, at rest in the measurement frame. A well-made instrument responds only to G_xx - G_yy and G_xy; any other constant "
        "signal at twice the spin rate looks the same, for example that of rectified vibration."
    ),
    parameters=components("G", TRACELESS, "Eo", "constant gradient {k}", 100.0),
    sensing=sensing,
)
