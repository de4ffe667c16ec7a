from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from deltaq.api.workers.kernels import are_compiled, compiled_kernels, compiling
from deltaq.simulation.kernels import marks
from deltaq.simulation.kernels.marks import declared, mark


@pytest.mark.parametrize(
    ("files", "count"),
    [
        pytest.param([], 0, id="none"),
        pytest.param(["kernels_1/integrate.nbi", "readme.txt"], 0, id="an index without code"),
        pytest.param(["kernels_1/integrate.1.nbc", "kernels_1/integrate.2.nbc", "other/step.1.nbc"], 3, id="three"),
    ],
)
def test_compiled_kernels_are_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, files: list[str], count: int
) -> None:
    for file in files:
        (tmp_path / file).parent.mkdir(exist_ok=True)
        (tmp_path / file).touch()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    assert compiled_kernels() == count


def test_kernels_are_looked_for_beside_the_code(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    here = len(list(Path(__file__).parents[3].glob("backend/deltaq/simulation/kernels/__pycache__/*.nbc")))
    assert compiled_kernels() == here


ONE = (
    '@kernel\ndef one() -> None:\n    """{}."""\n\n\n@callback("void(int64)")\ndef two(given: int) -> None:\n    pass\n'
)


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The only module of kernels, on a machine without any."""
    folder = tmp_path / "source"
    folder.mkdir()
    monkeypatch.setattr(marks, "KERNELS", folder)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache" / "new"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home"))
    (folder / "step.py").write_text(ONE.format("One"))
    yield folder / "step.py"
    forget()


def forget() -> None:
    """As another process begins, which has read no source yet."""
    for each in (marks._digest, marks.source_stamp, marks._imported):
        each.cache_clear()


def test_all_kernels_must_be_compiled(source: Path) -> None:
    assert sorted(declared()) == ["step.one", "step.two"]
    mark("step.one")
    assert not are_compiled()
    mark("step.two")
    assert are_compiled()
    source.with_name("later.py").write_text(ONE.format("Later"))
    assert not are_compiled()  # whoever upgrades has new ones, though none of the old has changed


def test_kernels_of_another_source_do_not_count(source: Path) -> None:
    mark(*declared())
    os.utime(source, (1, 1))
    forget()
    assert are_compiled()
    source.write_text(ONE.format("Two"))
    forget()
    assert not are_compiled()


def test_kernels_of_another_processor_do_not_count(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = tmp_path / "one"
    monkeypatch.setattr(marks, "PROCESSOR", one)
    for told, is_known in (
        ("model name : One\nbogomips : 1\nflags : fpu avx2\n", False),
        ("model name : One\nbogomips : 2\nflags : fpu avx2\n", True),
        ("model name : One\nbogomips : 1\nflags : fpu avx512f\n", False),
    ):
        one.write_text(told)
        forget()
        assert are_compiled() is is_known
        mark(*declared())


def test_marks_are_where_they_can_be_written(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file" / "folder"))
    mark(*declared())
    assert are_compiled()


def test_one_process_compiles_and_the_others_wait(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    told: list[str] = []

    def other() -> None:
        with compiling():
            told.append("kernels are there" if are_compiled() else "nothing is there")

    with compiling():
        second = threading.Thread(target=other)
        second.start()
        second.join(0.2)
        assert told == []
        mark(*declared())
    second.join()
    assert told == ["kernels are there"]


def test_nobody_waits_where_nothing_can_be_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file" / "folder"))
    with compiling(), compiling():
        assert not are_compiled()
