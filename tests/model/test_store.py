"""Compiled models on disk: found again, never believed when damaged, never too many."""

from __future__ import annotations

import os
import shutil
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from deltaq.mechanics.library import load_scene
from deltaq.model import store
from deltaq.model.model import Model, compile_model
from deltaq.model.store import Store, key_of

PROGRAM = "from deltaq.mechanics.library import load_scene; from deltaq.model.model import compile_model; "
PROGRAM += "m = compile_model(load_scene('elastic-pendulum')); "
PROGRAM += "print(m.motion.table([[0.1 * i for i in range(m.motion.inputs)]]).tolist())"


def computed(folder: Path) -> str:
    """What a fresh process with this folder computes."""
    environment = {**os.environ, "DELTAQ_MODEL_CACHE": str(folder)}
    found = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True)
    return found.stdout


def test_a_model_is_found_again(tmp_path: Path) -> None:
    kept, model = Store(tmp_path), compile_model(load_scene("elastic-pendulum"))
    kept.save("a", model)
    copy = kept.load("a")
    assert isinstance(copy, Model)
    rows = np.random.default_rng(1).uniform(0.1, 1.0, (3, model.motion.inputs))
    np.testing.assert_array_equal(copy.motion.table(rows), model.motion.table(rows))
    assert kept.load("b") is None


@pytest.mark.parametrize(
    "damage",
    [
        pytest.param(lambda content: b"", id="empty"),
        pytest.param(lambda content: content[:-7], id="cut short"),
        pytest.param(lambda content: content[:60] + bytes([content[60] ^ 1]) + content[61:], id="one bit"),
        pytest.param(lambda content: b"x" * len(content), id="something else"),
    ],
)
def test_a_damaged_entry_is_made_anew(tmp_path: Path, damage: object) -> None:
    expected = computed(tmp_path)
    (entry,) = tmp_path.glob("*.model")
    whole = entry.read_bytes()
    entry.write_bytes(damage(whole))
    assert computed(tmp_path) == expected
    assert len(entry.read_bytes()) == len(whole)


class Canary:
    """A pickle of it runs what its writer likes."""

    def __init__(self, place: Path) -> None:
        self.place = place

    def __reduce__(self) -> tuple[object, ...]:
        return os.mkdir, (str(self.place),)


def linked(folder: Path) -> None:
    (folder / "a.model").rename(folder / "elsewhere")
    (folder / "a.model").symlink_to(folder / "elsewhere")


def piped(folder: Path) -> None:
    (folder / "a.model").unlink()
    os.mkfifo(folder / "a.model")


def given(path: Path) -> None:
    if os.geteuid():
        pytest.skip("only root can give files away")
    os.chown(path, 65534, 65534)


@pytest.mark.parametrize(
    "spoil",
    [
        pytest.param(lambda folder: folder.chmod(0o777), id="a folder that all may write"),
        pytest.param(lambda folder: folder.chmod(0o770), id="a folder that the group may write"),
        pytest.param(lambda folder: folder.chmod(0o1777), id="a folder such as /tmp"),
        pytest.param(lambda folder: (folder / "a.model").chmod(0o666), id="a file that all may write"),
        pytest.param(lambda folder: (folder / "a.model").chmod(0o620), id="a file that the group may write"),
        pytest.param(given, id="the folder of another user"),
        pytest.param(lambda folder: given(folder / "a.model"), id="the file of another user"),
        pytest.param(linked, id="a link"),
        pytest.param(piped, id="a pipe, which would not let go"),
    ],
)
def test_what_others_may_have_written_is_not_believed(tmp_path: Path, spoil: Callable[[Path], None]) -> None:
    folder = tmp_path / "models"
    Store(folder).save("a", Canary(tmp_path / "ran"))
    Store(folder).load("a")
    (tmp_path / "ran").rmdir()  # what is ours is run
    spoil(folder)
    assert Store(folder).load("a") is None
    assert not (tmp_path / "ran").exists()


def test_a_folder_of_all_gets_no_models(tmp_path: Path) -> None:
    tmp_path.chmod(0o777)
    Store(tmp_path).save("a", 1)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_made_for_its_user_alone(tmp_path: Path) -> None:
    before = os.umask(0)
    try:
        Store(tmp_path / "a" / "models").save("a", 1)
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "a" / "models").stat().st_mode) == 0o700
    assert stat.S_IMODE((tmp_path / "a" / "models" / "a.model").stat().st_mode) == 0o600


@pytest.mark.parametrize("package", ["model", "mechanics", "language"])
def test_other_code_has_another_key(package: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An upgrade finds no models of the version before, whichever package decides what a model is."""
    copy = tmp_path / "deltaq"
    for name in ("model", "mechanics", "language"):
        shutil.copytree(store.PACKAGE / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(store, "PACKAGE", copy)
    keys = set()
    for file in (None, *sorted((copy / package).rglob("*.py"))[::7]):
        if file:
            file.write_bytes(file.read_bytes() + b"# changed\n")
        store.surroundings.cache_clear()
        keys.add(key_of("x"))
    store.surroundings.cache_clear()
    assert len(keys) == 1 + len(sorted((copy / package).rglob("*.py"))[::7])


def test_a_folder_that_cannot_be_written_does_no_harm(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    store = Store(tmp_path / "file" / "models")
    store.save("a", 1)
    assert store.load("a") is None


def test_entries_used_longest_ago_give_way(tmp_path: Path) -> None:
    store = Store(tmp_path, most=3)
    for place, key in enumerate("abc"):
        store.save(key, key)
        os.utime(tmp_path / f"{key}.model", (place, place))
    assert store.load("a") == "a"  # used again
    store.save("d", "d")
    assert sorted(file.stem for file in tmp_path.iterdir()) == ["a", "c", "d"]


def test_other_content_has_another_key() -> None:
    assert key_of(("x", 1)) == key_of(("x", 1)) != key_of(("x", 2))
