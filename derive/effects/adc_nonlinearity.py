import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + p.h * sp.sign(i)


EFFECT = Effect(
    id="adc-nonlinearity",
    title="Nonlinearity of the converters",
    physics=(
        "Where an accelerometer's voltage passes through zero all bits of a converter change at once; they do not match, "
        "and its characteristic has a step there."
    ),
    source="IEEE Std 1241: major-carry transition, the largest error of a binary-weighted converter",
    equation=r"V_j \leftarrow V_j + h_j\,\mathrm{sign}(V_j)",
    limits=(
        "A converter for each accelerometer, its step at zero and of no width. A smooth bend of the characteristic is "
        "cubic-input or K2; finite steps are quantisation. A fit with it excludes samples so close to zero that their side is "
        "uncertain."
    ),
    parameters=(EffectParameter("h", "h", "ug", "half the height of the step", 0.01),),
    transducer=transducer,
    switches=True,
)
