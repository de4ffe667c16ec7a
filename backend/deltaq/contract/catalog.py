"""Catalogs: the sentences of the page and the service."""

from __future__ import annotations

from pydantic import RootModel


class Sentences(RootModel[dict[str, "str | Sentences"]]):
    """Sentences by their keys, in sections."""
