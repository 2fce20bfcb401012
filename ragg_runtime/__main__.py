"""``python -m ragg_runtime`` is ``ragg``."""

import sys

if not sys.flags.safe_path:
    # `python -m` looks into the current folder first: a model directory has a `generated/` of its own there.
    del sys.path[0]

from ragg_runtime.cli.main import main

main()
