"""Every probability with which chance alone may raise an alarm, with its reason, and what they add up to.

The promise is :data:`PROMISED`, for a record that the model describes: the verdict is another one than ``adequate`` in at most
that share of them. By the union bound (Bonferroni) the tests that decide the verdict take

    CATALOGUE   the effects that are columns, and steps: the least p-value times the number of effects tested
  + a random effect is tested besides, at CATALOGUE over the number of effects: one effect of thirty adds 0.001
  + REMAINDER   what no effect explains, all generic terms together; divided by REMAINDER_SHARES
  + the first share of it once more: all products of the formula

which is 0.037. The rest of the promise is for the noise spectrum, which is estimated from the same record and not known: a
few of its bins at low frequency carry the drifts. COMPANION enters only where there is an effect, and LEVEL, CHANGE, FROZEN and
SURVEY are remarks next to the verdict: each is the level of its own statement.

What is certain in a record (clipping, spikes, jumps, lines, wrong units) has no level here.
"""

from __future__ import annotations

PROMISED = 0.05
"""Largest share of records without any missing effect whose verdict may be another one than ``adequate``."""

CATALOGUE = 0.03
"""Of the whole catalogue, the first effect. Most of the promise goes here: to find effects is what the diagnosis is for."""

COMPANION = 0.005
"""Of each effect beside the first, of which there are three at most: a chance companion spoils a finding that is right."""

REMAINDER = 0.004
"""Of all generic terms in the residual, some 2,000: the largest must be 4.9 sigma."""

REMAINDER_SHARES = (0.5, 0.25, 0.25)
"""How steady terms, terms that come and go, and lines in the spectrum divide :data:`REMAINDER`."""

LEVEL = 1e-4
"""Of the remark that the noise level follows something, over all quantities tested."""

CHANGE = 0.01
"""Of ``holds_until_s``: a change is said to be in flights in which there is none (over all of their blocks of time)."""

FROZEN = 0.01
"""Of the test that a calibration that was kept is still the instrument's."""

SURVEY = 0.01
"""Of a survey's own statements: that so many flights are no false alarms, and, for each parameter, that it varies."""
