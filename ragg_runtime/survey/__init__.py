"""Many flights: each diagnosed by itself, on a pool of processes or a Dask cluster, and summarised.

``run.survey`` does it; ``task`` is what is done with one flight, ``local`` and ``cluster`` where, ``journal``
the file that an interrupted survey continues from, ``summary`` what the flights say together. May import ``diagnosis``,
``plausibility``, ``model_dir`` and what is below.
"""

from __future__ import annotations

from ragg_runtime.survey.result import Survey
from ragg_runtime.survey.run import survey

__all__ = ["Survey", "survey"]
