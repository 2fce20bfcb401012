from derive.effect import Context, Effect, Expr, Values, shared


def disc_angle(p: Values, c: Context) -> Expr:
    # The sensitivity to the angle; the random angle itself is the runtime's business.
    return p.sigma_phi + p.sigma_walk


EFFECT = Effect(
    id="spin-rate-jitter",
    title="Jitter of the spin rate",
    physics=(
        "Drive and bearing let the disc run unevenly: its true angle deviates from the recorded one, independently at every sample or "
        "as a random walk. Steady horizontal force turns it into noise of the output."
    ),
    source="angle noise of a spin servo",
    equation=r"\phi \leftarrow \phi + \delta\phi(t)",
    limits=(
        "To first order in the angle, uncorrelated with the motion. The tangential force of the uneven spin "
        "itself, R phi'', is common to the four accelerometers, stationary, and part of the noise of G_out."
    ),
    kind="random",
    parameters=(
        shared("sigma_phi", r"\sigma_\phi", "rad", "standard deviation, independent at every sample", 1e-6),
        shared("sigma_walk", r"\sigma_w", "rad/s^0.5", "random walk: growth with the root of time", 1e-6),
    ),
    disc_angle=disc_angle,
)
