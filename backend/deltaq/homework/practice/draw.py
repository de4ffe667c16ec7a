"""Draws that are the same on every machine: of a seed, only the sequence that Python guarantees is used."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import TypeVar

T = TypeVar("T")


class Draw:
    """A source of choices. Two with the same seed choose alike, whatever the version of Python and its hashes."""

    def __init__(self, *seed: object) -> None:
        self._source = random.Random("/".join(map(str, seed)))

    def chance(self, probability: float) -> bool:
        """True with this probability."""
        return self._source.random() < probability

    def one_of(self, options: Sequence[T]) -> T:
        """One of these, each as likely as any other."""
        return options[int(self._source.random() * len(options))]

    def shuffled(self, options: Sequence[T]) -> tuple[T, ...]:
        """All of these in any order."""
        keys = sorted((self._source.random(), index) for index in range(len(options)))
        return tuple(options[index] for _, index in keys)

    def some_of(self, options: Sequence[T], most: int) -> tuple[T, ...]:
        """So many of these at most, none among them as well."""
        return self.shuffled(options)[: int(self._source.random() * (most + 1))]
