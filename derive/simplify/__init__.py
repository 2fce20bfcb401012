"""From the analytical to the simplified model: what an envelope of motion and instruments lets one neglect.

Section II.B of the paper, computed. :func:`derive.simplify.terms.simplified` gives Eq. 42-47 for the paper's envelope, and the
model that follows from the same rule for any other; :func:`derive.simplify.terms.certified_bound` gives what the dropped part can
amount to, with proof; :func:`derive.simplify.page.critical_conditions` gives Tables I to III.
"""
