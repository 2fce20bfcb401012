"""What a record determines of the calibrated parameters: what it does not see, and how they are correlated.

The covariance is read in the combinations of four accelerometers that G_out depends on: Sigma, D^12, D^34, D^1234 (Eq.
18-19).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.calibrate import LEARNED, count_directions, list_combinations, list_parameters
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.identification import parameters as combinations
from ragg_runtime.identification.parameters import UNSEEN
from ragg_runtime.wording import describe_other, numbers
from ragg_runtime.wording.sections import Matrix, Section, Table

Array = NDArray[np.float64]

SHARE = 0.03
"""Squared share of what is seen below which a direction is taken not to be seen."""

LISTED = 16
"""Pairs that are listed, the most correlated first."""

MOST_LABELS = 24
"""Directions of a matrix of correlations: beyond these nobody reads it."""


def find_directions(f: Fitted) -> tuple[list[str], Array]:
    """Names of directions of the parameters, ``D12 beta_z``, and their (k, n) unit vectors over the fitted ones, in scales.

    They are sums of A1 ... A4 with signs where the record is of the paper's G_out, which depends on these.
    """
    form, columns = f.observations[0].recorded, f.calibration.columns
    patterns = f.instrument.layout.like_paper and not (form.separate or form.demodulated)
    positions: dict[str, list[int]] = {}
    for n, c in enumerate(columns):
        positions.setdefault(c.name, []).append(n)
    names: list[str] = []
    rows = np.zeros((len(columns), len(columns)))
    for places in positions.values():
        together = patterns and len(places) == 4
        for k, n in enumerate(places):
            of, signs = combinations.PATTERNS[k] if together else (columns[n].accelerometer_name, (1.0,))
            rows[len(names), places if together else [n]] = np.array(signs) / np.linalg.norm(signs)
            names.append(f"{of} {numbers.parameter(combinations.own_name(columns[n]))}".strip())
    return names, rows


def list_unseen(f: Fitted) -> list[str]:
    """Names of the directions of the parameters that the record leaves at their prior."""
    names, U = find_directions(f)
    variance, vectors = np.linalg.eigh(U @ f.coefficients(())[1] @ U.T)
    share = np.sum(vectors[:, variance >= LEARNED**2] ** 2, axis=1)
    return [names[n] for n in np.flatnonzero(share > 1.0 - SHARE)]


def describe_parameters(f: Fitted, *, values: bool = True) -> tuple[Section, ...]:
    """What the record determines of the parameters, their ``values``, and their correlations, as folded sections."""
    seen, total = count_directions(f)
    known = f"{seen} of {total} directions of the calibrated parameters are determined by this record"
    text = [f"{known}; the others stay at their test-sheet values."]
    if unseen := list_unseen(f):
        text.append(f"Not observable: {', '.join(unseen)}.")
    matrix, pairs = correlate_parameters(f)
    strongest = Table(("parameter", "and", "correlation"), tuple(pairs), words=2)
    lists = (list_combinations(f), list_parameters(f)) if values else None
    return (
        Section("What the record determines", tuple(text), detail=True, summary=f"{known}."),
        *(() if lists is None else describe_other.tabulate_parameters(*lists, detail=True)),
        Section("Correlations of the parameters", table=strongest, plots=(matrix,), detail=True),
    )


def correlate_parameters(f: Fitted) -> tuple[Matrix, list[tuple[str, str, str]]]:
    """The matrix of correlations of the directions that the record constrains, and its largest entries.

    Of more than can be labelled in it, it has those with the largest correlations.
    """
    names, U = find_directions(f)
    covariance = U @ f.coefficients(())[1] @ U.T
    std = np.sqrt(np.diag(covariance))
    kept = np.flatnonzero(std < UNSEEN)
    r = (covariance / np.outer(std, std))[np.ix_(kept, kept)]
    labels = tuple(names[n] for n in kept)
    i, j = np.triu_indices(len(r), 1)
    strongest = np.argsort(-np.abs(r[i, j]), kind="stable")[:LISTED]
    pairs = [(labels[i[k]], labels[j[k]], numbers.fixed(float(r[i[k], j[k]]), 3)) for k in strongest]
    caption = "Correlations of the calibrated parameters that this record determines, wholly or in part."
    largest = np.max(np.abs(r - np.eye(len(r))), axis=0, initial=0.0)
    shown = np.sort(np.argsort(-largest, kind="stable")[:MOST_LABELS])
    return Matrix("correlations", caption, tuple(labels[n] for n in shown), r[np.ix_(shown, shown)]), pairs
