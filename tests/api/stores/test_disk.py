"""Whatever happens to the files, no wrong answer is given."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from deltaq.api.stores.disk import Disk

KEY, OTHER = "0123456789abcdef" * 2, "fedcba9876543210" * 2


@pytest.fixture
def disk(tmp_path: Path) -> Disk:
    return Disk(tmp_path / "answers", 100_000)


def file_of(disk: Disk, key: str = KEY) -> Path:
    return disk.folder / key[:2] / f"{key}.answer"


def test_answer_outlives_the_store(disk: Disk) -> None:
    assert disk.load(KEY) is None
    disk.save(KEY, b"answer")
    assert Disk(disk.folder, 100_000).load(KEY) == b"answer"
    assert disk.load(OTHER) is None
    assert [file.name for file in disk.folder.rglob("*") if file.is_file()] == [f"{KEY}.answer"]


def cut(file: Path) -> None:
    file.write_bytes(file.read_bytes()[:-1])


def flip(file: Path) -> None:
    content = bytearray(file.read_bytes())
    content[-1] ^= 1
    file.write_bytes(content)


def empty(file: Path) -> None:
    file.write_bytes(b"")


@pytest.mark.parametrize("damage", [cut, flip, empty], ids=lambda damage: damage.__name__)
def test_damaged_answer_is_missing_and_removed(disk: Disk, damage: Callable[[Path], None]) -> None:
    disk.save(KEY, b"answer")
    damage(file_of(disk))
    assert disk.load(KEY) is None
    assert not file_of(disk).exists()
    disk.save(KEY, b"answer")
    assert disk.load(KEY) == b"answer"


def test_answer_of_another_key_is_not_given(disk: Disk) -> None:
    disk.save(OTHER, b"another answer")
    file_of(disk).parent.mkdir()
    file_of(disk, OTHER).rename(file_of(disk))
    assert disk.load(KEY) is None


@pytest.mark.parametrize("key", ["../../secret", "0" * 31, "0" * 33, "x" * 32, KEY.upper(), "", f"{KEY}\n"])
def test_key_that_is_none_is_not_looked_for(disk: Disk, key: str) -> None:
    assert disk.load(key) is None


def test_answers_used_longest_ago_go_first(disk: Disk) -> None:
    keys = [f"{number:032x}" for number in range(10)]
    for age, key in enumerate(keys):
        disk.save(key, b"x" * 1000)
        os.utime(file_of(disk, key), (1000 + age, 1000 + age))
    assert disk.load(keys[0]) == b"x" * 1000  # used just now
    small = Disk(disk.folder, 5_000)
    small.save("f" * 32, b"x" * 1000)
    left = {file.stem for file in disk.folder.rglob("*.answer")}
    assert left == {keys[0], keys[8], keys[9], "f" * 32}


def test_size_is_bounded(disk: Disk) -> None:
    small = Disk(disk.folder, 20_000)
    for number in range(200):
        small.save(f"{number:032x}", b"x" * (number * 37 % 2000))
        kept = sum(file.stat().st_size for file in disk.folder.rglob("*.answer"))
        assert kept <= 20_000
    assert kept > 10_000


@pytest.mark.parametrize("store", ["a file", "nothing/\0"])
def test_folder_that_cannot_be(tmp_path: Path, store: str, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "a file").write_text("in the way")
    disk = Disk(tmp_path / "a file", 1000)
    disk.save(KEY, b"answer")
    assert disk.load(KEY) is None
    assert "the cache on disk cannot be written" in caplog.text


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_full_disk_leaves_no_half_of_an_answer(
    disk: Disk, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    opened = os.fdopen
    monkeypatch.setattr(os, "fdopen", lambda descriptor, mode: opened(os.open("/dev/full", os.O_WRONLY), mode))
    disk.save(KEY, b"answer")
    assert "cannot be written: No space left on device" in caplog.text
    assert [file for file in disk.folder.rglob("*") if file.is_file()] == []
    monkeypatch.undo()
    disk.save(KEY, b"answer")
    assert disk.load(KEY) == b"answer"
