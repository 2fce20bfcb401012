"""Prints the page on the simplified model: ``python -m derive.simplify``."""

import sys

from derive.simplify.page import page

sys.stdout.write(page())
