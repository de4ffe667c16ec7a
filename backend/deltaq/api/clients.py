"""Who asks: the address that a request comes from, and the account that its computations are charged to.

Of the addresses that a request was forwarded for, those count that the configured proxies wrote: from the last one back
to the first that is no proxy of ours. What stands before it anybody may have written.
"""

from __future__ import annotations

from collections.abc import Coroutine, Generator, Iterator
from contextvars import ContextVar
from dataclasses import dataclass
from ipaddress import IPv4Address, IPv4Network, IPv6Address, IPv6Network, ip_address, ip_network
from time import thread_time
from typing import Any, TypeVar

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from .workers.account import FREE, Account, Ledger

T = TypeVar("T")
Address = IPv4Address | IPv6Address

UNKNOWN = "unknown"  # one client: whoever has no address, or claims one of the machine itself through a proxy
FORWARDED = "x-forwarded-for"
BY_PROXIES = (FORWARDED, "forwarded", "x-real-ip", "via")  # what nobody sends who is at the machine itself


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


@dataclass(frozen=True)
class Proxies:
    """The proxies whose word counts. Raises ValueError for what is no address and no network."""

    networks: tuple[IPv4Network | IPv6Network, ...] = ()

    @classmethod
    def of(cls, names: tuple[str, ...]) -> Proxies:
        """The networks of these names (CIDR)."""
        return cls(tuple(map(ip_network, names)))

    def __contains__(self, address: Address) -> bool:
        return any(address in network for network in self.networks)


class Clients:
    """Opens the account of each request's client, and charges what a refusal costs; the machine itself is free."""

    def __init__(self, app: ASGIApp, ledger: Ledger | None, proxies: Proxies) -> None:
        self.app = app
        self.ledger = ledger
        self.proxies = proxies

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        client, status, meter = "", 0, StepMeter()
        if scope["type"] == "http":
            client = client_of(scope, self.proxies)
            scope["scheme"] = scheme_of(scope, self.proxies)
        account = Account(client, self.ledger) if client else FREE

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


def client_of(scope: Scope, proxies: Proxies) -> str:
    """The client's address; of version 6 its network, in which it has as many as it likes; "" at the machine."""
    headers = Headers(scope=scope)
    address = _address((scope.get("client") or ("", 0))[0])
    by_proxy = any(name in headers for name in BY_PROXIES)
    if address and address in proxies and FORWARDED in headers:
        address = next((hop for hop in _hops(headers) if hop is None or hop not in proxies), None)
    if address is None or (address.is_loopback and by_proxy):
        return UNKNOWN
    if address.is_loopback:
        return ""
    return f"{address.exploded[:19]}::/64" if isinstance(address, IPv6Address) else str(address)


def scheme_of(scope: Scope, proxies: Proxies) -> str:
    """http or https, as a configured proxy was asked; else as we were."""
    peer = _address((scope.get("client") or ("", 0))[0])
    told = Headers(scope=scope).get("x-forwarded-proto", "").strip()
    return told if told in ("http", "https") and peer and peer in proxies else str(scope.get("scheme", "http"))


def _hops(headers: Headers) -> Iterator[Address | None]:
    """The addresses of X-Forwarded-For, the one written last first; None for what is none."""
    written = ",".join(headers.getlist(FORWARDED))
    return (_address(_without_port(hop.strip())) for hop in reversed(written.split(",")))


def _without_port(hop: str) -> str:
    """192.0.2.1:80 and [2001:db8::1]:80, as some proxies write them."""
    if hop.startswith("["):
        return hop[1:].partition("]")[0]
    return hop.partition(":")[0] if hop.count(":") == 1 else hop


def _address(text: str) -> Address | None:
    """The address; of version 4 also where it is written as one of version 6."""
    try:
        address = ip_address(text)
    except ValueError:
        return None
    return (address.ipv4_mapped or address) if isinstance(address, IPv6Address) else address
