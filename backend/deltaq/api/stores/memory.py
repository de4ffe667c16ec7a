"""A cache of answers in memory."""

from __future__ import annotations

from collections import OrderedDict

OVERHEAD = 200  # bytes of bookkeeping for each entry, roughly


class Memory:
    """Least recently used answers are dropped beyond `size` bytes."""

    name = "memory"

    def __init__(self, size: int) -> None:
        self.size = size
        self.used = 0
        self._entries: OrderedDict[str, bytes] = OrderedDict()

    def __len__(self) -> int:
        return len(self._entries)

    def load(self, key: str) -> bytes | None:
        """The answer of this key, None if it is missing."""
        if key in self._entries:
            self._entries.move_to_end(key)
        return self._entries.get(key)

    def save(self, key: str, answer: bytes) -> None:
        """Stores an answer, unless it alone is larger than `size`."""
        if key in self._entries:
            self.used -= _cost(self._entries.pop(key))
        if _cost(answer) > self.size:
            return
        self._entries[key] = answer
        self.used += _cost(answer)
        while self.used > self.size:
            _, dropped = self._entries.popitem(last=False)
            self.used -= _cost(dropped)


def _cost(answer: bytes) -> int:
    return len(answer) + OVERHEAD
