"""Many flights: each diagnosed by itself, on a pool of processes or a Dask cluster, and summarised; quality control of lines.

``run.survey`` does it; ``task`` is what is done with one flight, ``local`` and ``cluster`` where, ``journal``
the file that an interrupted survey continues from, ``summary`` what the flights say together. ``quality`` needs no model:
it imports nothing above ``flight``.

Imports ``base``, ``diagnosis``, ``fit``, ``flight``, ``instrument``, ``model_dir``, ``plausibility`` and ``wording``.
"""
