"""What a request may say about the method, and what came of it. Light: the web process reads it, too."""

from __future__ import annotations

from dataclasses import dataclass

from ..vocabulary import AUTO
from .library import get_method
from .method import Method


@dataclass(frozen=True)
class Choice:
    """A method, and the code of the reason in the catalog; None if the user chose."""

    method: Method
    reason: str | None = None


def check(wanted: str) -> None:
    """Raises UnknownNameError for a method that does not exist."""
    if wanted != AUTO:
        get_method(wanted)
