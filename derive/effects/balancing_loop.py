from derive.effect import Context, Effect, EffectParameter, Parameters, Values


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    return {
        "K1": k["K1"] * (1 + p.dK1_di * c.channel("balance_current")),
        "K2": k["K2"] + p.dK2_di * c.channel("second_order_current"),
    }


EFFECT = Effect(
    id="balancing-loop",
    title="Balancing loops of scale factors and second-order coefficients",
    physics=(
        "Loops demodulate the output at the spin frequency and its double, integrate the result, and change scale factors, others "
        "second-order coefficients, by a current until it vanishes: while they run a calibration holds only with these currents."
    ),
    source="US 5922951; Sensors 17, 1710 (2017); Sensors 18, 1247 (2018): k' = -gamma LP[G_out sin(phi + ...)]",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_i K_1\, i_1(t)),\; K_2 \leftarrow K_2 + \partial_i K_2\, i_2(t)",
    limits=(
        "Each kind of loop has its current recorded, in one channel; an unrecorded one counts as zero. Coefficients are linear in it. "
        "Without it a settling loop looks like gain-drift or second-order-drift, and one that runs on is a walk of K1 or K2 "
        "(`ragg calibrate --drift`); a stopped loop has no effect."
    ),
    channels=("balance_current", "second_order_current"),
    either=True,
    parameters=(
        EffectParameter(
            "dK1_di",
            r"\partial_i K_1",
            "1/A",
            "relative scale factor per current of its loop",
            1e-3,
            channel="balance_current",
        ),
        EffectParameter(
            "dK2_di",
            r"\partial_i K_2",
            "ug/g^2/A",
            "change of K2 per current of its loop",
            1e3,
            channel="second_order_current",
        ),
    ),
    instrument=instrument,
)
