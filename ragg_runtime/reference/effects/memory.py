"""What an instrument remembers: resonances, friction and heat, integrated in time from rest on."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import signal
from scipy.interpolate import make_interp_spline

from ragg_runtime.reference.effects import Injected, Values
from ragg_runtime.reference.motion import Signal

Array = NDArray[np.float64]

# steps per second of the integration, by the trapezoidal rule: motion of 1 Hz comes out to a hundred-thousandth of its change
FINE = 1024.0
OVER = 8  # instants between two samples at which voltages are known before they are interpolated


def oscillator(values: Values) -> tuple[float, float]:
    """(d, b) of 1 + d s + b s^2, s and s^2."""
    f_0, Q = float(values["f_0"]), float(values["Q"])
    return 1 / (2 * np.pi * f_0 * Q), 1 / (2 * np.pi * f_0) ** 2


def recoil(values: Values, x: Signal, time: Array, delay: float = 0.0) -> tuple[Array, Array]:
    """A quantity x (N,) of the disc behind a mount as the sensor before it measures it, x_s, and its rate.

    x is x_s and a share of what the resonance adds, so that x_s - x = share b s^2 / (1 + d s + (1 - share) b s^2) x.
    """
    (d, b), share = oscillator(values), float(values["share"])
    fine = time[0] + np.arange(int(np.ceil((time[-1] - time[0]) * FINE)) + 2) / FINE
    y = _integrate(x(fine, delay, 1), [share * b, 0.0], [(1 - share) * b, d, 1.0])
    slope = np.gradient(y, 1 / FINE)
    return make_interp_spline(fine, y, k=3)(time), make_interp_spline(fine, slope, k=3)(time)


def find_resonance_loss(values: Values, voltages: Callable[[Array], Array], time: Array) -> Array:
    """Loss of voltages (n, N), V, to a resonance: each accelerometer's behind (u s + v s^2)/(1 + d s + b s^2)."""
    if len(time) < 2 or not (np.any(values["u"]) or np.any(values["v"])):
        return np.zeros((len(values["u"]), len(time)))
    d, b = oscillator(values)
    instants = np.linspace(time[0], time[-1], OVER * (len(time) - 1) + 1)
    splines = make_interp_spline(instants, voltages(instants), k=5, axis=1)
    factor = int(np.ceil(FINE * (time[1] - time[0])))
    fine = np.linspace(time[0], time[-1], factor * (len(time) - 1) + 1)
    rate = 1 / (fine[1] - fine[0])
    parts = zip(splines(fine), values["u"], values["v"], strict=True)
    return np.stack([_integrate(x, [v, u, 0.0], [b, d, 1.0], rate)[::factor] for x, u, v in parts])


SLIPPING = ("bias-hysteresis", "mount-hysteresis")
CREEPING = ("bias-creep", "mount-creep")
# effects that depend on the past of a force, current or temperature
MEMORIES = (*SLIPPING, *CREEPING, "inner-temperature", "thermal-hysteresis")
CYCLE = "thermal friction"  # name of the series, -1 to 1, that slips by the temperature


def former(effect: str) -> str:
    """Name of the series that decays from 1 to 0: the heat or strain with which a record begins."""
    return f"former {effect}"


def friction(effect: str, j: int, axis: int) -> str:
    """Name of the series of friction, -1 to 1, or of creep under the force along an axis, 0 to 2, of accelerometer j."""
    return f"{effect} {j} {axis}"


def heat(j: int) -> str:
    """Name of the series of what heats accelerometer j, m^2/s^4."""
    return f"heat {j}"


def list_memories(
    effects: Injected,
    forces: Callable[[Array], Array],
    currents: Callable[[Array], Array],
    auxiliaries: Mapping[str, Callable[[Array], Array]],
    time: Array,
) -> Mapping[str, Callable[[Array], Array]]:
    """Series that no record has, as functions of time, s.

    ``forces``: (n, 3, N) m/s^2 along the accelerometers' axes; ``currents``: (n, N) m/s^2, for a unit scale factor.
    """
    fine = np.linspace(time[0], time[-1], OVER * (len(time) - 1) + 1)
    series: dict[str, Array] = {}
    taus = {e: float(values["tau"]) for e, values in effects.items() if "tau" in values}
    for effect in (e for e in (*SLIPPING, *CREEPING) if e in effects):
        for j, f in enumerate(forces(fine)):
            for n, x in enumerate(f):
                series[friction(effect, j, n)] = (
                    _relax(x, taus[effect], fine) if effect in taus else _slip(x, float(effects[effect]["w"]))
                )
    if "inner-temperature" in effects:
        for j, i in enumerate(currents(fine)):
            series[heat(j)] = _relax(i**2, taus["inner-temperature"], fine)
    for effect, tau in taus.items():
        series[former(effect)] = np.exp((fine[0] - fine) / tau)
    if "thermal-hysteresis" in effects:
        series[CYCLE] = _slip(auxiliaries["temperature"](fine), float(effects["thermal-hysteresis"]["w"]))
    return {name: partial(_at, fine, x) for name, x in series.items()}


def _at(fine: Array, x: Array, time: Array) -> Array:
    return np.asarray(np.interp(time, fine, x))


def _relax(x: Array, tau: float, time: Array) -> Array:
    """y' = (x - y)/tau at (N,) s, x having been as on the average before."""
    before = np.concatenate([[np.mean(x)], x])
    return _integrate(before, [1.0], [tau, 1.0], 1 / (time[1] - time[0]))[1:]


def _slip(force: Array, w: float) -> Array:
    """Friction (N,), over its greatest size: a spring that slips where the force has moved it by w."""
    deflection, state = np.zeros_like(force), 0.0
    for n, step in enumerate(np.diff(force), 1):
        state = min(max(state + step / w, -1.0), 1.0)
        deflection[n] = state
    return deflection


def _integrate(
    x: Array, numerator: Sequence[float], denominator: Sequence[float], rate: float = FINE
) -> Array:
    """A series behind a rational response of s, in falling powers; before the record x had its first value."""
    if not np.any(numerator):
        return np.zeros_like(x)
    B, A = signal.bilinear(np.trim_zeros(numerator, "f"), np.trim_zeros(denominator, "f"), rate)
    return np.asarray(signal.lfilter(B, A, x, zi=signal.lfilter_zi(B, A) * x[0])[0])
