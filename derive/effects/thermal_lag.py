from derive.effect import Context, Effect, EffectParameter, Parameters, Values


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    warming = c.channel("d_temperature")
    return {"K0": k["K0"] + p.dK0_dTdot * warming, "K1": k["K1"] * (1 + p.dK1_dTdot * warming)}


EFFECT = Effect(
    id="thermal-lag",
    title="Temperature rate and thermal lag",
    physics=(
        "While the instrument warms, gradients of temperature strain the accelerometers, and their own temperature "
        "lags behind that of the sensor: bias and scale factor follow the rate of the recorded temperature."
    ),
    source="IEEE Std 1293, thermal gradients and transients; first order of heat flow, T(t - tau) = T - tau dT/dt",
    equation=(
        r"K_0 \leftarrow K_0 + \partial_{\dot T} K_0\,\dot T,\;"
        r" K_1 \leftarrow K_1 (1 + \partial_{\dot T} K_1\,\dot T)"
    ),
    limits=(
        "A lag that is short against the changes of the temperature: a coefficient dK_dT then gives dK_dTdot = -tau dK_dT."
    ),
    channels=("temperature",),
    parameters=(
        EffectParameter("dK0_dTdot", r"\partial_{\dot T} K_0", "ug/(K/min)", "bias per rate of warming", 1.0),
        EffectParameter(
            "dK1_dTdot",
            r"\partial_{\dot T} K_1",
            "1/(K/min)",
            "relative scale factor per rate of warming",
            1e-6,
        ),
    ),
    instrument=instrument,
)
