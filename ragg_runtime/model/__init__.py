"""Derived models as Python objects: the packaged one, or one derived for a list of effects, evaluated on
records. May import flight, instrument and below, and ``generated``.
"""
