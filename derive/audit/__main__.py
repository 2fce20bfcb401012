"""Prints the page of errata: ``python -m derive.audit``."""

import sys

from derive.audit import page

sys.stdout.write(page())
