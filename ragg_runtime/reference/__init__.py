"""The numerical model of the instrument (Eq. 49-53): an independent reference for the derived ones.

Built from vectors, rotations and cross products, not from the derivation's algebra, and free of its
truncations where asked (``rotations="exact"``, Newton's law, effects in full form). It never sees ``derive`` or ``generated``.
"""
