import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i * (1 + p.g * sp.Heaviside(c.time - p.t_step, 1))


EFFECT = Effect(
    id="output-gain-step",
    title="Step of the output's gain",
    physics="The amplifier or converter of G_out changes its gain at once: a range switch, a relay, a warm reference.",
    source="common fault of analogue front ends",
    equation=r"G_{out} \leftarrow G_{out} (1 + g\,[t \ge t_s])",
    limits=(
        "One step a record; its instant is scanned, not fitted. The same as gain-step of all four accelerometers at once."
    ),
    kind="step",
    parameters=(
        EffectParameter("g", "g", "1", "relative step of the output's gain", 1e-4, shared=True),
        EffectParameter("t_step", "t_s", "s", "instant of the step", 1.0, shared=True, fitted=False),
    ),
    transducer=transducer,
)
