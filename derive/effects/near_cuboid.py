from derive.effect import Context, Effect, Motion, Values, components
from derive.effects.near_sphere import field
from derive.hooks import CHANNELS, MASS, PLACE, gradient_of_cuboid, gradient_of_point


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(Gamma=m.Gamma + gradient_of_cuboid(p, c) - gradient_of_point(p, c))


EFFECT = Effect(
    id="near-cuboid",
    title="Moving mass: a cuboid",
    physics=(
        "As near-sphere, of a homogeneous block: a stack of lead bricks, a battery, a tank. Nearer than a few of its edges it does not "
        "attract like a point."
    ),
    source="Newton's law; gradient tensor of a rectangular prism in closed form: Sensors 18, 4386 (2018); Sensors 21, 1925 (2021)",
    equation=(
        r"\text{as near-sphere, and } \bm\Gamma \mathrel{+}= G M\, \nabla\nabla (\int s^{-1}\, \mathrm d V/(l_x l_y l_z) - s^{-1})"
    ),
    limits=(
        "As near-sphere, with the edges l_x, l_y, l_z in model.toml, which are along the measurement axes and not fitted. What the shape "
        "adds to the gradient of a point counts as uniform across the disc: its error is the share (l R/s^2)^2."
    ),
    channels=CHANNELS,
    either=True,
    parameters=(
        MASS,
        *PLACE,
        *components("l", "xyz", "m", "its edge along {k}", 0.1, neutral=0.5, fitted=False, shape=True),
    ),
    field=field,
    sensing=sensing,
    searched=False,
)
