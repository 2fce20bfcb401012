"""Parameters of the accelerometers that follow something, linearly: time, temperature, pressure, or an instant passed."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values, shared
from derive.stages import Motion, SensedForce

REFERENCE_KELVIN = sp.Rational(29315, 100)
"""Temperature at which the test sheet's values hold; another one is absorbed by them."""

REFERENCE_PASCAL = sp.Integer(101325)
"""Pressure at which they hold."""

INSTANT = shared("t_step", "t_s", "s", "instant of the step", 1.0, fitted=False)

Driver = Callable[[Values, Context], sp.Expr]
Instrument = Callable[[Mapping[str, sp.Expr], Values, Context], Mapping[str, sp.Expr]]


def elapsed(p: Values, c: Context) -> sp.Expr:
    """Time, s."""
    return c.time


def begun(p: Values, c: Context) -> sp.Expr:
    """1 from the instant ``t_step`` of the effect on, else 0."""
    return sp.Heaviside(c.time - p.t_step, 1)


def warmth(p: Values, c: Context) -> sp.Expr:
    """Temperature above that of the sheet, K."""
    return c.channel("temperature") - REFERENCE_KELVIN


def warming(p: Values, c: Context) -> sp.Expr:
    """Rate of the temperature, K/s."""
    return c.channel("d_temperature")


def overpressure(p: Values, c: Context) -> sp.Expr:
    """Pressure above that of the sheet, Pa."""
    return c.channel("pressure") - REFERENCE_PASCAL


def following(driver: Driver, **slopes: str) -> Instrument:
    """The hook of an effect whose parameters are the slopes by which parameters of the accelerometers follow; K1 relatively."""

    def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> Mapping[str, sp.Expr]:
        changes = {name: p[slope] * driver(p, c) for name, slope in slopes.items()}
        return {n: k[n] * (1 + change) if n == "K1" else k[n] + change for n, change in changes.items()}

    return instrument


BIAS_DRIFT = Effect(
    id="bias-drift",
    title="Drift of the null bias",
    physics="Stress in the hinge and charge on the pick-off relax after switch-on: the null bias creeps.",
    source="IEEE Std 1293, bias stability",
    equation=r"K_0 \leftarrow K_0 + \partial_t K_0\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by K0). Where they change steadily, "
        "thermal-bias, pressure-bias and magnetic-axial-bias look like it, as does inner-temperature that settles, and "
        "misalignment-drift where a_z hardly changes."
    ),
    parameters=(EffectParameter("dK0_dt", r"\partial_t K_0", "ug/s", "rate of the null bias", 1e-4),),
    instrument=following(elapsed, K0="dK0_dt"),
)


GAIN_DRIFT = Effect(
    id="gain-drift",
    title="Drift of the scale factor",
    physics="Magnet, sense resistor and converter age or warm: the scale factor creeps.",
    source="IEEE Std 1293, scale-factor stability",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_t K_1\, t)",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by K1). In G_out it is also a drift of "
        "the neighbours' vartheta_z. Where they change steadily, thermal-scale and a balancing-loop look like it, as do "
        "inner-temperature that settles and, with a steady horizontal force, spin-rate-offset."
    ),
    parameters=(
        EffectParameter("dK1_dt", r"\partial_t K_1", "1/s", "relative rate of the scale factor", 1e-9),
    ),
    instrument=following(elapsed, K1="dK1_dt"),
)


MISALIGNMENT_DRIFT = Effect(
    id="misalignment-drift",
    title="Drift of the misalignment",
    physics="Stress in screws and glue relaxes after assembly, transport or switch-on: an accelerometer creeps on its mount.",
    source="IEEE Std 1293, stability of the input-axis misalignment: some microradians a day",
    equation=r"\vartheta_y \leftarrow \vartheta_y + \partial_t \vartheta_y\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by vartheta_y); where a_z hardly changes "
        "it is bias-drift. vartheta_z puts the radial force on the input axis, which is the neighbours' input: in G_out it is their "
        "gain-drift. A growing radius acts on gradients only, and is neglected."
    ),
    parameters=(
        EffectParameter(
            "dvartheta_y_dt",
            r"\partial_t \vartheta_y",
            "urad/s",
            "rate of vartheta_y",
            1e-3,
            like="vartheta_y",
        ),
    ),
    instrument=following(elapsed, vartheta_y="dvartheta_y_dt"),
)


SECOND_ORDER_DRIFT = Effect(
    id="second-order-drift",
    title="Drift of the second-order coefficient",
    physics="Magnet and hinge age or warm: the curvature of an accelerometer's characteristic creeps with them.",
    source="IEEE Std 1293, stability of the model's coefficients",
    equation=r"K_2 \leftarrow K_2 + \partial_t K_2\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column. K5 of an accelerometer is K2 of its neighbours on the disc; "
        "under a steady weight the drifts of K4, K7 and K8 are gain-drift, bias-drift and misalignment-drift."
    ),
    parameters=(EffectParameter("dK2_dt", r"\partial_t K_2", "ug/g^2/s", "rate of K2", 1e-4, like="K2"),),
    instrument=following(elapsed, K2="dK2_dt"),
)


BIAS_STEP = Effect(
    id="bias-step",
    title="Step of the null bias, or of the output's offset",
    physics="A shock, a relay or a released strain shifts an accelerometer's null, or the offset of the output, at once.",
    source="IEEE Std 1293, bias stability; common fault of analogue front ends",
    equation=r"K_0 \leftarrow K_0 + \Delta K_0 [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. G_out depends on one combination of the four, which is also that of a "
        "step of the output's offset."
    ),
    kind="step",
    parameters=(EffectParameter("dK0", r"\Delta K_0", "ug", "step of the null bias", 0.01), INSTANT),
    instrument=following(begun, K0="dK0"),
)


GAIN_STEP = Effect(
    id="gain-step",
    title="Step of the scale factor",
    physics="A shock, a relay or a range switch changes the gain of an accelerometer's circuit at once.",
    source="common fault of analogue front ends",
    equation=r"K_1 \leftarrow K_1 (1 + \Delta K_1 [t \ge t_s])",
    limits=(
        "One step a record; its instant is scanned, not fitted. In G_out it is also a step of the neighbours' vartheta_z; of all four "
        "accelerometers at once output-gain-step."
    ),
    kind="step",
    parameters=(
        EffectParameter("dK1", r"\Delta K_1", "1", "relative step of the scale factor", 1e-6),
        INSTANT,
    ),
    instrument=following(begun, K1="dK1"),
)


MISALIGNMENT_STEP = Effect(
    id="misalignment-step",
    title="Step of the misalignment",
    physics="A shock moves an accelerometer on its mount, or a strained screw slips.",
    source="IEEE Std 1293, repeatability of the input-axis misalignment after shock: 1 to 100 microradians",
    equation=r"\vartheta_y \leftarrow \vartheta_y + \Delta\vartheta_y [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. Where a_z hardly changes it is bias-step; a step of vartheta_z is in "
        "G_out the gain-step of the neighbours on the disc."
    ),
    kind="step",
    parameters=(
        EffectParameter(
            "dvartheta_y", r"\Delta\vartheta_y", "urad", "step of vartheta_y", 1.0, like="vartheta_y"
        ),
        INSTANT,
    ),
    instrument=following(begun, vartheta_y="dvartheta_y"),
)


SECOND_ORDER_STEP = Effect(
    id="second-order-step",
    title="Step of the second-order coefficient",
    physics="A shock moves the pendulum's null position or the magnet: the curvature of an accelerometer's characteristic is another one.",
    source="IEEE Std 1293, repeatability of the model's coefficients after shock and over switch-on: 1 to 10 ug/g^2",
    equation=r"K_2 \leftarrow K_2 + \Delta K_2 [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. A step of K5 is that of K2 of the neighbours on the disc; under a steady "
        "weight steps of K4, K7 and K8 are gain-step, bias-step and misalignment-step."
    ),
    kind="step",
    parameters=(EffectParameter("dK2", r"\Delta K_2", "ug/g^2", "step of K2", 1.0, like="K2"), INSTANT),
    instrument=following(begun, K2="dK2"),
)


def output_gain_step(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i * (1 + p.g * begun(p, c))


OUTPUT_GAIN_STEP = Effect(
    id="output-gain-step",
    title="Step of the output's gain",
    physics="The amplifier or converter of G_out changes its gain at once: a range switch, a relay, a warm reference.",
    source="common fault of analogue front ends",
    equation=r"G_{out} \leftarrow G_{out} (1 + g\,[t \ge t_s])",
    limits="One step a record; its instant is scanned, not fitted. The same as gain-step of all four accelerometers at once.",
    kind="step",
    parameters=(shared("g", "g", "1", "relative step of the output's gain", 1e-4), INSTANT),
    transducer=output_gain_step,
)


THERMAL_BIAS = Effect(
    id="thermal-bias",
    title="Temperature coefficient of the null bias",
    physics="Hinge torque and pick-off null shift as the instrument warms.",
    source="IEEE Std 1293, bias temperature sensitivity",
    equation=r"K_0 \leftarrow K_0 + \partial_T K_0 (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature, without the lag of heat flow. Where the temperature changes steadily it is bias-drift, and where "
        "pressure or field change with it pressure-bias or magnetic-axial-bias; where a_z hardly changes thermal-misalignment acts alike."
    ),
    channels=("temperature",),
    parameters=(EffectParameter("dK0_dT", r"\partial_T K_0", "ug/K", "change of the null bias", 1.0),),
    instrument=following(warmth, K0="dK0_dT"),
)


THERMAL_SCALE = Effect(
    id="thermal-scale",
    title="Temperature coefficient of the scale factor",
    physics="The torquer magnet weakens and the sense resistor changes as the instrument warms.",
    source="IEEE Std 1293, scale-factor temperature sensitivity",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_T K_1 (T - 293.15\,\mathrm{K}))",
    limits=(
        "Linear in one temperature, without the lag of heat flow. Where the temperature changes steadily it is gain-drift; in G_out a "
        "change of the neighbours' vartheta_z acts alike."
    ),
    channels=("temperature",),
    parameters=(
        EffectParameter("dK1_dT", r"\partial_T K_1", "1/K", "relative change of the scale factor", 1e-6),
    ),
    instrument=following(warmth, K1="dK1_dT"),
)


THERMAL_MISALIGNMENT = Effect(
    id="thermal-misalignment",
    title="Temperature coefficient of the misalignment",
    physics="Glue, screws and frames of unlike metals turn an accelerometer on its mount as the instrument warms.",
    source=(
        "LISA Pathfinder, arXiv:2407.05852: angles of an optical bench follow its temperature, 30 microradians per kelvin; IEEE Std "
        "1293, input-axis misalignment"
    ),
    equation=r"\vartheta_y \leftarrow \vartheta_y + \partial_T \vartheta_y (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature, without the lag of heat flow; where a_z hardly changes it is thermal-bias. vartheta_z puts the "
        "radial force on the input axis, which is the neighbours' input: in G_out it is their thermal-scale. beta_x and beta_z differ "
        "from the two in gradients only; the growing radius, 20 ppm/K, is below 0.1 Eo/K in 3000 Eo."
    ),
    channels=("temperature",),
    parameters=(
        EffectParameter(
            "dvartheta_y_dT",
            r"\partial_T \vartheta_y",
            "urad/K",
            "change of vartheta_y",
            10.0,
            like="vartheta_y",
        ),
    ),
    instrument=following(warmth, vartheta_y="dvartheta_y_dT"),
)


THERMAL_SECOND_ORDER = Effect(
    id="thermal-second-order",
    title="Temperature coefficient of the second-order coefficient",
    physics=(
        "The causes of an accelerometer's curvature, the flux weakened by the torquer's own current and the hinge's compliance, change "
        "with temperature like bias and scale factor."
    ),
    source="IEEE Std 1293, temperature sensitivity of the model's coefficients: K2 by some per cent in ten kelvin",
    equation=r"K_2 \leftarrow K_2 + \partial_T K_2 (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature. K5 of an accelerometer is K2 of its neighbours on the disc, and K6 lies beside both. Where the "
        "pendulous axis carries a steady weight K4, K7 and K8 with temperature are thermal-scale, thermal-bias and thermal-misalignment."
    ),
    channels=("temperature",),
    parameters=(EffectParameter("dK2_dT", r"\partial_T K_2", "ug/g^2/K", "change of K2", 0.03, like="K2"),),
    instrument=following(warmth, K2="dK2_dT"),
)


THERMAL_LAG = Effect(
    id="thermal-lag",
    title="Temperature rate and thermal lag",
    physics=(
        "While the instrument warms, gradients of temperature strain the accelerometers, and their own temperature lags behind that of "
        "the sensor: bias and scale factor follow the rate of the recorded temperature."
    ),
    source="IEEE Std 1293, thermal gradients and transients; first order of heat flow, T(t - tau) = T - tau dT/dt",
    equation=(
        r"K_0 \leftarrow K_0 + \partial_{\dot T} K_0\,\dot T,\;"
        r" K_1 \leftarrow K_1 (1 + \partial_{\dot T} K_1\,\dot T)"
    ),
    limits="A lag that is short against the changes of the temperature: a coefficient dK_dT then gives dK_dTdot = -tau dK_dT.",
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
    instrument=following(warming, K0="dK0_dTdot", K1="dK1_dTdot"),
)


def imu_thermal(m: Motion, p: Values, c: Context) -> Motion:
    warmer = warmth(p, c)
    true = [(m.a[n] - p[f"db_{k}_dT"] * warmer) / (1 + p[f"ds_{k}_dT"] * warmer) for n, k in enumerate("xy")]
    return m._replace(a=sp.Matrix([*true, m.a[2]]))


IMU_THERMAL = Effect(
    id="imu-thermal",
    title="Temperature coefficients of the motion sensor's accelerometers",
    physics="Bias and scale factor of the motion sensor's accelerometers change as it warms, and what it reports with them.",
    source="IEEE Std 1293: 10 ug/K and 50 ppm/K (tactical grade) to 100 ug/K and 200 ppm/K (MEMS data sheets)",
    equation=(
        r"a_{k,rec} = a_k (1 + \partial_T s_k (T - 293.15\,\mathrm{K})) + \partial_T b_k (T - 293.15\,\mathrm{K})"
    ),
    limits=(
        "Linear in the temperature of the column, which is that of both instruments. The channel along the spin axis, to which no "
        "accelerometer should respond, is neglected. A changing scale factor of the motion sensor acts like that of all four "
        "accelerometers; its axes, which do not turn, distinguish it from thermal-scale."
    ),
    channels=("temperature",),
    parameters=tuple(
        shared(
            f"d{n}_{k}_dT", rf"\partial_T {n}_{k}", unit, f"change of the {word} along {k}", size, like=like
        )
        for n, unit, word, size, like in (
            ("b", "ug/K", "bias", 10.0, "K0"),
            ("s", "1/K", "scale", 1e-5, "K1"),
        )
        for k in "xy"
    ),
    sensing=imu_thermal,
)


PRESSURE_BIAS = Effect(
    id="pressure-bias",
    title="Pressure sensitivity of the null bias",
    physics="Air pressure strains case and hinge; buoyancy acts on the proof mass of an unsealed instrument.",
    source="IEEE Std 1293, pressure sensitivity of the bias",
    equation=r"K_0 \leftarrow K_0 + \partial_p K_0 (p - 101325\,\mathrm{Pa})",
    limits=(
        "Linear in one pressure, without the lag of a leaking seal. Where the pressure changes with temperature or time it looks like "
        "thermal-bias or bias-drift."
    ),
    channels=("pressure",),
    parameters=(EffectParameter("dK0_dp", r"\partial_p K_0", "ug/kPa", "change of the null bias", 0.1),),
    instrument=following(overpressure, K0="dK0_dp"),
)


def balancing_loop(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {
        "K1": k["K1"] * (1 + p.dK1_di * c.channel("balance_current")),
        "K2": k["K2"] + p.dK2_di * c.channel("second_order_current"),
    }


BALANCING_LOOP = Effect(
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
        "Without it a settling loop looks like gain-drift or second-order-drift, and one that runs on is a walk of K1 or K2 (`ragg "
        "calibrate --drift`); a stopped loop has no effect."
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
    instrument=balancing_loop,
)
