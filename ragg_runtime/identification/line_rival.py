"""Whether a line in the record explains as much as an effect that was chosen: then the effect is not named."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import false_alarms
from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.scores import INDISTINGUISHABLE
from ragg_runtime.estimation.whitening import Piece, PreparedFlight, Projector
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import Term
from ragg_runtime.identification.omnibus import Remainder, ResidualTerm
from ragg_runtime.identification.strong import AddedEffect, Stage
from ragg_runtime.wording.numbers import join_names

Array = NDArray[np.float64]

# Chi-square by which a line must be off the multiple: what keeps step with the disc is taken for the disc's, and seems as far off it
# in one of a hundred (one degree of freedom)
SLIP = 6.6


# share of what an effect explains that a sinusoid at the very multiple must explain for it to be called a constant term; the rest is
# its couplings to the motion, which a strong one shows
CONSTANT = 0.99


@dataclass(frozen=True)
class LineAlternative:
    """A line that explains as much as some effects, which explain the chi-square ``by_effects`` next to the other chosen effects."""

    line: NearLine
    effects: tuple[str, ...]
    by_effects: float

    @property
    def words(self) -> str:
        return (
            f"a line at about {self.line.frequency:.5g} Hz, near a multiple of the spin rate, explains as much"
            f" as {join_names(self.effects)}, which is therefore not claimed"
        )

    def better(self, rem: Remainder) -> bool:
        """Whether it also explains as much as the effects together with the best generic term of the residual, which is one of many."""
        if not rem.significant:
            return True
        best = max((t.z**2 - 2.0 * np.log(s.tried) for s in rem.searches for t in s.terms), default=0.0)
        return bool(self.line.chi2 - self.by_effects > best - INDISTINGUISHABLE)

    def within(self, rem: Remainder) -> Remainder:
        """A residual of which this line is the strongest term."""
        term = ResidualTerm.of_line(self.line.frequency, self.line.amplitude, self.line.chi2)
        first, *others = rem.searches
        log_p = min(first.log_p, self.line.log_p)
        return Remainder((replace(first, log_p=log_p, terms=(term,), chi2=term.chi2), *others))


@dataclass(frozen=True)
class Steady:
    """An effect of which the record shows no more than a constant term, a sinusoid at a multiple of the spin rate; ``others`` would do as
    well. ``exactly``: a ``line`` beside the multiple explains as much.
    """

    effect: str
    others: tuple[str, ...]
    line: NearLine
    exactly: bool

    @property
    def name(self) -> str:
        """What it is called."""
        return Term(f"cos {self.line.turns}", ()).words

    @property
    def words(self) -> str:
        others = f", like {', '.join(self.others)}" if self.others else ""
        text = f"{self.effect} acts as {self.name}{others}"
        if not self.exactly:
            return text
        # three times Cramer-Rao: 12 over the square of duration and of signal to noise, rad/s (Rife and Boorstyn, IEEE Trans. IT 20, 1974)
        width = 3.0 * float(np.sqrt(12.0 / self.line.chi2)) / (2 * np.pi * self.line.duration)
        return f"{text}; a line within {width:.1g} Hz of {self.line.multiple:.6g} Hz would explain it too"


def find_line_rival(
    steps: Sequence[AddedEffect], last: Stage
) -> tuple[LineAlternative | None, tuple[Steady, ...]]:
    """The chosen effects that a line next to a multiple of the spin rate could replace, all of the last stage or the first of them, and
    those that are no more than one.
    """
    steady = []
    for effects, chi2, fitted, beside, others in _list_contested(steps, last):
        line = find_best_line(fitted, beside)
        if line is None:
            continue
        at_multiple, least = line.chi2 - line.slip, chi2 - INDISTINGUISHABLE
        surely = line.log_p <= np.log(false_alarms.REMAINDER)
        if line.slip >= SLIP and line.chi2 >= least and surely:
            return LineAlternative(line=line, effects=effects, by_effects=chi2), ()
        # a line at the very multiple explains as much, or all but a small part
        if len(effects) == 1 and at_multiple >= min(least, CONSTANT * chi2):
            steady.append(Steady(effects[0], others, line, exactly=at_multiple >= least))
    return None, tuple(steady)


# effects, the chi-square that they explain of a fit, beside other candidate columns of it, and what would do as well
Contested = tuple[tuple[str, ...], float, Fitted, Sequence[int], tuple[str, ...]]


def _list_contested(steps: Sequence[AddedEffect], last: Stage) -> Iterator[Contested]:
    """The effects that were derived into the model, all of the last stage, as two follow a line farther than one does, and each."""
    for t in steps:
        yield (t.effect,), t.test.chi2, t.before, (), t.alternatives
    problem, chosen = last.problem, last.chosen
    whole, _ = problem.joint([*chosen.values()])
    groups = [tuple(chosen)] if len(chosen) > 1 else []
    for effects in (*groups, *((e,) for e in chosen)):
        others = [o for o in chosen if o not in effects]
        chi2 = whole - problem.joint([chosen[o] for o in others])[0]
        beside = [n for o in others for n, _ in problem.candidates[o]]
        yield effects, chi2, last.fitted, beside, last.alternatives[effects[0]]


MULTIPLES = (1, 2, 3, 4)  # of the spin rate: those up to which the sensors' signatures reach

# widths of a line (one over the record's length) up to which one beside a multiple is sought; those farther off the search of the
# spectrum sees
REACH = 4.0
# width between the frequencies tried first; about the best of them others follow, so much finer again
STEP = 0.25

FINER = 8

TOGETHER = 11  # frequencies whose waves are made at a time
DISTINCT = 1e-6  # share of a wave that must be left by what is fitted for it to have a direction of its own


@dataclass(frozen=True)
class NearLine:
    """A sinusoid in the residual of a record of some ``duration``, s: Hz, chi-square given what is fitted, V.

    ``slip`` is how much of ``chi2`` one at the very ``multiple``, Hz, ``turns`` times the spin rate, would not explain; ``log_p`` counts
    the frequencies tried.
    """

    frequency: float
    chi2: float
    amplitude: float
    slip: float
    log_p: float
    turns: int
    multiple: float
    duration: float


def find_best_line(f: Fitted, extra: Sequence[int]) -> NearLine | None:
    """The sinusoid next to a multiple of the spin rate that explains most, base and ``extra`` candidate columns projected out.

    ``None`` of several records or of channels, where no disc turns, or where none has a direction of its own.
    """
    if len(f.prepared) != 1 or f.observations[0].recorded.demodulated:
        return None
    x, projector, _ = omnibus.project_out(f, 0, extra)
    r = x.observation.record
    if not r.turning:
        return None
    duration = float(r.time[-1] - r.time[0])
    width = 1.0 / duration
    offsets = np.arange(-REACH, REACH + STEP / 2, STEP) * width
    frequencies = np.concatenate([m * r.spin_frequency + offsets for m in MULTIPLES])
    frequencies = frequencies[frequencies < r.rate / 2 - width]
    if not len(frequencies):
        return None
    first = _measure_lines(x, projector, frequencies)
    rough = float(frequencies[int(np.argmax(first[0]))])
    turns = round(rough / r.spin_frequency)
    multiple = turns * r.spin_frequency
    near = np.append(rough + np.linspace(-STEP, STEP, 2 * FINER + 1) * width, multiple)
    chi2, size = _measure_lines(x, projector, near)
    k = int(np.argmax(chi2[:-1]))
    if not chi2[k] > 0.0:
        return None
    volts2 = float(x.noise_psd(near[k : k + 1])[0]) * r.rate / 2
    return NearLine(
        frequency=float(near[k]),
        chi2=float(chi2[k]),
        amplitude=float(size[k] * np.sqrt(volts2)),
        slip=float(chi2[k] - chi2[-1]),
        log_p=min(0.0, float(np.log(len(frequencies)) - chi2[k] / 2)),  # of two degrees of freedom
        turns=turns,
        multiple=multiple,
        duration=duration,
    )


def _measure_lines(x: PreparedFlight, projector: Projector, frequencies: Array) -> tuple[Array, Array]:
    """(n,), (n,): chi-square that a sinusoid of each frequency explains, and its amplitude in whitened rows."""

    def sums(piece: Piece) -> Array:
        Q = projector.basis(piece)
        right = np.column_stack([projector.project_residual(piece, Q), Q])
        parts = (_make_waves(x, piece, frequencies[part]) for part in split_range(len(frequencies), TOGETHER))
        return np.concatenate([np.dstack([X @ right, X @ X.transpose(0, 2, 1)]) for X in parts])

    total = np.sum([*x.each(sums)], axis=0)
    d, along, whole = total[:, :, 0], total[:, :, 1:-2], total[:, :, -2:]
    sizes, V = np.linalg.eigh(whole - along @ along.transpose(0, 2, 1))
    seen = sizes > DISTINCT * np.max(np.diagonal(whole, axis1=1, axis2=2), axis=1)[:, None]
    c = np.einsum("nij,ni->nj", V, d) / np.where(seen, sizes, np.inf)
    return np.sum(c**2 * np.where(seen, sizes, 0.0), axis=1), np.linalg.norm(c, axis=1)


def _make_waves(x: PreparedFlight, piece: Piece, frequencies: Array) -> Array:
    """(n, 2, rows): cosines and sines, in whitened rows, of a level that hardly changes within the filter's memory."""
    r = piece.observation.record
    wave = np.exp(1j * np.outer(2 * np.pi * frequencies, r.time[r.valid]))
    X = np.stack([wave.real, wave.imag], axis=1)
    if x.noise.uneven:
        X /= np.asarray(x.noise.level.of(r.quantity))[r.valid]
    weights = x.noise.weights(piece.observation.weights)
    X = np.concatenate([w * X for w in weights], axis=2)
    unknown_gradient.project(X.reshape(2 * len(X), -1), piece.windows)
    return X
