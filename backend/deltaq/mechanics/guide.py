"""Guides: coordinates whose motion is given."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.expression import Expression


@dataclass(frozen=True)
class Guide:
    """q := value(t). The coordinate is no longer free: it has no variation, and the system one degree less."""

    coordinate: str
    value: Expression
