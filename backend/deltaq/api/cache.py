"""Answers by the hash of their question: in memory, then in slower stores, then computed once for all who ask."""

from __future__ import annotations

import asyncio
import hashlib
import json
from collections import Counter
from functools import partial
from typing import Any

from .flights import Compute, Flights, OnUpdate, ignore
from .stores.memory import Memory
from .stores.store import Store


def content_hash(*parts: Any) -> str:
    """A name for a JSON value that depends on nothing but its content; the order of object members does not count."""
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


class Cache:
    """A memory and stores behind it, the fastest first. Used from one event loop."""

    def __init__(self, memory: Memory, *stores: Store) -> None:
        self.memory = memory
        self.stores = stores
        self.hits: Counter[str] = Counter({memory.name: 0} | {store.name: 0 for store in stores})
        self.misses = 0
        self._flights = Flights()

    async def find(self, key: str) -> bytes | None:
        """The answer of this key, if it is anywhere."""
        answer = self.memory.load(key)
        if answer is not None:
            self.hits[self.memory.name] += 1
        return answer or await self._find_in_stores(key)

    async def get(self, key: str, compute: Compute, on_update: OnUpdate = ignore) -> bytes:
        """The answer of this key, computed if need be; `on_update` receives its parts before.

        Errors reach all who wait, and are not cached.
        """
        answer = self.memory.load(key)
        if answer is not None:
            self.hits[self.memory.name] += 1
            return answer
        return await self._flights.join(key, partial(self._found_or_computed, key, compute), on_update)

    async def renew(self, key: str, compute: Compute, on_update: OnUpdate = ignore) -> bytes:
        """The answer of this key computed now, in place of the cached one; a computation under way is new enough."""
        return await self._flights.join(key, partial(self._computed, key, compute), on_update)

    async def _found_or_computed(self, key: str, compute: Compute, publish: OnUpdate) -> bytes:
        answer = await self._find_in_stores(key)
        return await self._computed(key, compute, publish) if answer is None else answer

    async def _computed(self, key: str, compute: Compute, publish: OnUpdate) -> bytes:
        self.misses += 1
        answer = await compute(publish)
        await self.keep(key, answer)
        return answer

    async def keep(self, key: str, answer: bytes) -> None:
        """Puts an answer into the memory and all stores."""
        self.memory.save(key, answer)
        for store in self.stores:
            await asyncio.to_thread(store.save, key, answer)

    async def _find_in_stores(self, key: str) -> bytes | None:
        """The answer from the first store that has it; the memory has it, too, from then on."""
        for store in self.stores:
            answer = await asyncio.to_thread(store.load, key)
            if answer is not None:
                self.hits[store.name] += 1
                self.memory.save(key, answer)
                return answer
        return None
