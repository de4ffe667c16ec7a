"""Every problem of the language has its sentence in both languages, and the sentence has all its parameters."""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path

import pytest
from tests.language.hostile import BOMBS, CODE, LARGE, LATEX
from tests.language.scene_names import read
from tests.language.test_latex_syntax import REFUSED as REFUSED_LATEX
from tests.language.test_plain_syntax import REFUSED as REFUSED_PLAIN

from deltaq.errors import ExpressionError
from deltaq.language.parser import Syntax

TEXTS: list[tuple[Syntax, str]] = [
    *(("plain", row[0]) for row in REFUSED_PLAIN),
    *(("plain", text) for text in (*CODE, *BOMBS, *LARGE)),
    *(("latex", row[0]) for row in REFUSED_LATEX),
    *(("latex", text) for text in LATEX),
]


def catalog(root: Path, language: str) -> dict[str, str]:
    folder = root / "backend/deltaq/narration/locales" / language
    merged: dict[str, str] = {}
    for name in ("errors.language.json", "errors.scene.json"):
        merged |= json.loads((folder / name).read_text(encoding="utf-8"))
    return merged


def codes_in_source(root: Path) -> set[str]:
    """The codes with which the source of the language fails."""
    found = set()
    for file in (root / "backend/deltaq/language").glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if (
                isinstance(node, ast.Call)
                and getattr(node.func, "id", "") in ("fail", "_refuse", "Problem")
                and node.args
            ):
                found |= {
                    n.value for n in ast.walk(node.args[0]) if isinstance(n, ast.Constant) and "-" in str(n.value)
                }
    return found


@pytest.mark.parametrize("language", ["de", "en"])
def test_every_code_has_a_sentence(root: Path, language: str) -> None:
    assert codes_in_source(root) - catalog(root, language).keys() == set()


@pytest.mark.parametrize("language", ["de", "en"])
def test_every_sentence_gets_its_parameters(root: Path, language: str) -> None:
    sentences = catalog(root, language)
    missing = []
    for syntax, text in TEXTS:
        with pytest.raises(ExpressionError) as caught:
            read(text, syntax)
        for problem in caught.value.problems:
            wanted = set(re.findall(r"{(\w+)}", sentences[problem.code]))
            if not wanted <= problem.parameters.keys():
                missing.append((text[:40], problem.code, wanted - problem.parameters.keys()))
    assert missing == []
