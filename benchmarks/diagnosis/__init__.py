"""How well the diagnosis does: flights of the independent simulator, and questions asked of a real array.

``plan`` says which flights there are, ``records`` what is done to their noise and their files, ``oracle`` how large a hidden effect
must be; ``fly`` hides it and diagnoses a flight, ``score`` judges it and writes the page, ``ablation`` flies with single rules
switched off.
"""
