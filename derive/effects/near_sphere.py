import sympy as sp

from derive.effect import Context, Effect, Values
from derive.hooks import CHANNELS, MASS, PLACE, of_point


def field(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    # Attraction is a specific force of the other sign.
    return c.in_disc_frame(-of_point(p, c, c.in_measurement_frame(r)))


EFFECT = Effect(
    id="near-sphere",
    title="Moving mass: a sphere",
    physics=(
        "A body beside the instrument attracts it: a counterweight, a vehicle, a test mass on a rail. Where it moves, as recorded, the "
        "gradient changes with it, and across the disc."
    ),
    source="Newton's law; calibration by moving masses: Sensors 21, 1925 (2021); Sensors 18, 4386 (2018)",
    equation=(
        r"\bm f_j \mathrel{-}= G M (\nabla |\bm s - \bm r_j|^{-1} - \nabla |\bm s|^{-1}),\;"
        r" \bm s = (x, y, z) + \bm s_{recorded}"
    ),
    limits=(
        "Added by name, not searched for: its place has to be known within half a metre. Record its movement along the measurement axes as "
        "mass_x, mass_y, mass_z, m (what is not recorded counts as 0). List it in effects of model.toml with the place at which these are "
        '0, { id = "near-sphere", x = { value = 1.2, unit = "m", fixed = true }, y = ..., z = ... }: then `ragg add MODEL near-sphere '
        "FLIGHT` weighs it. Without fixed its place is fitted, too; a mass M that is known is listed likewise (`ragg calibrate`). A body "
        "that rests is a gradient-offset and a near-mass, one fixed to a turning carrier carrier-gradient."
    ),
    channels=CHANNELS,
    either=True,
    parameters=(MASS, *PLACE),
    field=field,
    searched=False,
)
