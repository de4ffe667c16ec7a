"""How schemathesis writes a body of TOML: it is a text already."""

from __future__ import annotations

from typing import Any

import schemathesis


@schemathesis.serializer("application/toml")
def text(_context: Any, value: Any) -> bytes:
    """The text as bytes; what is no text has no TOML."""
    return value.encode("utf-8", "backslashreplace") if isinstance(value, str) else b"\xff"
