import sympy as sp

from derive.effect import Context, Effect, Values, shared
from derive.stages import spin_gradient


def field(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    return p.share * c.tape.let_each("spin", spin_gradient(c.motion, c.spin)) * r


EFFECT = Effect(
    id="disc-spin",
    title="Spin of the disc",
    physics=(
        "The accelerometers turn with the disc, whose angular rate is the platform's and the spin's together. "
        "Eq. 9 has the platform's rate only: it lacks the Coriolis force of the platform's rate and the spin, the "
        "centripetal force of the spin, and the Euler force of a spin that varies."
    ),
    source="rigid-body kinematics: paper, Eq. 9 and 49, with the rate of the disc instead of the platform's",
    equation=(
        r"\bm f_j \mathrel{+}= share\,[2\,\bm\omega_{im} \times (\dot\phi\,\bm e_z \times \bm r_j)"
        r" + \dot\phi^2\,\bm e_z \times (\bm e_z \times \bm r_j) + \ddot\phi\,\bm e_z \times \bm r_j]"
    ),
    limits=(
        "share is 0 (Eq. 9) or 1 (physical); nothing in between is physical. The centripetal force of a steady "
        "spin is constant, and absorbed by K0, K1, vartheta_y and vartheta_z. The rate is that of spin_angle, or "
        '2 pi spin_frequency where it is not recorded. A model with kinematics = "full" has all of it.'
    ),
    parameters=(shared("share", "share", "1", "share of the spin in the kinematics", 1.0, physical=1.0),),
    field=field,
    moot=lambda order, kinematics: kinematics == "full",
)
