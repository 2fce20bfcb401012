"""The documentation site: ``make docs``. Nothing is fetched: formulas become MathML, fonts come with the theme."""

from __future__ import annotations

import contextlib
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT)]

from latex2mathml.converter import convert  # noqa: E402

if TYPE_CHECKING:
    from sphinx.application import Sphinx

project = "ragg"
author = "the ragg authors"
copyright = author  # noqa: A001
html_title = "ragg"
html_theme = "pydata_sphinx_theme"
html_show_sourcelink = False
html_copy_source = False
html_static_path = ["_static"]
html_extra_path = ["_made/extra"]
html_css_files = ["site.css"]
html_theme_options = {
    "navigation_with_keys": True,
    "show_toc_level": 2,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "navbar_end": ["theme-switcher"],
}
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
exclude_patterns = ["_build", "_made/extra", "**/.ipynb_checkpoints"]
myst_enable_extensions = ["dollarmath", "colon_fence", "attrs_inline"]
myst_heading_anchors = 4
myst_links_external_new_tab = False
nb_execution_mode = "cache"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
autodoc_typehints = "description"
autodoc_member_order = "bysource"
autodoc_default_options = {"show-inheritance": False}
html_math_renderer = "mathml"


def _mathml(self: Any, node: Any, *, block: bool) -> None:
    self.body.append(convert(node.astext(), display="block" if block else "inline"))
    from docutils.nodes import SkipNode

    raise SkipNode


def _inline(self: Any, node: Any) -> None:
    _mathml(self, node, block=False)


def _block(self: Any, node: Any) -> None:
    _mathml(self, node, block=True)


def _made(app: Sphinx, config: Any) -> None:
    """Write all that is generated: pages from the code, the notebook, figures, the reports of the demonstration."""
    from benchmarks.compensation import draw_transfer
    from benchmarks.diagnosis import score
    from derive import audit
    from derive.simplify.page import page as simplified
    from docs import made as build
    from ragg_runtime.experiments import repeat_dynamic, repeat_multifrequency, repeat_turbulence, write_page

    target = HERE / "_made"
    (target / "effects").mkdir(parents=True, exist_ok=True)
    for name in ("first-steps.ipynb", "demo-flight.parquet"):
        _written(target / name, (ROOT / "examples" / name).read_bytes())
    texts = build.effects() | {
        "errata.md": audit.page(),
        "simplified.md": simplified(),
        "experiments.md": write_page([repeat_multifrequency(), repeat_dynamic(), repeat_turbulence()]),
        "benchmark.md": score.page(),
        "changes.md": (ROOT / "CHANGELOG.md").read_text("utf-8"),
        "commands.md": build.commands(),
        "model-toml.md": build.model_toml(),
    }
    reports = target / "extra" / "reports"
    if not (target / "json.md").exists():
        reports.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            demonstration = build.demonstration(reports)
        build.loop_figure(target / "loop.png", demonstration)
        texts["json.md"] = build.json_page(demonstration.documents)
    for name, text in texts.items():
        _written(target / name, text.encode())
    if not (target / "transfer.png").exists():
        draw_transfer(target / "transfer.png")


def _written(target: Path, content: bytes) -> None:
    """Only where it differs: a page that is as before is not built again."""
    if not target.exists() or target.read_bytes() != content:
        target.write_bytes(content)


def setup(app: Sphinx) -> None:
    """Hooks of Sphinx."""
    app.add_html_math_renderer("mathml", inline_renderers=(_inline, None), block_renderers=(_block, None))
    app.connect("config-inited", _made)  # before Sphinx asks whether html_extra_path exists
