"""How well the diagnosis does on flights of the independent reference, beside what one would try instead.

``python -m benchmarks.diagnosis`` flies some 240 flights (``plan``) with hidden effects of known strength
(``inject``) or physics outside the catalogue (``outside``), diagnoses each and gives its columns to other
methods (``peers``), one JSON line a flight (``fly``), so that it can be interrupted and resumed; ``score``
and ``table`` turn the lines into ``docs/diagnosis.md``.
"""
