from __future__ import annotations

import os
import threading
from pathlib import Path

import pytest

from deltaq.api.workers import kernels
from deltaq.api.workers.kernels import are_compiled, compiled_kernels, compiling, mark_as_compiled


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


def test_kernels_of_another_source_do_not_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = tmp_path / "source"
    source.mkdir()
    (source / "step.py").write_text("one = 1\n")
    monkeypatch.setattr(kernels, "KERNELS", source)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache" / "new"))
    assert not are_compiled()
    mark_as_compiled()
    assert are_compiled()
    os.utime(source / "step.py", (1, 1))
    assert are_compiled()
    (source / "step.py").write_text("one = 2\n")
    assert not are_compiled()


def test_kernels_of_another_processor_do_not_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    one = tmp_path / "one"
    one.write_text("model name : One\nbogomips : 1\nflags : fpu avx2\n")
    monkeypatch.setattr(kernels, "PROCESSOR", one)
    mark_as_compiled()
    one.write_text("model name : One\nbogomips : 2\nflags : fpu avx2\n")
    assert are_compiled()
    one.write_text("model name : One\nbogomips : 1\nflags : fpu avx512f\n")
    assert not are_compiled()
    one.unlink()
    assert not are_compiled()
    mark_as_compiled()
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
        mark_as_compiled()
    second.join()
    assert told == ["kernels are there"]


def test_nobody_waits_where_nothing_can_be_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file" / "folder"))
    with compiling(), compiling():
        assert not are_compiled()
