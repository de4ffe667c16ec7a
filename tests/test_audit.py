"""The audit of dependencies never calls silence a good answer."""

from __future__ import annotations

import sys
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest


@pytest.fixture
def audit(root: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """The program, which has no suffix and so no name to import it by."""
    loader = SourceFileLoader("audit", str(root / ".ci/audit"))
    module = ModuleType("audit")
    module.__file__ = loader.path
    monkeypatch.setitem(sys.modules, "audit", module)  # where dataclasses look for it
    loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("answered", "holes", "code", "told"),
    [
        pytest.param(9, (), 0, "npm: 9 packages, 9 answers, 0 known holes", id="clean"),
        pytest.param(
            0,
            (),
            3,
            "npm: 9 packages, 0 answers, 0 known holes\n  NOT AUDITED, a hole would not be seen: 405",
            id="no answer",
        ),
        pytest.param(
            8,
            (),
            3,
            "npm: 9 packages, 8 answers, 0 known holes\n  NOT AUDITED, a hole would not be seen: 405",
            id="one was not answered",
        ),
        pytest.param(
            9,
            (("CVE-1", "x 1.0"),),
            2,
            "npm: 9 packages, 9 answers, 1 known holes\n  CVE-1: NOT EXPLAINED: x 1.0",
            id="hole",
        ),
        pytest.param(
            9,
            (("CVE-2", "x 1.0"),),
            0,
            "npm: 9 packages, 9 answers, 1 known holes\n  CVE-2: the part is not used: x 1.0",
            id="explained hole",
        ),
        pytest.param(
            0,
            (("CVE-1", "x 1.0"),),
            2,
            "npm: 9 packages, 0 answers, 1 known holes\n  CVE-1: NOT EXPLAINED: x 1.0\n"
            "  NOT AUDITED, a hole would not be seen: 405",
            id="hole and silence",
        ),
    ],
)
def test_finding(
    audit: Any,
    monkeypatch: pytest.MonkeyPatch,
    answered: int,
    holes: tuple[tuple[str, str], ...],
    code: int,
    told: str,
) -> None:
    monkeypatch.setattr(audit, "ACCEPTED", {"CVE-2": "the part is not used"})
    finding = audit.Finding("npm", 9, answered, holes, "405")
    assert (finding.code, str(finding)) == (code, told)


def test_all_that_is_shipped_is_asked_for(audit: Any, root: Path) -> None:
    assert {line.partition("==")[0] for line in audit.pinned()} >= {"fastapi", "sympy", "numba", "redis"}
    assert {name.removeprefix("node_modules/") for name in audit.locked()} >= {"katex", "lit-html", "mathlive"}
