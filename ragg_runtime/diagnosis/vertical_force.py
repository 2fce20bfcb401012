"""A vertical force that was recorded with the wrong sign, or with gravity where the model means it without: told where it can be.

The record is fitted once more with a_z as it should be then. Of the four voltages the sign of a_z leaves a trace: each
accelerometer sees a_z and omegadot through the same angles. G_out and the channels see them through different combinations
of angles, so that a model whose angles and second-order coefficients of the spin axis have the opposite sign explains the record as
well; and gravity within a_z is, but for the second order, a bias of each accelerometer and a change of its scale factor.
There it is the sheet that tells, if it is sure enough of these parameters; where it is not, nothing is said.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit import calibrate
from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.fit.observation import Observation
from ragg_runtime.fit.off_sheet import as_said
from ragg_runtime.fit.prepared_flight import to_nominal
from ragg_runtime.fit.segments import ROWS
from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.instrument.instrument import Instrument

Array = NDArray[np.float64]

SURE = 30.0
"""Chi-square, the sheet's word in it, by which a record must fit better for a mistake to be said: e^15 times as likely, far less
than one good record in a hundred thousand."""

AS_NOISE = 1.1
"""Chi-square of the record over its number up to which nothing but noise is left once the mistake is undone."""

MUCH_BETTER = 25.0
"""Factor by which chi-square must fall where more is left than noise: no missing effect looks like that (a factor of five in
what is left, as for all other mistakes: ``plausibility/identify.py``)."""

BY_CHANCE = 3.0
"""Standard deviations of a chi-square, the squared distances from the sheet in its sigmas, within which the sheet is as right as it
says once the mistake is undone. A sheet that stays wrong (of a real sensor, angles by seven of its sigmas) was wrong before, and
gravity taken out of a record that needs it may then bring it nearer: that says nothing of a_z."""

LOUDEST = 1e5
"""Chi-square of the record over its number beyond which nothing is fitted once more: three hundred times the noise. A reversed
a_z that leaves so much is named when the flight is read."""


@dataclass(frozen=True)
class _Mistake:
    """``a_z``: times ``sign``, and so many times gravity more, as it should be; or omega_x and omega_y reversed."""

    words: str
    remedy: str
    sign: float = 1.0
    gravity: float = 0.0
    rates: bool = False

    def undone(self, o: Observation, g0: float) -> Observation:
        def righted(wide: Mapping[str, Array]) -> Mapping[str, Array]:
            if self.rates:
                names = (*ANGULAR_RATE[:2], *ANGULAR_ACCELERATION[:2])
                return {**wide, **{n: -wide[n] for n in names if n in wide}}
            return {**wide, "a_z": self.sign * wide["a_z"] + self.gravity * g0}

        return o.with_motion(righted)


_REVERSED = _Mistake(words="a_z has the wrong sign", remedy="multiply a_z by -1", sign=-1.0)
_RATES = _Mistake(words="omega_x and omega_y have", remedy="", rates=True)
_GRAVITY = (
    _Mistake(words="a_z is 1 g too small", remedy="add gravity to a_z", gravity=1.0),
    _Mistake(words="a_z is 1 g too large", remedy="take gravity out of a_z", gravity=-1.0),
    _Mistake(
        words="a_z has the wrong sign and is, then, 1 g too small",
        remedy="multiply a_z by -1 and add gravity",
        sign=-1.0,
        gravity=1.0,
    ),
    _Mistake(
        words="a_z has the wrong sign and is, then, 1 g too large",
        remedy="multiply a_z by -1 and take gravity out",
        sign=-1.0,
        gravity=-1.0,
    ),
)
"""Told by the sheet alone: the record itself is explained as well without."""


def misrecorded(f: Fitted) -> str | None:
    """What is wrong with a_z, and what to do, in words; ``None`` if nothing is, or the record and the sheet cannot tell."""
    width = np.array([f.instrument.widths.get(q.name, 1.0) for q in f.calibration.columns])
    off = float(np.sum((width * f.to_nominal) ** 2))
    beyond = float(f.data[:, -1] @ f.data[:, -1]) - f.calibration.rows
    if off + max(beyond, 0.0) < SURE or beyond > LOUDEST * f.calibration.rows:
        return None  # nothing can fit better by so much; or the fit is lost
    sheet = as_said(f.instrument)
    seen = [o.part(slice(0, min(ROWS, len(o.record.time)))) for o in f.observations]
    given = _fit(f, sheet, seen, f.calibration.p)
    noise_alone = beyond < (AS_NOISE - 1.0) * f.calibration.rows
    tried = (_REVERSED, *(_GRAVITY if off >= SURE and noise_alone else ()))
    fits = [(m, _fit(f, sheet, [m.undone(o, sheet.g0) for o in seen])) for m in tried]
    mistake, least = min(fits, key=lambda t: t[1].chi2)
    if not _convincing(given, least, sheet, f):
        return None
    also = ""
    if mistake is _REVERSED:
        other = _fit(f, sheet, [_RATES.undone(o, sheet.g0) for o in seen])
        also = f" (or: {_RATES.words})" if other.chi2 < least.chi2 + SURE else ""
    better = (given.chi2 - least.chi2) / max(1.0, least.excess)
    return (
        f"{mistake.words}{also}: with that undone record and sheet agree better by {better:.3g} in chi-square;"
        f" {mistake.remedy}, or check the sheet's signs and the sigma that it states"
    )


def _fit(
    f: Fitted, sheet: Instrument, seen: Sequence[Observation], start: Array | None = None
) -> Calibration:
    return calibrate.fit(f.model, sheet, seen, noise=f.calibration.noise, start=start)


def _convincing(given: Calibration, other: Calibration, sheet: Instrument, f: Fitted) -> bool:
    if (given.chi2 - other.chi2) / max(1.0, other.excess) < SURE:
        return False
    if other.chi2 * MUCH_BETTER < given.chi2:
        return True
    moves = to_nominal(f.model, sheet, other)
    by_chance = len(moves) + BY_CHANCE * np.sqrt(2.0 * len(moves))
    return other.excess < AS_NOISE and float(moves @ moves) < by_chance
