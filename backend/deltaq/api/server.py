"""The server, which tells those who still wait when it ends."""

from __future__ import annotations

import asyncio
import ctypes
from typing import Any

import uvicorn

from .ending import PART, Ending

WAITING = 2048  # connections that may wait to be accepted
MAPPED = 2**16  # bytes from which glibc gives a block to the system again when it is freed
_M_MMAP_THRESHOLD = -3  # mallopt(3)


class Server(uvicorn.Server):
    """Accepts connections a few at a time, and ends with an answer to everybody."""

    async def startup(self, sockets: list[Any] | None = None) -> None:
        """Uvicorn's backlog is also how many connections it accepts before it looks at any; more of them may wait."""
        await super().startup(sockets)
        for listener in sockets or ():
            listener.listen(WAITING)

    async def shutdown(self, sockets: list[Any] | None = None) -> None:
        """Requests under way get some time, and those that need more get a problem document."""
        ending: Ending = self.config.loaded_app.state.service.ending
        asyncio.get_running_loop().call_later(PART * (self.config.timeout_graceful_shutdown or 0), ending.begin)
        await super().shutdown(sockets)


def give_large_blocks_back() -> None:
    """Keep the memory of large bodies from staying with the process, where the C library has a setting for that.

    By default glibc raises the threshold with the first large block that is freed; megabytes of bodies then lie between
    small blocks that stay, and the heap never shrinks (mallopt(3), M_MMAP_THRESHOLD).
    """
    library = ctypes.CDLL(None)
    if hasattr(library, "mallopt"):
        library.mallopt(_M_MMAP_THRESHOLD, MAPPED)
