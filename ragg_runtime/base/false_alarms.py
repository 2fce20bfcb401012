"""Every probability with which chance alone may raise an alarm, with its reason, and what they add up to.

The promise is :data:`PROMISED`, for a record that the model describes: the verdict is another one than ``adequate`` in at most
that share of them. By the union bound (Bonferroni) the tests that decide the verdict take

    CATALOGUE   the effects that are columns, and steps: the least p-value times the number of effects tested
  + a random effect is tested besides, at CATALOGUE over the number of effects: one effect of thirty adds 0.001
  + REMAINDER   what no effect explains, all generic terms together
  + REMAINDER_SHARE of it once more: all products of the formula

which is 0.037. The rest of the promise is for the noise spectrum, which is estimated from the same record and not known: a
few of its bins at low frequency carry the drifts. COMPANION enters only where there is an effect, and LEVEL, CHANGE, FROZEN and
SURVEY are remarks next to the verdict: each is the level of its own statement.

What is certain in a record (clipping, spikes, jumps, lines, wrong units) has no level here.
"""

from __future__ import annotations

# largest share of records without any missing effect whose verdict may be another one than adequate
PROMISED = 0.05
# of the whole catalogue, the first effect. Most of the promise goes here: to find effects is what the diagnosis is for.
CATALOGUE = 0.03
# of each effect beside the first, of which there are three at most: a chance companion spoils a finding that is right
COMPANION = 0.005
REMAINDER = 0.004  # of all generic terms in the residual, some 2,000: the largest must be 4.9 sigma
# of REMAINDER, for steady terms and for terms that come and go
REMAINDER_SHARE = 0.5
LEVEL = 1e-4  # of the remark that the noise level follows something, over all quantities tested
# of holds_until_s: a change is said to be in flights in which there is none (over all of their blocks of time)
CHANGE = 0.01
FROZEN = 0.01  # of the test that a calibration that was kept is still the instrument's
# of a survey's own statements: that so many flights are no false alarms, and, for each parameter, that it varies
SURVEY = 0.01
