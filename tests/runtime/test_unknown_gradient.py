"""A gradient that was not recorded, in voltages of accelerometers whose scale factors differ."""

from __future__ import annotations

import numpy as np

from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.regressors import LinearisationPoint, linearise
from ragg_runtime.estimation.unknown_gradient import take_out, windows
from ragg_runtime.identification import selection
from ragg_runtime.identification.ranking import list_not_testable
from ragg_runtime.model import model as load
from ragg_runtime.model.evaluate import vector
from ragg_runtime.reference.scenario import scenario


def test_an_unknown_gradient_is_taken_out_of_each_voltage_by_its_scale_factor() -> None:
    s = scenario(62, trim="table-v", duration=200.0, noise_density=0.0)  # 10 to 12 mA/g
    flight = s.simulate(record_gradient=False).flight(voltages=True)
    o = observe(flight, s.sheet)
    model = load.packaged()
    true = s.sheet.replace(**s.instrument.accelerometers)
    e = linearise(LinearisationPoint(model, s.sheet, vector(model, true), with_candidates=False), o)[-1:]
    n = len(o.record.time)
    left = take_out(e, windows(o, slice(0, n), NoiseModel.white(o.record.rate, 4)), o.record.valid)
    assert np.std(e) > 1e-3
    assert np.std(left) < 0.01 * np.std(e)


def test_of_a_constant_gradient_it_leaves_nothing_and_the_report_says_why() -> None:
    """What it leaves is small before the calibration: to say that this absorbs the rest would be wrong."""
    s = scenario(62, duration=200.0, noise_density=1e-8)
    f = fitted.fit(load.packaged(), s.sheet, [observe(s.simulate(record_gradient=False).flight(), s.sheet)])
    why = {x.effect: x.why for x in list_not_testable(f, selection.make_field(f, selection.list_testable(f)))}
    assert "a gradient that is not recorded" in why["gradient-offset"]
