"""Write ``first-steps.ipynb`` from ``first_steps.py``: the same cells, without outputs.

Run it after the script was changed: ``python -m examples.first_notebook``.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
SCRIPT, NOTEBOOK = HERE / "first_steps.py", HERE / "first-steps.ipynb"


def notebook(script: str) -> str:
    """The notebook (nbformat 4.5, JSON) of a script whose cells begin with ``# %%`` or ``# %% [markdown]``."""
    parts = re.split(r"^# %%(.*)\n", script, flags=re.MULTILINE)
    cells: list[dict[str, Any]] = []
    for kind, text in zip(parts[1::2], parts[2::2], strict=True):
        lines = text.strip("\n").split("\n")
        cell: dict[str, Any] = {"id": f"cell-{len(cells)}", "metadata": {}}
        if "[markdown]" in kind:
            lines = [re.sub(r"^# ?", "", line) for line in lines]
            cell |= {"cell_type": "markdown"}
        else:
            cell |= {"cell_type": "code", "execution_count": None, "outputs": []}
        cell["source"] = [f"{line}\n" for line in lines[:-1]] + lines[-1:]
        cells.append(dict(sorted(cell.items())))
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    whole = {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    NOTEBOOK.write_text(notebook(SCRIPT.read_text("utf-8")), "utf-8")
