"""What others may have written is not believed: answers, and kernels, whose files are pickles; the service works on."""

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
from deltaq.simulation.kernels.compiler import OwnFiles

KEY = "0123456789abcdef" * 2
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


def test_kernels_below_a_folder_of_all_are_not_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("deltaq.simulation.kernels.compiler.config", SimpleNamespace(CACHE_DIR=str(tmp_path)))
    kept = OwnFiles(str(tmp_path / "kernels"), "kernel", "stamp")
    (tmp_path / "kernels").mkdir()
    kept.save("signature", "code")
    tmp_path.chmod(0o777)
    with pytest.raises(UntrustedFileError):
        kept.load("signature")


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
    program = "from deltaq.simulation.kernels import linear as m; from numba.core.registry import CPUDispatcher as D; "
    program += "print({type(v._cache._cache_file).__name__ for v in vars(m).values() if isinstance(v, D)})"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "{'OwnFiles'}"


def test_a_group_of_one_user_alone_is_he_himself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tmp_path.chmod(0o775)
    user = SimpleNamespace(pw_name="ada")
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
