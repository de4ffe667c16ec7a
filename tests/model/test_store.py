"""Compiled models on disk: found again, never believed when damaged, never too many."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from deltaq.mechanics.library import load_scene
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
    store, model = Store(tmp_path), compile_model(load_scene("elastic-pendulum"))
    store.save("a", model)
    copy = store.load("a")
    assert isinstance(copy, Model)
    rows = np.random.default_rng(1).uniform(0.1, 1.0, (3, model.motion.inputs))
    np.testing.assert_array_equal(copy.motion.table(rows), model.motion.table(rows))
    assert store.load("b") is None


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
