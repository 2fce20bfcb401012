"""``python -m ragg_runtime`` is ``ragg``: the room of the commands, run as a program."""

import runpy  # the interpreter's own, loaded before the current folder could stand in for it

runpy.run_module("ragg_runtime.cli", run_name="__main__", alter_sys=True)
