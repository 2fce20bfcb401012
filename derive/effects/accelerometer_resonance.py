import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values
from derive.hooks import RESONANCE, response
from derive.stages import NOMINAL_TRIAD
from derive.symbols import COS_J, SIN_J


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    axes = NOMINAL_TRIAD.T if c.turn_of_triad is None else c.turn_of_triad * NOMINAL_TRIAD.T
    k = c.parameters
    axis = axes[:, 0] + k["vartheta_z"] * axes[:, 1] - k["vartheta_y"] * axes[:, 2]

    def along_input(kind: str) -> sp.Expr:
        radial, tangential = (response(f"{kind}_{n}", p, c, RESONANCE) for n in ("radial", "tangential"))
        r, t = COS_J * radial + SIN_J * tangential, COS_J * tangential - SIN_J * radial
        r, t = r + k["beta_z"] * t, t - k["beta_z"] * r
        return axis.dot(sp.Matrix([r, t, response(f"{kind}_axial", p, c)]))

    return i - p.u * along_input("rate") - p.v * along_input("curvature")


EFFECT = Effect(
    id="accelerometer-resonance",
    title="Resonance of an accelerometer",
    physics=(
        "The mount of an accelerometer, or its rebalance loop, resonates: force along its input axis, which turns with the disc, is "
        "amplified and delayed near the resonance."
    ),
    source="closed-loop response of second order (IEEE Std 1293, frequency response); of a mount as mount-resonance",
    equation=(
        r"V_j \leftarrow V_j - \frac{u_j s + v_j s^2}{1 + d s + b s^2} f_i,\; b = (2\pi f_0)^{-2},\; d = (2\pi f_0 Q)^{-1}"
    ),
    limits=(
        "One frequency and Q for all accelerometers. A loop has u = d and v = b, a mount u = 0 and v = b, a mode a share of them. "
        "For a resonance far above the spin rate and the motion, u and v are lag and second-order-loop; for motion slow against the spin "
        "rate the latter is arm-stretch, but for a scale factor. The response to gradients, a "
        "millionth, is neglected, and the first seconds of a record are excluded. A diagnosis does not look for it (of 720 "
        "simulated flights five had another effect and got this name, two had it), but compares it with its special cases where one is "
        "claimed."
    ),
    parameters=(
        EffectParameter("u", "u", "s", "first order of what the resonance takes away", 1e-8),
        EffectParameter("v", "v", "s^2", "second order of what the resonance takes away", 1e-8),
        *RESONANCE,
    ),
    transducer=transducer,
    memory="accelerometer",
    searched=False,
    contains=("arm-stretch", "lag", "second-order-loop"),
)
