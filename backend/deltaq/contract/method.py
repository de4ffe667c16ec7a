"""Integration methods."""

from __future__ import annotations

from pydantic import Field

from .base import Answer


class MethodEntry(Answer):
    """A method and its properties."""

    id: str = Field(examples=["dop853"])
    title: str
    summary: str
    order: int = Field(examples=[8])
    stages: int = Field(examples=[12])
    family: str
    adaptive: bool
    symplectic: bool


class MethodList(Answer):
    """All methods."""

    methods: tuple[MethodEntry, ...]
