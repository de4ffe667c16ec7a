"""Who asks: the address that a request comes from, and the account that its computations are charged to."""

from __future__ import annotations

from contextvars import ContextVar
from ipaddress import IPv6Address, ip_address

from starlette.types import ASGIApp, Receive, Scope, Send

from .workers.account import FREE, Account, Ledger

ACCOUNT: ContextVar[Account] = ContextVar("account", default=FREE)


class Clients:
    """Opens the account of each request's client; on loopback everything is free."""

    def __init__(self, app: ASGIApp, ledger: Ledger | None) -> None:
        self.app = app
        self.ledger = ledger

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        client = client_of(scope) if scope["type"] == "http" else ""
        opened = ACCOUNT.set(Account(client, self.ledger) if client else FREE)
        try:
            await self.app(scope, receive, send)
        finally:
            ACCOUNT.reset(opened)


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
