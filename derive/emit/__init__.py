"""Emitters: the frozen result (``derive.ir``) to source text, through jinja templates.

Templates hold loops, not decisions; an undefined name in one is an error.
"""
