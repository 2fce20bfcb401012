from derive.effect import Context, Effect, Expr, SensedForce, Values, shared
from derive.hooks import T_STEP, begun


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    return i * (1 + p.g * begun(p, c))


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
        shared("g", "g", "1", "relative step of the output's gain", 1e-4),
        T_STEP,
    ),
    transducer=transducer,
)
