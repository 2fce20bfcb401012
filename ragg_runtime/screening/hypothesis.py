"""One explanation of a record that does not fit its model."""

from __future__ import annotations

from dataclasses import dataclass

from ragg_runtime.screening.linear_fit import Explained


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
