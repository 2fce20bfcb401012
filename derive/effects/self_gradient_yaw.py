import sympy as sp

from derive.effect import Context, Effect, Motion, Values, shared

_MEANING = {
    "G_d": "half of the difference of xx and yy",
    "G_xy": "component xy",
    "G_xz": "component xz",
    "G_yz": "component yz",
}


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    yaw = c.channel("yaw")
    cosine, sine = c.tape.let("cos_yaw", sp.cos(yaw)), c.tape.let("sin_yaw", sp.sin(yaw))
    turn = sp.Matrix([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    at_rest = sp.Matrix([[p.G_d, p.G_xy, p.G_xz], [p.G_xy, -p.G_d, p.G_yz], [p.G_xz, p.G_yz, 0]])
    return m._replace(Gamma=m.Gamma + turn * at_rest * turn.T - at_rest)


EFFECT = Effect(
    id="self-gradient-yaw",
    title="Self-gradient of a carrier that yaws",
    physics=(
        "The stabilised instrument keeps its heading while the carrier turns around it: the gradient of the carrier's "
        "masses turns with it, through the whole circle from line to line."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=(r"\bm\Gamma \leftarrow \bm\Gamma + \bm R_z(yaw)\,\bm G\,\bm R_z(yaw)^T - \bm G"),
    limits=(
        "Masses fixed to the carrier, which keeps level (else self-gradient). What is symmetric about the vertical, and "
        "the gradient at yaw 0, are constant: gradient-offset."
    ),
    channels=("yaw",),
    parameters=tuple(
        shared(name, f"G_{{{name[2:]}}}", "Eo", f"gradient of the carrier at yaw 0: {meaning}", 30.0)
        for name, meaning in _MEANING.items()
    ),
    sensing=sensing,
)
