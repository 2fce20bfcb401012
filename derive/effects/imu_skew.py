import sympy as sp

from derive.effect import Context, Effect, Motion, Values, shared


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m._replace(a=sp.Matrix([c.shifted(m.a[0], p.delta_x), c.shifted(m.a[1], p.delta_y), m.a[2]]))


EFFECT = Effect(
    id="imu-skew",
    title="Sampling skew of the motion sensor's accelerometers",
    physics="One converter reads the channels in turn, or their filters differ: a_x and a_y are recorded later than a_z.",
    source="multiplexed converters: the sampling interval over the number of channels; filters with capacitors of 5 %",
    equation=r"a_x(t) = a_{x,rec}(t + \delta_x),\; a_y(t) = a_{y,rec}(t + \delta_y)",
    limits=(
        "Relative to a_z, whose own delay is time-offset; indistinguishable where a_z hardly matters. Fits interpolate the recorded "
        "a_x and a_y; exported programs approximate the delays to second order."
    ),
    parameters=tuple(
        shared(f"delta_{k}", rf"\delta_{k}", "s", f"lateness of a_{k}", 1e-3, late=(f"a_{k}",)) for k in "xy"
    ),
    sensing=sensing,
)
