"""Who asks: the address that a request comes from, and the account that its computations are charged to."""

from __future__ import annotations

from collections.abc import Coroutine, Generator
from contextvars import ContextVar
from ipaddress import IPv6Address, ip_address
from time import thread_time
from typing import Any, TypeVar

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from .workers.account import FREE, Account, Ledger

T = TypeVar("T")


class StepMeter:
    """Counts the processor time of the steps that coroutines take in the event loop, and not what runs between them."""

    def __init__(self) -> None:
        self.seconds = 0.0

    async def measured(self, coroutine: Coroutine[Any, Any, T]) -> T:
        """What the coroutine gives."""
        given: T = await _Steps(coroutine, self)
        return given


class _Steps:
    """Awaits a coroutine as `await` does (PEP 380, `yield from`), and lets a meter run during each step."""

    def __init__(self, coroutine: Coroutine[Any, Any, Any], meter: StepMeter) -> None:
        self._coroutine = coroutine
        self._meter = meter

    def __await__(self) -> Generator[Any, Any, Any]:
        step, given = self._coroutine.send, None
        while True:
            begin = thread_time()
            try:
                waited = step(given)
            except StopIteration as end:
                return end.value
            finally:
                self._meter.seconds += thread_time() - begin
            try:
                step, given = self._coroutine.send, (yield waited)
            except BaseException as error:  # noqa: BLE001  whatever it is, the coroutine is to have it
                step, given = self._coroutine.throw, error


ACCOUNT: ContextVar[Account] = ContextVar("account", default=FREE)
METER: ContextVar[StepMeter] = ContextVar("meter")


class Clients:
    """Opens the account of each request's client, and charges what a refusal costs; on loopback everything is free."""

    def __init__(self, app: ASGIApp, ledger: Ledger | None) -> None:
        self.app = app
        self.ledger = ledger

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        client = client_of(scope) if scope["type"] == "http" else ""
        account, meter, status = Account(client, self.ledger) if client else FREE, StepMeter(), 0

        async def watched(message: Message) -> None:
            nonlocal status
            status = message.get("status", status)
            await send(message)

        opened, started = ACCOUNT.set(account), METER.set(meter)
        try:
            await meter.measured(self.app(scope, receive, watched))  # type: ignore[arg-type]  # it is a coroutine
        finally:
            ACCOUNT.reset(opened)
            METER.reset(started)
            if status >= 400:
                account.pay(meter.seconds)


def client_of(scope: Scope) -> str:
    """The client's address; of version 6 the network, within which a client has as many as it likes; "" on loopback."""
    host, _ = scope.get("client") or ("", 0)
    try:
        address = ip_address(host)
    except ValueError:  # a socket of the file system
        return ""
    if isinstance(address, IPv6Address):
        address = address.ipv4_mapped or address
    if address.is_loopback:
        return ""
    return f"{address.exploded[:19]}::/64" if isinstance(address, IPv6Address) else str(address)
