"""The page of formulas speaks of the code: every name and file on it is there, and the numbers it states are the code's."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import numpy as np

from ragg_runtime.estimation.observation import ROWS
from ragg_runtime.identification import likelihood_ratio, probability, sequential

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "explanation" / "formulas.md").read_text("utf-8")
PYTHON = {p: p.read_text("utf-8") for p in sorted((ROOT / "ragg_runtime").rglob("*.py"))}


def _names() -> set[str]:
    """All names that the runtime's code defines or uses, attributes and parameters too."""
    found: set[str] = set()
    for text in PYTHON.values():
        for node in ast.walk(ast.parse(text)):
            for field in ("id", "attr", "name", "arg"):
                value = getattr(node, field, None)
                if isinstance(value, str):
                    found.add(value)
    return found


def test_every_symbol_of_the_page_is_a_name_of_the_code() -> None:
    named = set(re.findall(r"\\mathtt\{([^}]+)\}", TEXT)) | set(re.findall(r"`([A-Za-z_.0-9\[\]]+)`", TEXT))
    own = {
        re.sub(r"\[\d\]", "", n.replace("\\_", "_")) for n in named if "/" not in n and not n.endswith(".py")
    }
    known = _names()
    assert len(own) > 40
    modules = {p.stem for p in PYTHON}
    assert sorted(n for n in own if not set(n.split(".")) <= known | modules) == []


def test_every_file_of_the_page_is_there() -> None:
    places = set(re.findall(r"`((?:[a-z_]+/)*[a-z_0-9]+\.py)`", TEXT))
    assert len(places) > 12
    files = {p.relative_to(ROOT).as_posix() for p in PYTHON}
    assert [p for p in sorted(places) if not any(f == p or f.endswith(f"/{p}") for f in files)] == []


def test_every_reference_is_cited_and_every_citation_is_there() -> None:
    text, _, references = TEXT.partition("## References")
    listed = set(re.findall(r"^(\d+)\. ", references, flags=re.MULTILINE))
    cited = set(re.findall(r"\[([1-9]\d*)(?:, [^\]]+)?\]", text))
    assert cited == listed


def test_evidence_and_e_value_are_those_of_the_page() -> None:
    """ln B_S(g) for one effect against the code's, and an e-value from its formula."""
    g = likelihood_ratio.STRENGTHS
    assert (g[0], g[-1]) == (1.0, 1e8)
    block = probability._Subspace(effect="e", Q=np.eye(3)[:, :2], along=np.array([3.0, -1.0]), weight=0.0)
    log_b = 10.0 / 2 * g / (1 + g) - 2 / 2 * np.log(1 + g)
    assert np.allclose(
        probability._evidence([block], np.array([[0]])), np.log(np.mean(np.exp(log_b))), atol=1e-6
    )
    z, v = np.array([0.5, 3.0]), sequential.SIZES[:, None]
    each = (1 + v) ** -0.5 * np.exp(z**2 / 2 * v / (1 + v))
    expected = (np.mean(np.prod(each, axis=1)) + np.mean(each)) / 2
    assert np.isclose(sequential.log_e(z), np.log(expected))


def test_glossary_states_the_sizes_of_the_code() -> None:
    glossary = (ROOT / "docs" / "reference" / "glossary.md").read_text("utf-8")
    assert f"at most {ROWS:,} samples" in glossary
