"""Where there is no browser, one is told what to do about it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.e2e import browser
from tests.e2e.browser import REMEDY, NoBrowser, Program, chromium
from tests.frontend import node

LACKING = "error while loading shared libraries: libnspr4.so: cannot open shared object file"


def program(file: Path, script: str) -> str:
    file.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    file.chmod(0o755)
    return str(file)


@pytest.fixture(autouse=True)
def anew() -> Iterator[None]:
    """As in a process that has not looked for one yet."""
    browser._searched.cache_clear()
    yield
    browser._searched.cache_clear()


@pytest.mark.parametrize(
    ("script", "fault"),
    [
        pytest.param(f"echo '{LACKING}' >&2; exit 127", LACKING, id="a library is missing"),
        pytest.param("exit 3", "exit code 3", id="without a word"),
    ],
)
def test_one_that_does_not_start_is_told(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, script: str, fault: str
) -> None:
    named = program(tmp_path / "chromium", script)
    monkeypatch.setenv("CHROMIUM_PATH", named)
    with pytest.raises(NoBrowser) as caught:
        chromium()
    assert str(caught.value) == f"{named} does not start: {fault}; {REMEDY}"


def test_a_name_of_nothing_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CHROMIUM_PATH", "/nowhere")
    with pytest.raises(NoBrowser, match=r"^/nowhere does not start: .*No such file"):
        chromium()


def test_the_next_one_is_taken_when_the_first_does_not_start(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv("CHROMIUM_PATH", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    program(tmp_path / "chromium", "exit 1")
    other = program(tmp_path / "google-chrome", "exit 0")
    assert chromium() == Program(other)


def test_npm_that_gets_nothing_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """With the node of the package, as where there is no other."""
    monkeypatch.delenv("CHROMIUM_PATH", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("npm_config_offline", "true")
    monkeypatch.setenv("npm_config_cache", str(tmp_path / "npm"))
    monkeypatch.setattr(browser, "node_folder", node.node_folder.__wrapped__)
    monkeypatch.setattr(node, "node_folder", node.node_folder.__wrapped__)
    with pytest.raises(
        NoBrowser, match=r"^no Chromium could be fetched from npm: npm error code ENOTCACHED; put chrom"
    ):
        chromium()
