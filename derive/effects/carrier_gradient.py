import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components
from derive.stages import turn
from derive.symbols import TRACELESS, traceless


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    attitude = sp.eye(3)
    for n, angle in zip((2, 1, 0), ("yaw", "pitch", "roll"), strict=True):
        attitude = attitude * turn(sp.eye(3)[:, n], c.channel(angle), None)
    R = c.tape.let_each("attitude", attitude)
    level, fuel = traceless(p, "G_{}"), traceless(p, "F_{}") * c.channel("fuel_mass")
    return m._replace(Gamma=m.Gamma + R * (level + fuel) * R.T - level)


EFFECT = Effect(
    id="carrier-gradient",
    title="Self-gradient of carrier and fuel",
    physics=(
        "The stabilised instrument keeps its attitude while the carrier turns around it: the gradient of its masses, and that of the "
        "remaining fuel, turn with roll, pitch and yaw as one rigid body."
    ),
    source="Sensors 19, 1950 (2019); US 11372130: self-gradient of a carrier from its attitude and fuel",
    equation=(
        r"\bm\Gamma \leftarrow \bm\Gamma + \bm R (\bm G + \bm F m_{fuel}) \bm R^T - \bm G,\;"
        r" \bm R = \bm R_z(yaw) \bm R_y(pitch) \bm R_x(roll)"
    ),
    limits=(
        "Masses fixed to the carrier, fuel at one place. Angles that are not recorded, or fuel, count as zero. The level "
        "carrier is gradient-offset, its fuel fuel-gradient; to first order in small angles it is a self-gradient of five "
        "values instead of ten, for rotation about the vertical only it is self-gradient-yaw."
    ),
    channels=("roll", "pitch", "yaw"),
    either=True,
    parameters=(
        *components("G", TRACELESS, "Eo", "gradient {k} of the level carrier", 100.0),
        *components("F", TRACELESS, "Eo/kg", "gradient {k} of fuel, per mass", 0.01, channel="fuel_mass"),
    ),
    sensing=sensing,
)
