from derive.effect import Context, Effect, Parameters, Values, shared


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    return {"dR": k["dR"] + p.delta_R}


EFFECT = Effect(
    id="arm-length",
    title="Arm length different from the test sheet",
    physics=(
        "All accelerometers sit farther from the axis than the test sheet's radius, or nearer, by one length: another "
        "drawing, a circle through the cases instead of the sensing elements, a diameter in place of a radius."
    ),
    source="paper, Eq. 5 to 9 (radius R of the disc)",
    equation=r"R_j \leftarrow R_j + \Delta R",
    limits=(
        "The error common to the four; individual errors are dR, which absorbs it where the sheet's radius is uncertain. In G_out it "
        "scales everything but the specific force, like a scale factor of the accelerometers."
    ),
    parameters=(shared("delta_R", r"\Delta R", "mm", "arms less the sheet's radius", 0.1, like="dR"),),
    instrument=instrument,
)
