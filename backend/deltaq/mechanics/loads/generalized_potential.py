"""Generalized potentials U(q, q̇, t), linear in the rates: a magnetic field, a rotating frame."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from random import Random
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression
from ...language.floats import evaluate
from ...language.spelling import spell_rate
from ...language.tree import Name, Rate, walk
from ..bodies import Body
from ..checks import demand
from ..contributions import GeneralizedPotential
from ..reader import Reader
from . import Places

POINTS = 8  # at which linearity is looked at
NEGLIGIBLE = 1e-9  # second difference of the rates, relative to the values


@dataclass(frozen=True)
class VelocityPotential:
    """A potential U(q, q̇, t) = U₀ + Σ aᵢ q̇ᵢ: Qᵢ = d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ, L = E − U; only U₀ counts as energy.

    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
    """

    kind: ClassVar[str] = "generalized-potential"

    name: str
    energy: Expression = field(metadata={"unit": "J"})

    def __post_init__(self) -> None:
        demand(next(self._problems(), None))

    def _problems(self) -> Iterator[Problem]:
        rates = sorted(self.energy.rates)
        if not rates:
            yield Problem("generalized-potential-without-rate", "/energy")
        for node in walk(self.energy.tree):
            if isinstance(node, Rate) and node.order > 1:
                parameters = {"coordinate": node.name}
                yield Problem("generalized-potential-with-acceleration", "/energy", parameters=parameters)
        if not _is_linear(self.energy):
            yield Problem("generalized-potential-not-linear", "/energy", parameters={"coordinate": rates[0]})

    @classmethod
    def read(cls, table: Reader) -> VelocityPotential:
        return cls(table.name(), table.expression("energy"))

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[GeneralizedPotential, ...]:
        return (GeneralizedPotential(self.name, self.energy.tree),)


def _is_linear(energy: Expression) -> bool:
    """Whether U(q, 2q̇) + 2U(q, −q̇) − 3U(q, 0) vanishes for all directions of q̇, by values at random."""
    random, seen = Random(1), 0
    names = sorted({node.name for node in walk(energy.tree) if isinstance(node, Name)} | {"t"})
    for _ in range(POINTS):
        values = {name: random.uniform(0.3, 1.7) for name in names}
        speeds = {spell_rate(name, 1): random.uniform(-1.7, 1.7) for name in energy.rates}
        back, twice, still = (
            evaluate(energy.tree, values | {rate: k * speed for rate, speed in speeds.items()}) for k in (-1, 2, 0)
        )
        if not all(map(math.isfinite, (back, twice, still))):
            continue
        seen += 1
        if abs(twice + 2 * back - 3 * still) > NEGLIGIBLE * max(abs(back), abs(twice), abs(still), 1e-300):
            return False
    return seen > 0
