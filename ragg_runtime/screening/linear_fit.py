"""How well a model can explain a record if its parameters may move as far as is plausible: one number.

One linear fit about the test sheet, with every parameter's prior, robust against outliers, the size of the
residual being the only thing unknown. It costs milliseconds; it is no calibration. The number is minus the log
evidence of the fit (D. MacKay, Neural Computation 4, 1992, 415), so that whatever may be wrong with a record, a unit,
an axis, a clock or the sheet itself, competes by the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ragg_runtime.estimation import regressors as design
from ragg_runtime.estimation.least_squares import triangle
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import Model
from ragg_runtime.screening.sampler import Rows

Array = NDArray[np.float64]

GRADIENT_SCALE = 1e4
"""Prior of a gravity gradient that was not recorded, Eo."""

OUTLIER = 8.0
"""Residual, in robust standard deviations, from which a sample is left out of the fit."""

QUARTILE = 0.75
"""Quantile of the residuals that tells their size. Not the median: where the residual is a beat rather than noise that says little."""

QUARTILE_OF_NORMAL = 1.15
"""The same quantile of the modulus of a normal variable, in standard deviations."""

RARE = 0.01
"""Probability of an outlier: what recorders' glitches make."""

INDEPENDENT = 150.0
"""Rows that a fit counts as, however many it takes: what a wrong model leaves is a wave and no noise. Measured on the benchmark's
flights, two choices of rows tell the residual of a record to 10 %, and the parameters' squared moves to 30: as many rows weigh
both alike (2 x 150 log 1.1)."""

SETTLED = 0.999
"""Factor by which the noise must still fall for the estimate to go on."""


@dataclass(frozen=True)
class Explained:
    """What a model leaves of rows of a record once its parameters are fitted.

    Attributes
    ----------
    rms
        Size of the residual without its outliers, Eo.
    size
        Size of the output about its mean, Eo.
    p
        Fitted parameter vector of the model's chain, SI.
    surprise
        Sum of the squares of the parameters' moves, in plausible sizes.
    room
        What the record tells of the parameters: the logarithm of prior over posterior volume, the price of wide priors.
    kept
        Share of the rows that are no outliers.
    """

    rms: float
    size: float
    p: Array
    surprise: float
    room: float
    kept: float = 1.0

    @property
    def share(self) -> float:
        """Residual over output: the same in any unit of the output."""
        return self.rms / self.size if self.size > 0 else 1.0

    @property
    def misfit(self) -> float:
        """Minus the log likelihood of a row: 0 of a model that says nothing. An outlier is explained by nothing, and is rare."""
        return self.kept * float(np.log(max(self.share, 1e-300))) - (1.0 - self.kept) * float(np.log(RARE))

    @property
    def score(self) -> float:
        """Minus the log evidence, with :data:`INDEPENDENT` rows; the smaller the better."""
        return INDEPENDENT * self.misfit + self.surprise / 2 + self.room


@dataclass(frozen=True)
class Hypothesis:
    """What may be wrong with a record or its sheet.

    Attributes
    ----------
    what, remedy
        In words.
    fitted
        What the model leaves if this is so.
    cost
        Minus the logarithm of its probability beforehand.
    kind
        ``record`` (units, signs, axes, clock: the record is refused), ``shift`` (motion and output apart in time), ``origin``
        (the disc angle counts from elsewhere) or ``sheet`` (it is less sure than it says).
    effects
        Ids of effects that describe the same.
    calming
        Whether it is enough that the parameters stay closer to the sheet; a mistake of timing must leave less.
    """

    what: str
    remedy: str
    fitted: Explained
    cost: float
    kind: str = "record"
    effects: tuple[str, ...] = ()
    calming: bool = True

    def score(self, before: Explained) -> float:
        """Minus the log of evidence times prior: one number for whatever may be wrong; ``before``: the record as it stands."""
        calmed = 0.0 if self.calming else max(0.0, before.surprise - self.fitted.surprise)
        return self.fitted.score + self.cost + calmed / 2


def explain(model: Model, instrument: Instrument, rows: Rows) -> Explained:
    """Fit the model's parameters about the instrument's values, with their priors."""
    return explain_all(model, instrument, [rows])[0]


TOGETHER = 4096
"""Rows for which the model is evaluated at a time: a few hundred by themselves cost hardly less."""


def explain_all(model: Model, instrument: Instrument, many: Iterable[Rows]) -> list[Explained]:
    """The same of several records, or of one with one mistake after the other undone: rows of the same output."""
    about = _About.of(model, instrument)
    found: list[Explained] = []
    waiting: list[Rows] = []
    for rows in many:
        waiting.append(rows)
        if sum(len(r.time) for r in waiting) >= TOGETHER:
            found += about.explained(waiting)
            waiting = []
    return found + about.explained(waiting)


def low_passes(model: Model, instrument: Instrument, rows: Rows) -> Callable[[Array], Explained]:
    """The same of channels as a function of the low-pass that made them, an odd number of taps no longer than that of the rows:
    the model is evaluated, and its spectrum taken, once.
    """
    about = _About.of(model, instrument)
    own, columns, nominal, eotvos = about.columns([rows])
    raw = np.stack([*columns, *_gradient(rows), nominal])
    carriers = 2 * np.stack([np.sin(2 * rows.phi), np.cos(2 * rows.phi)])
    n = len(rows.time)
    size = fft.next_fast_len(n + len(rows.taps), real=True)
    spectrum = fft.rfft(raw * carriers, size)

    def explained(taps: Array) -> Explained:
        half = len(taps) // 2
        seen = fft.irfft(spectrum * fft.rfft(taps, size), size)[:, :, half : half + n]
        return about.fitted(own, rows, seen[:-1], seen[-1], eotvos)

    return explained


@dataclass(frozen=True)
class _About:
    """A model at an instrument's values ``p``, and the parameters that are fitted with their places in ``p``."""

    model: Model
    layout: Layout
    p: Array
    parameters: Sequence[tuple[design.Column, int]]

    @staticmethod
    def of(model: Model, instrument: Instrument) -> _About:
        return _About(
            model=model,
            layout=instrument.layout,
            p=vector(model, instrument),
            parameters=design.list_base_columns(model, instrument),
        )

    def explained(self, many: Sequence[Rows]) -> list[Explained]:
        """Of rows of one output that are evaluated together."""
        if not many:
            return []
        own, columns, nominal, eotvos = self.columns(many)
        edges = np.cumsum([0, *(len(r.time) for r in many)])
        found = []
        for rows, start, stop in zip(many, edges, edges[1:], strict=False):
            some = slice(start, stop)
            stacked = np.stack([*columns[:, :, some], *_gradient(rows)])
            found.append(self.fitted(own, rows, rows.seen(stacked), rows.seen(nominal[:, some]), eotvos))
        return found

    def columns(
        self, many: Sequence[Rows]
    ) -> tuple[Sequence[tuple[design.Column, int]], Array, Array, float]:
        """Of rows of one output, all together, N: its parameters; columns (n, m, N), Eo, and output (m, N), V, at the sheet's
        values, before demodulation; scale factor, V/Eo.
        """
        first = many[0]
        o = first.output
        eotvos = scale_factor(self.model, self.p, self.layout.outputs.index(o))
        own = [
            (c, i) for c, i in self.parameters if c.accelerometer is None or c.accelerometer - 1 in o.members
        ]
        volts, by = self._evaluated(many)
        nominal = first.before_demodulation(volts, None)
        columns = np.empty((len(own), *nominal.shape))
        for column, (c, _) in zip(columns, own, strict=True):
            column[:] = first.before_demodulation(by[c.name, c.accelerometer], c.accelerometer)
            column *= c.scale / eotvos
        return own, columns, nominal, eotvos

    def fitted(
        self,
        own: Sequence[tuple[design.Column, int]],
        rows: Rows,
        seen: Array,
        nominal: Array,
        eotvos: float,
    ) -> Explained:
        """Rows fitted by what their output sees of the columns, (n, m, N), and of the model at the sheet's values, (m, N)."""
        inner = rows.inner
        X = seen[:, :, inner].reshape(len(seen), -1)
        y = ((rows.data[:, inner] - nominal[:, inner]) / eotvos).reshape(-1)
        theta, kept, room = robust(X, y)
        size = rows.data[:, inner] / eotvos
        size = (size - np.mean(size, axis=1, keepdims=True)).reshape(-1)
        moved = self.p.copy()
        moved[[i for _, i in own]] += theta[: len(own)] * np.array([c.scale for c, _ in own])
        return Explained(
            rms=float(np.sqrt(np.mean((y - theta @ X)[kept] ** 2))),
            size=float(np.sqrt(np.mean(size[kept] ** 2))),
            p=moved,
            surprise=float(np.sum(theta[: len(own)] ** 2)),
            room=room,
            kept=float(np.mean(kept)),
        )

    def _evaluated(self, many: Sequence[Rows]) -> tuple[Array, dict[tuple[str, int | None], Array]]:
        """Voltages (members, n) at the rows of all, and their derivatives by every parameter: of one accelerometer (n,), of
        all (members, n).
        """
        chain, members = self.model.chain, many[0].output.members
        x = np.concatenate([r.inputs(chain) for r in many], axis=1)
        time, phi = (np.concatenate(y) for y in ([r.time for r in many], [r.phi for r in many]))
        cos_phi, sin_phi = np.cos(phi), np.sin(phi)
        volts = np.empty((len(members), len(time)))
        by: dict[tuple[str, int | None], Array] = {}
        for k, j in enumerate(members):
            q = chain.values_of(j, self.p)
            volts[k] = chain.accelerometer(j, time, cos_phi, sin_phi, x, q)
            slopes = chain.derivatives(j, time, cos_phi, sin_phi, x, q)
            for (name, shared), slope in zip(chain.ROWS, slopes, strict=True):
                if shared:
                    by.setdefault((name, None), np.empty_like(volts))[k] = slope
                else:
                    by[name, j + 1] = slope
        return volts, by


def _gradient(rows: Rows) -> list[Array]:
    """Columns of a constant gradient where none was recorded, before demodulation."""
    if rows.gradient_recorded:
        return []
    o = rows.output
    share = (
        np.array(o.carriers)[:, None] * np.array(o.radii)[:, None] / max((*o.radii, 1e-300)) / len(o.members)
    )
    turning = np.exp(2j * rows.phi)
    if not np.any(share.imag):
        carriers = [share.real * GRADIENT_SCALE * x for x in (np.sin(2 * rows.phi), np.cos(2 * rows.phi))]
    else:
        carriers = [x * GRADIENT_SCALE for x in ((share * turning).imag, (share * turning).real)]
    return [rows.before_demodulation(x, None) for x in carriers]


def robust(X: Array, y: Array) -> tuple[Array, NDArray[np.bool_], float]:
    """Coefficients (n,) of columns X (n, rows), the rows that are no outliers of the fit, and what is told of the coefficients."""
    kept = np.ones(len(y), dtype=np.bool_)
    theta, room = shrunken(X, y)
    for _ in range(10):
        left = np.abs(y - theta @ X)
        now = left <= OUTLIER * float(np.quantile(left, QUARTILE)) / QUARTILE_OF_NORMAL
        if np.array_equal(now, kept) or np.sum(now) < 2 * len(X):
            break
        kept = now
        theta, room = shrunken(X[:, kept], y[kept])
    return theta, kept, room


def shrunken(X: Array, y: Array) -> tuple[Array, float]:
    """Coefficients (n,) of columns X (n, rows), each with a prior of unit width, and what y tells of them; y's noise is estimated.

    The noise is what the fit leaves: starting from "all is noise" it falls until fit and noise agree.
    """
    R = triangle(np.vstack([X, y]))
    n = len(X)
    U, s, Vt = np.linalg.svd(R[:n, :n])
    d = U.T @ R[:n, n]
    rest = float(R[n, n] ** 2)
    noise = max(float(np.mean(y**2)), 1e-30)
    for _ in range(200):
        left = d * noise / (s**2 + noise)
        found = max((float(np.sum(left**2)) + rest) / len(y), 1e-30)
        if found > SETTLED * noise:
            break
        noise = found
    room = 0.5 * float(np.sum(np.log1p(s**2 * INDEPENDENT / (len(y) * noise))))
    return np.asarray(Vt.T @ (d * s / (s**2 + noise))), room
