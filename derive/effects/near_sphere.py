"""Sphere, or point, beside the instrument that moves with recorded channels."""

import sympy as sp

from derive.attraction import CHANNELS, MASS, PLACE, of_point
from derive.context import Context
from derive.effect import Effect, Values


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
        r"\bm f_j \mathrel{-}= G M \nabla_{\bm r}\left(|\bm s - \bm r_j|^{-1} - |\bm s - \bm r|^{-1}_{\bm r = 0}\right),\;"
        r" \bm s = (x, y, z) + \bm s_{recorded}"
    ),
    limits=(
        "Added by name, not searched for, as its place has to be known within half a metre. Record the movement of the body "
        "along the measurement axes as mass_x, mass_y, mass_z in m (those that are not recorded count as 0); `ragg add near-sphere`; then "
        "give its entry in effects of model.toml the place at which they are 0, "
        '`x = { value = 1.2, unit = "m", fixed = true }`, y and z likewise: with fixed = true it stays as it is, without it is fitted; '
        "M likewise, if it is known. A body that does not move is a gradient-offset and a near-mass; one fixed to a turning carrier is "
        "carrier-gradient."
    ),
    channels=CHANNELS,
    either=True,
    parameters=(MASS, *PLACE),
    field=field,
    searched=False,
)
