from derive.effect import Context, Effect, Expr, SensedForce, Values, shared


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    # a factor common to all voltages is a factor of their sum
    reading = c.channel("G_out")
    return i / (1 + p.c_2 * reading + p.c_3 * reading**2)


EFFECT = Effect(
    id="output-curve",
    title="Nonlinearity of the output's converter",
    physics=(
        "Amplifier and converter of G_out are nonlinear, with a quadratic and a cubic term. They act on the sum of the voltages, and so "
        "multiply forces on different accelerometers."
    ),
    source="IEEE Std 1241: integral nonlinearity; 1 to 10 parts in a million of the range at its end",
    equation=r"G_{out} + c_2 G_{out}^2 + c_3 G_{out}^3 \leftarrow G_{out}",
    limits=(
        "A smooth curve up to the third power. A test uses the predicted output, a program the recorded one. A step is "
        "adc-nonlinearity, the end of the range saturation; the curve of a single voltage is K2 and "
        "cubic-input of its accelerometer. Where the disc centre's force is all that moves the output, K2 ... K8 take c_2, "
        "and c_3 is one combination of cubic-input and cubic-cross."
    ),
    channels=("G_out",),
    parameters=(
        shared("c_2", "c_2", "1/V", "relative change of the gain per volt", 1e-7),
        shared("c_3", "c_3", "1/V^2", "relative change of the gain per square volt", 1e-9),
    ),
    transducer=transducer,
)
