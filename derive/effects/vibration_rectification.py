from derive.effect import Context, Effect, Expr, SensedForce, Values, components
from derive.hooks import rectified
from derive.symbols import COMPONENTS, symmetric


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    P = symmetric(p, "P")
    return i + rectified(P, c)


EFFECT = Effect(
    id="vibration-rectification",
    title="Rectified vibration",
    physics=(
        "Vibration above the recorder's bandwidth averages to zero in the linear terms, but its squares and products in the "
        "second-order terms leave a steady force that turns with the disc."
    ),
    source="IEEE Std 1293, vibration rectification, with the second-order terms of paper, Eq. 1",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_2 P_{ii} + K_5 P_{oo} + K_7 P_{pp} + K_4 P_{ip} + K_6 P_{io}"
        r" + K_8 P_{op},\; P_{ab} = \bm\tau_a^T \bm P \bm\tau_b"
    ),
    limits=(
        "Covariance constant over the record (else vibration-level), zero mean, fast against the turn of the disc; exact for Eq. 1, "
        "rectification by third-order terms is neglected. P must be positive semidefinite."
    ),
    parameters=components("P", COMPONENTS, "g^2", "covariance {k} of the unrecorded vibration", 1e-4),
    transducer=transducer,
)
