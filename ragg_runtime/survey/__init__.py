"""Many flights: each diagnosed by itself, on a pool of processes or a Dask cluster, and summarised.

``run.survey`` does it; ``task`` is what is done with one flight, ``local`` and ``cluster`` where, ``journal``
the file that an interrupted survey continues from, ``summary`` what the flights say together.
"""
