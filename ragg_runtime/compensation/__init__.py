"""What is done with a calibrated model: it is kept, takes all that it explains out of the gravity gradient, or goes elsewhere.

``compensate`` works on whole flights, ``recursive`` sample by sample; ``saved`` and ``frozen`` are calibrations that are kept.
``export`` writes the same as a C program, as NumPy or as JSON; it imports nothing above ``fit``.
"""
