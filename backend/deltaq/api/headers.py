"""Security headers of every response."""

from __future__ import annotations

from collections.abc import Iterable

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

_ON_EVERYTHING = {"X-Content-Type-Options": "nosniff"}
_ON_DOCUMENTS = {
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
}
# Only what a browser shows as a page of its own needs a policy: its modules may fetch from here alone, and on dozens
# of them it would be dead weight.
_DOCUMENTS = ("text/html", "image/svg+xml")


def content_security_policy(*inline_scripts: str, frame_ancestors: Iterable[str] = ()) -> str:
    """Everything from here; the only inline scripts are those named by hash; styles are set by KaTeX and Plotly.

    `frame_ancestors` are the origins whose pages may show this one in a frame.
    """
    scripts = " ".join(["'self'", *(f"'{one}'" for one in inline_scripts)])
    ancestors = " ".join(["'self'", *frame_ancestors])
    return (
        f"default-src 'self'; script-src {scripts}; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
        "font-src 'self' data:; worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'self'; "
        f"frame-ancestors {ancestors}"
    )


class SecurityHeaders:
    """Adds the headers; a response may set a policy of its own."""

    def __init__(self, app: ASGIApp, frame_ancestors: Iterable[str]) -> None:
        self.app = app
        policy = content_security_policy(frame_ancestors=frame_ancestors)
        self.documents = _ON_EVERYTHING | _ON_DOCUMENTS | {"Content-Security-Policy": policy}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                is_document = headers.get("content-type", "").startswith(_DOCUMENTS)
                for name, value in (self.documents if is_document else _ON_EVERYTHING).items():
                    headers.setdefault(name, value)
            await send(message)

        await self.app(scope, receive, send_with_headers if scope["type"] == "http" else send)
