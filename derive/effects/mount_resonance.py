import sympy as sp

from derive.effect import Context, Effect, Motion, Values, shared
from derive.hooks import RESONANCE, response


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    def through(name: str, v: sp.Matrix) -> sp.Matrix:
        further = [response(f"mount_{name}_{k}", p, c, RESONANCE if name == "a" else ()) for k in "xyz"]
        return v + p.share * sp.Matrix(further)

    return m._replace(
        a=through("a", m.a), omega=through("omega", m.omega), omegadot=through("omegadot", m.omegadot)
    )


EFFECT = Effect(
    id="mount-resonance",
    title="Resonance of the mount",
    physics=(
        "Isolators or a frame connect the motion sensor and the disc: spring and damper transmit slow motion unchanged, amplify it near "
        "their resonance, and isolate faster motion."
    ),
    source="transmissibility of a mass on spring and damper (D. J. Ewins, Modal Testing, 2000; ISO 2041)",
    equation=(
        r"\bm a = \bm a_{rec} + \kappa (H - 1)\,\bm a_{rec},\; H = \frac{1 + d s}{1 + d s + b s^2},\;"
        r" b = (2\pi f_0)^{-2},\; d = (2\pi f_0 Q)^{-1};\; \bm\omega, \dot{\bm\omega} \text{ likewise}"
    ),
    limits=(
        "One resonance, equal along all axes; kappa is 1 where it carries the whole disc, less for the share of a mode. For f_0 far "
        "above the motion only kappa/f_0^2 matters, as imu-filter; Q matters where the motion is near f_0. The record is assumed to "
        "begin at rest, and its first seconds are excluded."
    ),
    parameters=(
        shared("share", r"\kappa", "1", "share of the motion that passes the resonance", 1.0),
        *RESONANCE,
    ),
    sensing=sensing,
    memory="mount",
    contains=("imu-filter",),
)
