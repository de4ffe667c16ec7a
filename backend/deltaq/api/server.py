"""The server, which tells those who still wait when it ends."""

from __future__ import annotations

import asyncio
from typing import Any

import uvicorn

from .ending import PART, Ending

WAITING = 2048  # connections that may wait to be accepted


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
