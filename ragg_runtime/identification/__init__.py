"""Which effect a flight lacks: candidates, tests, search, lack of fit, verdict, design of the next motion.

The data that flows, and where each step of the textbook is:

- a fit of the model, with R factors of base, candidates and residual (``estimation.fitted.Fitted``);
- ``selection.ProjectedProblem``: the candidates beside the projected base, with their tests (``estimation.likelihood_ratio``);
  ``selection``: forward selection among sets; ``steps``: change points;
- ``strong.Stage``, ``strong.AddedEffect``: nonlinear forward selection, an effect after the other derived into the model;
  ``search.Evidence``: all that was selected, and ``search.Outcome``: fitted together, with what it leaves;
- ``omnibus.Remainder``: lack of fit, by orthogonal matching pursuit over the generic terms of ``dictionary``; ``time_varying``: terms that
  come and go; ``formula``: a formula of one line for it;
- ``verdict.Conclusion``: what is claimed beside it; ``claims``: robust variance, held-out blocks, rivalry with generic terms;
  ``line_rival``: rivalry with lines near multiples of the spin rate; ``consistency``: Chow's test between flights, changes within them;
- ``result.Diagnosis``: what is reported, with ``ranking``: p-values and posterior probabilities of all effects, ``parameters``: their
  values, ``next_motion``: the optimal design of the next flight.

``comparison`` is the same for one model: how far it is from a flight, and where it fails.
"""
