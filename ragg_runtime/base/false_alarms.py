"""Every probability with which chance alone may raise an alarm, with its reason, and what they add up to.

The promise is :data:`PROMISED`, for a record that the model describes: the verdict is another one than ``adequate`` in at most
that share of them. By the union bound (Bonferroni) the tests that decide the verdict take

    CATALOGUE   the effects that are columns, and steps: the least p-value times the number of effects tested
  + a random effect is tested besides, at CATALOGUE over the number of effects: one effect of thirty adds 0.001
  + REMAINDER   what no effect explains, all generic terms together

which is 0.033. The rest of the promise is for the noise spectrum, which is estimated from the same record and not known: a
few of its bins at low frequency carry the drifts. COMPANION enters only where there is an effect, and LEVEL, CHANGE, FROZEN and
SURVEY are remarks beside the verdict: each is the level of its own statement.

What stands in a record with no doubt has no level here, because chance has no part in it: an output that clips or stands on a
lattice (``generated.output_effects``), spikes, jumps and lines (``plausibility.spikes``, ``fit.disturbances``,
``signals.noise_spectrum``: 12 standard deviations, 25 times the level), a mistake of units or signs (five times the
misfit). Neither have comparisons of two explanations of the same thing, which are differences of chi-square.
"""

from __future__ import annotations

PROMISED = 0.05
"""Largest share of records without any missing effect whose verdict may be another one than ``adequate``."""

CATALOGUE = 0.03
"""Of the whole catalogue, the first effect. Most of the promise goes here: to find effects is what the diagnosis is for."""

COMPANION = 0.005
"""Of each effect beside the first, of which there are three at most: six times stricter than the first, for a chance companion
spoils a finding that is right, and true companions of the strength that counts (10 sigma) pass it all the same."""

REMAINDER = 0.002
"""Of everything that is looked for in what is left: some 2,000 terms are there only to withdraw a claim, and lose little
power by it: the largest of 2,000 must be 4.9 sigma; at 0.03 it would be 4.3."""

LEVEL = 1e-4
"""That the noise's level follows something, over all that is asked: it names nothing and withdraws no claim; a false one changes
the weights of the samples by a few per cent and is a remark beside the verdict."""

CHANGE = 0.01
"""Of ``holds_until_s``: a change is said to be in flights in which there is none (over all of their blocks of time)."""

FROZEN = 0.01
"""Of the test that a calibration that was kept is still the instrument's."""

SURVEY = 0.01
"""Of a survey's own statements: that so many flights are no false alarms, and, for each parameter, that it varies."""
