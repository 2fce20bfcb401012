"""How well the diagnosis does: flights of the independent simulator, and questions asked of a real array.

``plan`` says which flights there are, ``records`` what is done to their noise and their files, ``strength`` how large a hidden
effect must be, ``outside`` what no effect makes; ``fly`` diagnoses one, ``score`` judges it, ``table`` writes the page, and
``ablation`` flies with single rules switched off.
"""
