"""Stage 2: the disc angle, the spin axis, the arms and the mounts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.effects import Injected, memory
from ragg_runtime.reference.effects.transducer import follow
from ragg_runtime.reference.geometry import Taylor, by_vector, stack

Array = NDArray[np.float64]
Kinematics: TypeAlias = Literal["platform", "full"]


def disc_angle(nominal: Taylor, time: Array, error: Array, effects: Injected) -> Taylor:
    """True angle of the disc where the model believes ``nominal`` (N,) rad; ``error`` is the random part."""
    phi = nominal
    if offset := effects.get("spin-phase-offset"):
        phi = phi + offset["phi_0"]
    if fast := effects.get("spin-rate-offset"):
        gained = fast["epsilon"] * nominal.first
        phi = phi + Taylor(gained * time, gained, np.zeros_like(gained))
    if encoder := effects.get("encoder-harmonic"):
        for n in (1, 2, 3, 4):
            turned = nominal * float(n)
            phi = phi + turned.cosine() * encoder[f"c_{n}"] + turned.sine() * encoder[f"s_{n}"]
    return phi + error


def run_out(phi: Taylor, effects: Injected) -> Taylor | None:
    """Where the disc's centre is, (3, N) m along axes that do not turn with it, or None."""
    path = effects.get("bearing-run-out")
    if path is None:
        return None
    waves = {(a, n): w for n in (1, 2) for a, w in (("c", (phi * n).cosine()), ("s", (phi * n).sine()))}

    def along(k: str) -> Taylor:
        return sum((wave * float(path[f"{a}_{k}{n}"]) for (a, n), wave in waves.items()), 0.0 * phi)

    return stack((along("x"), along("y"), along("z")))


def random_angle(rng: np.random.Generator, size: int, rate: float, effects: Injected) -> Array:
    """Angle error of ``spin-rate-jitter`` at ``size`` samples, rad: white, plus a random walk from zero."""
    jitter = effects.get("spin-rate-jitter")
    if jitter is None or size == 0:
        return np.zeros(size)
    white, steps = rng.standard_normal((2, size))
    steps[0] = 0.0
    angle: Array = jitter["sigma_phi"] * white + jitter["sigma_walk"] / np.sqrt(rate) * np.cumsum(steps)
    return angle


def lean(effects: Injected, effect: str, name: str) -> Array | None:
    """Lean of the whole disc, (3, 3), or None: constant in the measurement frame, or (``wobble``) about axes that turn with it."""
    about = effects.get(effect)
    return None if about is None else by_vector(np.array([about[f"{name}_x"], about[f"{name}_y"], 0.0]))


def spin_share(kinematics: Kinematics, effects: Injected) -> float:
    """Share of the disc's own rotation that the accelerometers sense: all of it in full kinematics."""
    effect = effects.get("disc-spin")
    if kinematics == "full" and effect is not None:
        raise UserError(
            "the effect 'disc-spin' is in an instrument of full kinematics already",
            remedy='leave it out, or simulate with kinematics = "platform"',
        )
    return 1.0 if kinematics == "full" else 0.0 if effect is None else float(effect["share"])


def bends(j: int, effects: Injected) -> bool:
    """Whether accelerometer j's radius depends on its specific force."""
    return any(
        effect in effects and effects[effect][name][j] != 0
        for effect, name in (("arm-stretch", "c_r"), ("arm-sag", "c_z"))
    )


def arm_length(j: int, radius: float, f: tuple[Array, Array, Array], effects: Injected) -> Array:
    """Radius of accelerometer j under the specific force f_x, f_y, f_z, (N,) m."""
    length = np.full(f[0].shape, radius)
    if stretch := effects.get("arm-stretch"):
        length = length + stretch["c_r"][j] * f[1]
    if sag := effects.get("arm-sag"):
        length = length + sag["c_z"][j] * f[2]
    return length


Angle: TypeAlias = Array | float


def misalignment(
    j: int,
    angles: tuple[float, float, float],
    f: tuple[Array, Array, Array],
    time: Array,
    auxiliaries: Mapping[str, Array],
    effects: Injected,
) -> tuple[Angle, Angle, Angle]:
    """Misalignment angles of accelerometer j under the specific force f_x, f_y, f_z, rad."""
    about_y: Angle = sum(follow("vartheta_y", j, time, auxiliaries, effects), angles[1])
    about_z: Angle = angles[2]
    if play := effects.get("mount-hysteresis"):
        x, z = (auxiliaries[memory.friction("mount-hysteresis", j, n)] for n in (0, 2))
        about_y = about_y + play["e_yx"][j] * x + play["e_yz"][j] * z
        about_z = about_z + play["e_zx"][j] * x
    if flow := effects.get("mount-creep"):
        e = {name: value[j] for name, value in flow.items() if name != "tau"}
        x, z = (auxiliaries[memory.friction("mount-creep", j, n)] for n in (0, 2))
        former = auxiliaries[memory.former("mount-creep")]
        about_y = about_y + e["e_yx"] * x + e["e_yz"] * z + e["e_y0"] * former
        about_z = about_z + e["e_zx"] * x + e["e_z0"] * former
    if compliance := effects.get("mount-compliance"):
        c = {name: value[j] for name, value in compliance.items()}
        about_y = about_y + c["c_yx"] * f[0] + c["c_yy"] * f[1] + c["c_yz"] * f[2]
        about_z = about_z + c["c_zx"] * f[0] + c["c_zy"] * f[1] + c["c_zz"] * f[2]
    return angles[0], about_y, about_z
