"""What others may have written is not trusted: answers, and kernels, whose files are pickles; the service works on."""

from __future__ import annotations

import logging
import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from deltaq import ownership
from deltaq.api.stores.disk import Disk
from deltaq.api.workers import kernels
from deltaq.ownership import UntrustedFileError, require_trusted
from deltaq.simulation.kernels.machine import OwnFiles

KEY, OTHER = "0123456789abcdef" * 2, "fedcba9876543210" * 2
Spoil = Callable[[Path, Path], object]


class Canary:
    """A pickle of it runs what its writer likes."""

    def __init__(self, place: Path) -> None:
        self.place = place

    def __reduce__(self) -> tuple[object, ...]:
        return os.mkdir, (str(self.place),)


def given(path: Path) -> None:
    if os.geteuid():
        pytest.skip("only root can give files away")
    os.chown(path, 65534, 65534)


def linked(path: Path) -> None:
    path.rename(path.with_name("elsewhere"))
    path.symlink_to("elsewhere")


def piped(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


SPOILT = [
    pytest.param(lambda folder, file: folder.chmod(0o777), id="a folder that all may write"),
    pytest.param(lambda folder, file: folder.chmod(0o1777), id="a folder such as /tmp"),
    pytest.param(lambda folder, file: (os.chown(folder, -1, 65534), folder.chmod(0o770)), id="a folder of a group"),
    pytest.param(lambda folder, file: given(folder), id="the folder of another user"),
    pytest.param(lambda folder, file: file.chmod(0o666), id="a file that all may write"),
    pytest.param(lambda folder, file: (os.chown(file, -1, 65534), file.chmod(0o620)), id="a file of a group"),
    pytest.param(lambda folder, file: given(file), id="the file of another user"),
    pytest.param(lambda folder, file: linked(file), id="a link"),
    pytest.param(lambda folder, file: piped(file), id="a pipe, which would not let go"),
]


@pytest.mark.parametrize("spoil", SPOILT)
def test_answers_that_others_may_have_written_are_not_given(
    tmp_path: Path, spoil: Spoil, caplog: pytest.LogCaptureFixture
) -> None:
    disk = Disk(tmp_path / "answers", 100_000)
    disk.save(KEY, b"answer")
    assert disk.load(KEY) == b"answer"
    spoil(disk.folder, disk.folder / KEY[:2] / f"{KEY}.answer")
    ownership._warn.cache_clear()
    with caplog.at_level(logging.WARNING):
        assert [disk.load(KEY) for _ in range(3)] == [None] * 3
    assert len(caplog.records) == 1 or not caplog.records[0].name.endswith("ownership")  # a link cannot be opened


def test_no_answers_are_kept_where_others_may_write(tmp_path: Path) -> None:
    tmp_path.chmod(0o777)
    Disk(tmp_path, 100_000).save(KEY, b"answer")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("number", [0, 1], ids=["index", "data"])
@pytest.mark.parametrize("spoil", SPOILT)
def test_kernels_that_others_may_have_written_are_not_loaded(tmp_path: Path, spoil: Spoil, number: int) -> None:
    folder, ran = tmp_path / "kernels", tmp_path / "ran"
    folder.mkdir()
    kept = OwnFiles(str(folder), "kernel", "stamp")
    kept.save("signature", "code")
    assert OwnFiles(str(folder), "kernel", "stamp").load("signature") == "code"
    files = sorted(folder.iterdir(), key=lambda file: file.suffix == ".nbc")
    assert [file.suffix for file in files] == [".nbi", ".nbc"]
    files[number].write_bytes(pickle.dumps(Canary(ran)))
    spoil(folder, files[number])
    try:
        found = kept.load("signature")
    except UntrustedFileError:
        found = None
    assert found is None
    assert not ran.exists()


def moved(place: Path) -> None:
    """The folder stands elsewhere, in one that all may write, and a link leads there."""
    shared = place.parent / "shared"
    shared.mkdir()
    place.rename(shared / place.name)
    place.symlink_to(shared / place.name)
    shared.chmod(0o777)


def reached_by_links(place: Path) -> None:
    """All may write the folder, in which links lead to what is this user's alone."""
    safe = place.rename(place.with_name("safe"))
    place.mkdir()
    for one in safe.iterdir():
        (place / one.name).symlink_to(one)
    place.chmod(0o777)


WAYS = [
    pytest.param(lambda way: None, True, id="this user's alone"),
    pytest.param(lambda way: way.chmod(0o777), False, id="all may write"),
    pytest.param(lambda way: way.chmod(0o1777), True, id="all may write, and replace what is their own, as in /tmp"),
    pytest.param(lambda way: (os.chown(way, -1, 65534), way.chmod(0o770)), False, id="a group may write"),
    pytest.param(given, False, id="of another user"),
    pytest.param(lambda way: (given(way), way.chmod(0o1777)), False, id="of another user, sticky"),
    pytest.param(moved, False, id="a link into a folder that all may write"),
    pytest.param(reached_by_links, False, id="a link in a folder that all may write"),
    pytest.param(lambda way: (way.rename(f"{way}s"), way.symlink_to(f"{way}s")), True, id="a link of this user"),
]


@pytest.mark.parametrize("depth", [1, 2])
@pytest.mark.parametrize(("change", "is_safe"), WAYS)
def test_a_folder_is_trusted_only_where_nobody_else_can_replace_it(
    tmp_path: Path, depth: int, change: Callable[[Path], object], is_safe: bool
) -> None:
    """Whoever may write a folder above a cache can put a cache of his own in its place."""
    way = tmp_path / "way"
    folder = way.joinpath(*["folder"] * (depth - 1), "cache")
    folder.mkdir(parents=True)
    disk, kernel = Disk(folder / "answers", 100_000), OwnFiles(str(folder / "kernels"), "kernel", "stamp")
    disk.save(KEY, b"answer")
    (folder / "kernels").mkdir()
    kernel.save("signature", "code")
    change(way)
    assert disk.load(KEY) == (b"answer" if is_safe else None)
    disk.save(OTHER, b"other")
    assert disk.load(OTHER) == (b"other" if is_safe else None)
    if is_safe:
        assert kernel.load("signature") == "code"
        return
    for load in (lambda: kernel.load("signature"), lambda: require_trusted(folder / "missing")):
        with pytest.raises(UntrustedFileError):
            load()


def test_what_lies_above_the_home_folder_is_not_looked_at(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As OpenSSH does it; who sets up the machine answers for the folder of all homes."""
    home = tmp_path / "homes" / "ada"
    (home / "cache").mkdir(parents=True)
    home.parent.chmod(0o777)
    with pytest.raises(UntrustedFileError):
        require_trusted(home / "cache")
    monkeypatch.setattr(ownership.pwd, "getpwuid", lambda number: SimpleNamespace(pw_name="ada", pw_dir=str(home)))
    ownership._home.cache_clear()
    try:
        require_trusted(home / "cache")
        home.chmod(0o777)
        with pytest.raises(UntrustedFileError):
            require_trusted(home / "cache")
    finally:
        ownership._home.cache_clear()


def test_a_service_whose_kernels_others_may_write_has_a_folder_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given, caches = tmp_path / "kernels", tmp_path / "caches"
    given.mkdir()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(given))
    monkeypatch.setenv("XDG_CACHE_HOME", str(caches))
    kernels.take_own_folder()
    assert kernels.folder() == given
    given.chmod(0o777)
    kernels.take_own_folder()
    assert kernels.folder() == caches / "deltaq" / "kernels"
    require_trusted(kernels.folder())
    kernels.folder().chmod(0o777)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    kernels.take_own_folder()
    assert kernels.folder().parent == tmp_path
    require_trusted(kernels.folder())


def test_every_kernel_is_kept_in_files_that_are_looked_at() -> None:
    program = "from deltaq.simulation import kernels; from deltaq.packages import modules_of; "
    program += "from deltaq.simulation.kernels.compiler import Kernel as K; "
    program += "kept = [v for m in modules_of(kernels.__name__) for v in vars(m).values() if isinstance(v, K)]; "
    program += "print({type(k.compiled._cache._cache_file).__name__ for k in kept})"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "{'OwnFiles'}"


def test_a_group_of_one_user_alone_is_he_himself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tmp_path.chmod(0o775)
    user = SimpleNamespace(pw_name="ada", pw_dir="/")
    monkeypatch.setattr(ownership.pwd, "getpwuid", lambda number: user)
    for group, members, is_accepted in (
        ("ada", [], True),
        ("ada", ["ada"], True),
        ("ada", ["eve"], False),
        ("staff", [], False),
    ):
        entry = SimpleNamespace(gr_name=group, gr_mem=members)
        monkeypatch.setattr(ownership.grp, "getgrgid", lambda number, entry=entry: entry)
        ownership._is_private.cache_clear()
        if is_accepted:
            require_trusted(tmp_path)
        else:
            with pytest.raises(UntrustedFileError):
                require_trusted(tmp_path)
    ownership._is_private.cache_clear()
