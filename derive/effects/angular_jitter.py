import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components
from derive.symbols import COMPONENTS, symmetric


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    W = symmetric(p, "W")
    # the mean of w x (w x r) is (W - tr W) r, and M holds -Gamma
    return m._replace(Gamma=m.Gamma - c.channel("angular_vibration_rms") ** 2 * (W - W.trace() * sp.eye(3)))


EFFECT = Effect(
    id="angular-jitter",
    title="Unrecorded angular jitter",
    physics=(
        "Angular vibration faster than the recorded rate averages to zero, but its squares do not: the centrifugal "
        "force of the jitter is a gradient that grows with the square of its level."
    ),
    source="paper, Eq. 9: the square of the angular rate; levels of 1e-4 rad/s, 10 Eo, on stabilised platforms",
    equation=r"\langle[\bm\omega]_\times^2\rangle \mathrel{+}= (\bm W - \operatorname{tr}\bm W)\, w(t)^2",
    limits=(
        "Zero mean, fast against the turn of the disc, with constant directions; the level is recorded. A level that does "
        "not change looks like gradient-offset."
    ),
    channels=("angular_vibration_rms",),
    parameters=components(
        "W", COMPONENTS, "1", "covariance {k} of the rate over the square of the level", 1.0
    ),
    sensing=sensing,
)
