from derive.effect import Effect, EffectParameter
from derive.hooks import following, warmth

EFFECT = Effect(
    id="thermal-misalignment",
    title="Temperature coefficient of the misalignment",
    physics="Glue, screws and frames of unlike metals turn an accelerometer on its mount as the instrument warms.",
    source=(
        "LISA Pathfinder, arXiv:2407.05852: angles of an optical bench follow its temperature, 30 microradians per kelvin; "
        "IEEE Std 1293, input-axis misalignment"
    ),
    equation=r"\vartheta_y \leftarrow \vartheta_y + \partial_T \vartheta_y (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature, without the lag of heat flow; where a_z hardly changes it is thermal-bias. vartheta_z puts "
        "the radial force on the input axis, which is the neighbours' input: in G_out it is their thermal-scale. beta_x and beta_z "
        "differ from the two in gradients only; the growing radius, 20 ppm/K, is below 0.1 Eo/K in 3000 Eo."
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
    instrument=following("vartheta_y", "dvartheta_y_dT", warmth),
)
