"""A test that hangs fails with its name, and the run ends."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from tests import serving
from tests.e2e import waiting

WAITS = """
from threading import Event

def test_waits():
    Event().wait()

def test_comes_after_it():
    pass
"""
COMPUTES = """
from itertools import repeat

def test_computes():
    sum(repeat(0, 10**10))  # a minute or two without a look at signals, as in compiled code
"""


def test_who_hangs_is_named_and_the_run_ends(root: Path, tmp_path: Path) -> None:
    for name, content in ("test_a.py", WAITS), ("test_b.py", COMPUTES):
        (tmp_path / name).write_text(content, encoding="utf-8")
    project = ("-c", root / "pyproject.toml", "--rootdir", tmp_path)
    limits = ("-o", "timeout=3", "-o", "faulthandler_timeout=9")
    command = [sys.executable, "-m", "pytest", *project, *limits, "-n2", "."]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == pytest.ExitCode.TESTS_FAILED, run.stdout + run.stderr
    assert "FAILED test_a.py::test_waits - Failed: Timeout (>3.0s)" in run.stdout
    assert "crashed while running 'test_b.py::test_computes'" in run.stdout
    assert "2 failed, 1 passed" in run.stdout


def test_who_waits_may_say_for_what_before(pytestconfig: pytest.Config) -> None:
    """What a test waits for tells more than that it took too long, and a test that ends tells more than a worker."""
    limit, end = (float(pytestconfig.getini(name)) for name in ("timeout", "faulthandler_timeout"))
    longest = max(waiting.PATIENCE / 1000, serving.PATIENCE, *serving.PATIENT.values())
    assert 2 * longest < limit < end
