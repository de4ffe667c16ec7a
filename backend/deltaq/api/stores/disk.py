"""A cache of answers in a folder, which outlives the service and may be shared by several on one machine."""

from __future__ import annotations

import logging
import os
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

from ...ownership import UntrustedFileError, require_trusted, require_trusted_state
from .store import verified, with_digest

LOGGER = logging.getLogger("deltaq.cache")
FILL = 0.9  # part of `size` that stays in use after an eviction
_KEY = re.compile(r"[0-9a-f]{32}(\.[a-z]+)?")  # of a kind that can be asked for by its id, or not


class Disk:
    """One file for each answer; the least recently used go when there are more than `size` bytes.

    Answers that others may have written are not given, and none are written where others may write.
    """

    name = "disk"

    def __init__(self, folder: Path, size: int) -> None:
        self.folder = folder
        self.size = size
        self._written = size  # so that the first answer looks at what is there already

    def load(self, key: str) -> bytes | None:
        """The answer of this key, None if it is missing; a damaged one is removed."""
        if not _KEY.fullmatch(key):  # it may come from an address
            return None
        file = self._file(key)
        try:
            answer = verified(key, self._read(file))
            if answer is None:
                LOGGER.warning("a damaged answer was removed")
                file.unlink(missing_ok=True)
            else:
                os.utime(file)
        except (FileNotFoundError, UntrustedFileError):
            return None
        except OSError as error:
            LOGGER.warning("the cache on disk cannot be read: %s", error.strerror)
            return None
        return answer

    def save(self, key: str, answer: bytes) -> None:
        """Stores an answer; its file appears whole or not at all."""
        content = with_digest(key, answer)
        try:
            self._write(self._file(key), content)
            self._written += len(content)
            if self._written > self.size:
                self._evict()
        except UntrustedFileError:
            return
        except OSError as error:
            LOGGER.warning("the cache on disk cannot be written: %s", error.strerror)

    def _file(self, key: str) -> Path:
        return self.folder / key[:2] / f"{key}.answer"

    def _read(self, file: Path) -> bytes:
        """What nobody else can have written: a file of this user in folders of this user. Raises UntrustedFileError."""
        for folder in (self.folder, file.parent):
            require_trusted(folder)
        with os.fdopen(os.open(file, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as found:
            require_trusted_state(os.fstat(found.fileno()), str(file))
            return found.read()

    def _write(self, file: Path, content: bytes) -> None:
        for folder in (self.folder, file.parent):
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            require_trusted(folder)
        descriptor, name = tempfile.mkstemp(dir=file.parent, suffix=".new")
        try:
            with os.fdopen(descriptor, "wb") as new:
                new.write(content)
            Path(name).replace(file)
        except OSError:
            Path(name).unlink(missing_ok=True)
            raise

    def _evict(self) -> None:
        """Removes the least recently used answers, and files that somebody began to write and never ended."""
        files = sorted(self._entries(), reverse=True)  # the newest first
        left = FILL * self.size
        for _, length, file in files:
            left -= length
            if left < 0.0:
                file.unlink(missing_ok=True)
        self._written = int(min(FILL * self.size, sum(length for _, length, _ in files)))

    def _entries(self) -> Iterator[tuple[float, int, Path]]:
        """When each file was used last, its length, and the file."""
        for file in self.folder.glob("??/*"):
            try:
                state = file.stat()
            except FileNotFoundError:  # another service has just removed it
                continue
            yield state.st_mtime, state.st_size, file
