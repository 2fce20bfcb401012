"""The paper's printed equations, compared term by term with the derived ones.

``audit()`` gives the result, ``page()`` the page of errata. The printed equations are data for the
audit alone: the derivation never sees them.
"""

from derive.audit.page import page
from derive.audit.result import Audit, audit

__all__ = ["Audit", "audit", "page"]
