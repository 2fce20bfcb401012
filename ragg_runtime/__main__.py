"""``python -m ragg_runtime`` is ``ragg``."""

from ragg_runtime.cli.main import main

main()
