"""Arms and mounts that are not as long, or not as stiff, as they are believed to be."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values, shared


def arm_length(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"dR": k["dR"] + p.delta_R}


ARM_LENGTH = Effect(
    id="arm-length",
    title="Arm length different from the test sheet",
    physics=(
        "All accelerometers sit farther from the axis than the test sheet's radius, or nearer, by one length: another drawing, a circle "
        "through the cases instead of the sensing elements, a diameter in place of a radius."
    ),
    source="paper, Eq. 5 to 9 (radius R of the disc)",
    equation=r"R_j \leftarrow R_j + \Delta R",
    limits=(
        "The error common to the four; individual errors are dR, which absorbs it where the sheet's radius is uncertain. In G_out it "
        "scales everything but the specific force, like a scale factor of the accelerometers."
    ),
    parameters=(shared("delta_R", r"\Delta R", "mm", "arms less the sheet's radius", 0.1, like="dR"),),
    instrument=arm_length,
)


def arm_stretch(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    assert c.force is not None
    return {"dR": k["dR"] + p.c_r * c.force.y}


ARM_STRETCH = Effect(
    id="arm-stretch",
    title="Elastic stretch of the arm",
    physics="The mount between disc and accelerometer yields to the specific force along the radius.",
    source="linear elasticity of the mount",
    equation=(
        r"R_j \leftarrow R_j + c_r f_y,\; \bm f_j \mathrel{+}= 2\,(\bm\omega_{im} + \dot\phi\,\bm e_z)"
        r" \times \dot R_j \bm e_r + \ddot R_j \bm e_r"
    ),
    limits=(
        "Linear, without resonance (that of an accelerometer is accelerometer-resonance, that of the disc's mount mount-resonance), with "
        "the force at the unstretched position. A steady horizontal force stretches and releases the arm once a turn: the Coriolis force "
        "on the stretching arm exceeds the effect of its length, and acts mostly like a scale factor."
    ),
    parameters=(EffectParameter("c_r", "c_r", "um/g", "stretch per radial specific force", 0.1),),
    instrument=arm_stretch,
)


def arm_sag(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    assert c.force is not None
    return {"dR": k["dR"] + p.c_z * c.force.z}


ARM_SAG = Effect(
    id="arm-sag",
    title="Sag of the arm",
    physics=(
        "The disc sags under the specific force along the spin axis; the bending shortens or lengthens the distance of the accelerometer "
        "from the centre."
    ),
    source="linear elasticity of the disc",
    equation=(
        r"R_j \leftarrow R_j + c_z f_z,\; \bm f_j \mathrel{+}= 2\,(\bm\omega_{im} + \dot\phi\,\bm e_z)"
        r" \times \dot R_j \bm e_r + \ddot R_j \bm e_r"
    ),
    limits=(
        "Linear, without resonance; f_z is along tau_z, which points down. Its tilt is mount-compliance. While the axial force changes, "
        "so does the radius, and the turning disc adds the Coriolis force of that velocity."
    ),
    parameters=(EffectParameter("c_z", "c_z", "um/g", "lengthening per axial specific force", 0.1),),
    instrument=arm_sag,
)


def mount_compliance(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    assert c.force is not None
    f = c.force
    return {
        f"vartheta_{a}": k[f"vartheta_{a}"] + p[f"c_{a}x"] * f.x + p[f"c_{a}y"] * f.y + p[f"c_{a}z"] * f.z
        for a in "yz"
    }


MOUNT_COMPLIANCE = Effect(
    id="mount-compliance",
    title="Elastic tilt of the mount",
    physics=(
        "The mount of an accelerometer bends under its own weight: its misalignment angles follow the specific force, so that force "
        "times force appears in the output."
    ),
    source="linear elasticity of the mount",
    equation=r"\vartheta_{y,z} \leftarrow \vartheta_{y,z} + \sum_k c_{(y,z)k} f_k,\; k = x, y, z",
    limits=(
        "Static and linear. To first order f_i gains (c_z. f) f_y - (c_y. f) f_z, which are second-order terms: K4 absorbs c_yx, K7 "
        "c_yz, K6 c_zx, K5 c_zy, and K8 c_yy and c_zz."
    ),
    parameters=tuple(
        EffectParameter(
            f"c_{a}{b}", f"c_{{{a}{b}}}", "rad/g", f"vartheta_{a} per specific force along {b}", 1e-6
        )
        for a in "yz"
        for b in "xyz"
    ),
    instrument=mount_compliance,
)
