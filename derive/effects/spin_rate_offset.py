from derive.effect import Context, Effect, Expr, Values, shared


def disc_angle(p: Values, c: Context) -> Expr:
    return p.epsilon * c.Omega * c.time


EFFECT = Effect(
    id="spin-rate-offset",
    title="Offset of the spin rate",
    physics=(
        "The clock of the spin servo and that of the recorder differ, or the encoder's turns are counted at a wrong "
        "rate: the true disc angle departs steadily from the recorded one."
    ),
    source="frequency accuracy of quartz oscillators (IEEE Std 1139): 1e-8 with an oven, 1e-5 without",
    equation=r"\phi \leftarrow \phi + \epsilon\,\Omega\,t",
    limits=(
        "Steady over the record, from the instant 0 of its time column (another one is spin-phase-offset). With a "
        "steady horizontal force it looks like a drift of scale factors and misalignments."
    ),
    parameters=(shared("epsilon", r"\epsilon", "1", "true spin rate over the believed one, less one", 1e-7),),
    disc_angle=disc_angle,
)
