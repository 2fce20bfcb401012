"""Derived models as Python objects: the packaged one, or one derived for a list of effects, evaluated on records."""
