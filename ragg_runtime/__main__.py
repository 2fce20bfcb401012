"""``python -m ragg_runtime`` is ``ragg``."""

from ragg_runtime.cli.safe_path import without_current_folder

without_current_folder()  # before anything else is imported

from ragg_runtime.cli.main import main  # noqa: E402

main()
