"""Prints the page of errata: ``python -m derive.audit > docs/errata.md``."""

import sys

from derive.audit import page

sys.stdout.write(page())
