import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + p.K_oq * f.i * sp.Abs(f.i)


EFFECT = Effect(
    id="odd-quadratic",
    title="Odd quadratic nonlinearity",
    physics=(
        "The torquer's flux changes with the current through it, oppositely for the two senses: a term of "
        "second order that keeps the sign of the force."
    ),
    source="IEEE Std 1293, odd quadratic coefficient of the model equation",
    equation=r"I_j/K_{j1} \mathrel{+}= K_{oq} f_i |f_i|",
    limits=(
        "f_i is the recorded force: unrecorded vibration is not rectified here. Where the force hardly changes its size it acts like "
        "cubic-input."
    ),
    parameters=(EffectParameter("K_oq", "K_{oq}", "ug/g^2", "coefficient of f_i |f_i|", 5.0, like="K2"),),
    transducer=transducer,
)
