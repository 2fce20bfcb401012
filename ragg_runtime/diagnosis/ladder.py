"""What each simplification of the model costs on a record: from the paper's model up to that which keeps everything."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.threads import one_thread
from ragg_runtime.fit import columns
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.observation import observations_of
from ragg_runtime.fit.passes import Piece
from ragg_runtime.fit.score import Error
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.form import Form
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import vector, voltages
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

STEPS: tuple[Form, ...] = (
    Form(),
    Form(kinematics="full"),
    Form(kinematics="full", second_order_angles=True),
    Form(kinematics="full", second_order_angles=True, misalignment="exact"),
    Form(kinematics="full", second_order_angles=True, misalignment="exact", mounting=2),
    Form(kinematics="full", second_order_angles=True, misalignment="exact", mounting="exact"),
)
"""From the paper's form to that which keeps everything, one simplification less at a time."""


@dataclass(frozen=True)
class Rung:
    """A form of the model and how far it is from the flights.

    Attributes
    ----------
    form
        Of the model.
    nominal, calibrated
        Its errors with model.toml's values, and with parameters fitted to the flights.
    step
        By how much its prediction, with model.toml's values, differs from that of the form before; of the first
        ``None``.
    """

    form: Form
    nominal: Error
    calibrated: Error
    step: Error | None

    def as_json(self) -> dict[str, object]:
        return {
            **self.form.as_json(),
            "nominal": self.nominal.as_json(),
            "calibrated": self.calibrated.as_json(),
            "step": None if self.step is None else self.step.as_json(),
        }


def forms(own: Form) -> tuple[Form, ...]:
    """The forms to try: the steps, and the model's own at the end if it is none of them."""
    return STEPS if own in STEPS else (*STEPS, own)


@one_thread
def climb(
    instrument: Instrument, flights: Sequence[Flight], model_in: Callable[[Form], Model]
) -> tuple[Rung, ...]:
    """Hold the flights against the model in every form; ``model_in`` derives it."""
    observations = observations_of(flights, instrument)
    rungs: list[Rung] = []
    below: tuple[Model, Array] | None = None
    for form in forms(instrument.form):
        model = model_in(form)
        of_form = replace(instrument, form=form)
        p = vector(model, of_form)
        rungs.append(_rung(fit(model, of_form, observations), p, below))
        below = model, p
    return tuple(rungs)


def _rung(f: Fitted, p: Array, below: tuple[Model, Array] | None) -> Rung:
    def further(piece: Piece) -> Array:
        o = piece.observation
        here = columns.observed(o, voltages(f.model.chain, o.record, p, o.output), None)
        found = [o.data - here]
        if below is not None:
            found.append(
                here - columns.observed(o, voltages(below[0].chain, o.record, below[1], o.output), None)
            )
        return piece.observed(np.stack([np.where(o.record.valid, x, 0.0) for x in found]))

    count = 1 if below is None else 2
    scored = f.score([f.vector(np.zeros(f.n_base))], further, count)
    return Rung(
        form=f.instrument.form,
        nominal=scored[1].whole,
        calibrated=scored[0].whole,
        step=None if below is None else scored[2].whole,
    )
