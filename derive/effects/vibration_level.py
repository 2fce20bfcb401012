from derive.effect import Context, Effect, Expr, SensedForce, Values, components
from derive.hooks import rectified
from derive.symbols import COMPONENTS, symmetric


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    level = c.channel("vibration_rms")
    L = symmetric(p, "L")
    return i + level**2 * rectified(L, c)


EFFECT = Effect(
    id="vibration-level",
    title="Rectified vibration of a recorded level",
    physics=(
        "Vibration above the recorder's bandwidth varies with engine power and air; its level is recorded, and second-order "
        "coefficients rectify it into a force that follows the square of that level."
    ),
    source="IEEE Std 1293, vibration rectification; a vibration meter's root mean square",
    equation=r"\bm P(t) = \bm L\, v(t)^2, \text{ in the place of the constant } \bm P \text{ of vibration-rectification}",
    limits=(
        "As vibration-rectification; the vibration keeps its directions and shares while its level changes. What is "
        "constant is vibration-rectification."
    ),
    channels=("vibration_rms",),
    parameters=components("L", COMPONENTS, "1", "covariance {k} over the square of the level", 1.0),
    transducer=transducer,
)
