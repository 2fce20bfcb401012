from derive.effect import Context, Effect, Expr, SensedForce, Values, shared


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    return i + p.b * c.rate(c.rate(i))


EFFECT = Effect(
    id="output-filter",
    title="Filter of the output",
    physics=(
        "Before it is recorded, G_out is averaged or low-passed. If the filter's delay has been corrected, its droop remains: it "
        "attenuates the harmonics of the spin more than slow signals."
    ),
    source=(
        "Taylor series of a low-pass of linear phase: b is a 24th of the square of the averaging interval (1.6e-4 s^2 "
        "for a sixteenth of a second), or half the square of a first-order filter's time constant"
    ),
    equation=r"G_{out} \leftarrow G_{out} + b\,\ddot G_{out}",
    limits=(
        "First order in b, for signals slow against the filter; b is positive. The delay itself is time-offset, except for the disc "
        "angle's part, which beta_z absorbs."
    ),
    parameters=(shared("b", "b", "s^2", "curvature of the filter's response at low frequencies", 1e-6),),
    transducer=transducer,
)
