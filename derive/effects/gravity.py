"""Gradients of masses around the disc."""

from __future__ import annotations

from functools import cache

import sympy as sp

from derive.context import Context
from derive.effect import Effect, Values, shared, shared_components
from derive.stages import Motion, turn
from derive.symbols import TRACELESS, traceless


def gradient_offset(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(Gamma=m.Gamma + traceless(p, "G_{}"))


GRADIENT_OFFSET = Effect(
    id="gradient-offset",
    title="Gradient of masses at rest around the disc",
    physics=(
        "Housing, gimbals and counterweights that do not turn with the disc attract it with a constant gradient, which is not in the "
        "recorded gradients."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G",
    limits=(
        "Constant, at rest in the measurement frame. A well-made instrument responds only to G_xx - G_yy and G_xy; any other constant "
        "signal at twice the spin rate looks the same, for example that of rectified vibration."
    ),
    parameters=shared_components("G", TRACELESS, "Eo", "constant gradient {k}", 100.0),
    sensing=gradient_offset,
)


def fuel_gradient(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(Gamma=m.Gamma + c.channel("fuel_mass") * traceless(p, "G_{}"))


FUEL_GRADIENT = Effect(
    id="fuel-gradient",
    title="Gradient of the fuel",
    physics="The fuel in the carrier's tanks attracts the instrument, and decreases during the flight.",
    source="3 G m / r^3: a ton at three metres is 7 Eo",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G\, m_{fuel}(t)",
    limits=(
        "Fuel at one place, or tanks that empty in proportion; the carrier keeps its attitude (else self-gradient). A mass that does not "
        "change looks like gradient-offset."
    ),
    channels=("fuel_mass",),
    parameters=shared_components("G", TRACELESS, "Eo/kg", "gradient {k} per mass of fuel", 0.01),
    sensing=fuel_gradient,
)


ATTITUDE = ("roll", "pitch")


def self_gradient(m: Motion, p: Values, c: Context) -> Motion:
    own = (sp.sin(c.channel(angle)) * traceless(p, f"G_{{}}_{angle}") for angle in ATTITUDE)
    return m._replace(Gamma=sum(own, m.Gamma))


SELF_GRADIENT = Effect(
    id="self-gradient",
    title="Self-gradient of the platform",
    physics=(
        "The masses of aircraft and gimbals move around the stabilised instrument as the carrier rolls and pitches; their gravity "
        "gradient changes with the attitude."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G_{roll} \sin(roll) + \bm G_{pitch} \sin(pitch)",
    limits=(
        "First harmonic of small attitude angles; masses fixed to one rigid carrier, and its fuel, are carrier-gradient. Parts that move "
        "with the instrument have a constant gradient and no effect. Without roll, or pitch, in the record its five values are omitted."
    ),
    channels=ATTITUDE,
    either=True,
    parameters=tuple(
        shared(
            f"G_{k}_{angle}",
            rf"G_{{{k},\mathrm{{{angle}}}}}",
            "Eo/rad",
            f"gradient {k} per sine of {angle}",
            100.0,
            channel=angle,
        )
        for angle in ATTITUDE
        for k in TRACELESS
    ),
    sensing=self_gradient,
)


_MEANING = {
    "G_d": "half of the difference of xx and yy",
    "G_xy": "component xy",
    "G_xz": "component xz",
    "G_yz": "component yz",
}


def self_gradient_yaw(m: Motion, p: Values, c: Context) -> Motion:
    yaw = c.channel("yaw")
    cosine, sine = c.tape.let("cos_yaw", sp.cos(yaw)), c.tape.let("sin_yaw", sp.sin(yaw))
    turn = sp.Matrix([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    at_rest = sp.Matrix([[p.G_d, p.G_xy, p.G_xz], [p.G_xy, -p.G_d, p.G_yz], [p.G_xz, p.G_yz, 0]])
    return m._replace(Gamma=m.Gamma + turn * at_rest * turn.T - at_rest)


SELF_GRADIENT_YAW = Effect(
    id="self-gradient-yaw",
    title="Self-gradient of a carrier that yaws",
    physics=(
        "The stabilised instrument keeps its heading while the carrier turns around it: the gradient of the carrier's masses turns with "
        "it, through the whole circle from line to line."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=(r"\bm\Gamma \leftarrow \bm\Gamma + \bm R_z(yaw)\,\bm G\,\bm R_z(yaw)^T - \bm G"),
    limits=(
        "Masses fixed to the carrier, which keeps level (else self-gradient). What is symmetric about the vertical, and the gradient at "
        "yaw 0, are constant: gradient-offset."
    ),
    channels=("yaw",),
    parameters=tuple(
        shared(name, f"G_{{{name[2:]}}}", "Eo", f"gradient of the carrier at yaw 0: {meaning}", 30.0)
        for name, meaning in _MEANING.items()
    ),
    sensing=self_gradient_yaw,
)


def carrier_gradient(m: Motion, p: Values, c: Context) -> Motion:
    attitude = sp.eye(3)
    for n, angle in zip((2, 1, 0), ("yaw", "pitch", "roll"), strict=True):
        attitude = attitude * turn(sp.eye(3)[:, n], c.channel(angle), None)
    R = sp.Matrix(3, 3, lambda i, k: c.tape.let(f"attitude_{'xyz'[i]}{'xyz'[k]}", attitude[i, k]))

    level, fuel = traceless(p, "G_{}"), traceless(p, "F_{}") * c.channel("fuel_mass")
    return m._replace(Gamma=m.Gamma + R * (level + fuel) * R.T - level)


CARRIER_GRADIENT = Effect(
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
        "Masses fixed to the carrier, fuel at one place. Angles that are not recorded, or fuel, count as zero. The level carrier is "
        "gradient-offset, its fuel fuel-gradient; to first order in small angles it is a self-gradient of five values instead of ten, "
        "for rotation about the vertical only it is self-gradient-yaw."
    ),
    channels=("roll", "pitch", "yaw"),
    either=True,
    parameters=(
        *shared_components("G", TRACELESS, "Eo", "gradient {k} of the level carrier", 100.0),
        *shared_components(
            "F", TRACELESS, "Eo/kg", "gradient {k} of fuel, per mass", 0.01, channel="fuel_mass"
        ),
    ),
    sensing=carrier_gradient,
)


INDEPENDENT = ("xxx", "xxy", "xxz", "xyy", "xyz", "yyy", "yyz")
FOURTH = ("xxxx", "xxxy", "xxxz", "xxyy", "xxyz", "xyyy", "xyyz", "yyyy", "yyyz")


def component(p: Values, *axes: str) -> sp.Expr:
    """T_abc or T_abcd, symmetric in its indices and without trace: T_xxc + T_yyc + T_zzc = 0."""
    name = "".join(sorted(axes))
    if name.endswith("zz"):
        others = name[:-2]
        return -(component(p, "x", "x", *others) + component(p, "y", "y", *others))
    return p[f"T_{name}"]


def near_mass(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    # Gravity that grows with r is a specific force of the other sign.
    r = c.in_measurement_frame(r)

    @cache
    def along(axes: str) -> sp.Expr:
        return r.dot(sp.Matrix(3, 3, [component(p, *axes, a, b) for a in "xyz" for b in "xyz"]) * r)

    second = {k: along(k) / 2 for k in "xyz"}
    third = {
        k: sp.Add(*(r["xyz".index(j)] * along("".join(sorted(k + j))) for j in "xyz")) / 6 for k in "xyz"
    }
    return c.in_disc_frame(sp.Matrix([-second[k] - third[k] for k in "xyz"]))


NEAR_MASS = Effect(
    id="near-mass",
    title="Near mass",
    physics="The gradient of a mass close to the instrument changes across the disc; Eq. 10 assumes it uniform.",
    source="Taylor series of the gravity field, continued from paper, Eq. 10",
    equation=r"\bm f_j \mathrel{-}= \tfrac12\, T_{abc}\, r_b r_c + \tfrac16\, T_{abcd}\, r_b r_c r_d",
    limits=(
        "Constant tensors, fixed in the measurement frame, two orders beyond the gradient: the mass is farther than a few radii of the "
        "disc. The first is even in r, so that opposite accelerometers cancel it up to their mismatch; the second adds up, at twice the "
        "spin rate, where it looks like a constant gradient, and at four times it."
    ),
    parameters=(
        *shared_components("T", INDEPENDENT, "Eo/m", "third derivative {k} of the potential", 10.0),
        *shared_components("T", FOURTH, "Eo/m^2", "fourth derivative {k} of the potential", 30.0),
    ),
    field=near_mass,
)
