"""Statistical evidence: whitened flights (``work``), tests of candidates (``likelihood``), their choice
(``search``), generic remainders (``omnibus``), and effects that no column can express (``special``).
"""
