from derive.effect import Context, Effect, Motion, Values, components
from derive.symbols import TRACELESS, traceless


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(Gamma=m.Gamma + c.channel("fuel_mass") * traceless(p, "G_{}"))


EFFECT = Effect(
    id="fuel-gradient",
    title="Gradient of the fuel",
    physics="The fuel in the carrier's tanks attracts the instrument, and decreases during the flight.",
    source="3 G m / r^3: a ton at three metres is 7 Eo",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G\, m_{fuel}(t)",
    limits=(
        "Fuel at one place, or tanks that empty in proportion; the carrier keeps its attitude (else self-gradient). A mass "
        "that does not change looks like gradient-offset."
    ),
    channels=("fuel_mass",),
    parameters=components("G", TRACELESS, "Eo/kg", "gradient {k} per mass of fuel", 0.01),
    sensing=sensing,
)
