"""Where each term of a result comes from: the terms of the step that says what it is.

A term of a result is compared with those of the line that concludes the step, product by product of their normal
forms, as the lines of the steps are among themselves (`history`). An entry of the mass matrix is what an equation's
term is derived to by an acceleration; the forcing stands on the other side of the equations; the conservative forces
are what the terms of the potential energy are derived to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TypeAlias

import sympy as sp

from . import formula as f
from .formula import Quantity, Term
from .history import Candidate, History
from .normal_algebra import NormalAlgebra
from .premises import Signature, concluded
from .step import Derivation, Origin, Step, Summand
from .system import System

Origins: TypeAlias = tuple[tuple[Origin, ...], ...]  # of each term of a sum
KINDS = {
    "virtual_work": "virtual-work",
    "kinetic_energy": "kinetic-energy",
    "potential_energy": "potential-energy",
    "lagrangian": "lagrangian",
    "jacobi_energy": "jacobi-energy",
    "total": "generalized-force",
    "nonconservative": "nonconservative-force",
    "momentum": "momentum",
}


def result_origins(
    derivation: Derivation, system: System, terms: Mapping[str, Mapping[str, tuple[Term, ...]]]
) -> dict[str, dict[str, Origins]]:
    """The origins of all terms of a result, by what they add up to and by coordinate, as `Result.terms` has them."""
    told = _Told(system, {step.id: step for step in derivation.steps()})
    return {key: {name: told.origins(key, name, its) for name, its in sums.items()} for key, sums in terms.items()}


@dataclass(frozen=True)
class _Told:
    """The steps of a derivation by their ids, and the terms of what they say something is."""

    system: System
    steps: Mapping[str, Step]
    known: dict[Signature, tuple[Summand, ...]] = field(default_factory=dict)
    history: History = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "history", History(NormalAlgebra(self.system.coordinates)))
        for step in self.steps.values():
            for relation, members in zip(step.relations, step.lines, strict=True):
                for name in concluded(relation):
                    self.known.setdefault(name, members[-1].terms)

    def origins(self, key: str, name: str, terms: tuple[Term, ...]) -> Origins:
        """The origins of the terms of one sum."""
        if not terms:
            return ()
        values = (f.Explicit(term.sign * term.written_out) for term in terms)
        written = (Summand("", v, v, sources=term.sources) for v, term in zip(values, terms, strict=True))
        if key == "mass_matrix":
            coordinate, other = name.split()
            acceleration = self.system.acceleration(other)
            terms_of_equation = self._differentiated(self._equation(coordinate), partial(f.Partial, by=acceleration))
            return self.history.came_from(written, tuple(terms_of_equation))
        if key == "conservative":
            by = self.system.q(name)
            energy = self._of(Quantity("potential-energy"))
            slopes = self._differentiated(energy, lambda of: f.Plus((f.minus(f.Partial(of, by)),)))
            return self.history.came_from(written, tuple(slopes))
        if key == "forcing":
            return self.history.came_from(written, tuple(self._turned(self._equation(name))))
        return self.history.came_from(written, tuple(_candidates(self._line(key, name))))

    def _line(self, key: str, name: str) -> tuple[Summand, ...]:
        """The last line of what says what it is."""
        if key == "equations":
            return self._equation(name)
        if key == "integrals":
            return self._of_step(name)
        named = self._of(Quantity(KINDS[key], name))
        # Where all loads but one have a potential, no step has a name for the rest.
        return named or self._of(Quantity("generalized-force", name)) if key == "nonconservative" else named

    def _of(self, quantity: Quantity) -> tuple[Summand, ...]:
        return self.known.get(("of", quantity), ())

    def _equation(self, coordinate: str) -> tuple[Summand, ...]:
        return self._of_step(f"equation:{coordinate}")

    def _of_step(self, name: str) -> tuple[Summand, ...]:
        step = self.steps.get(name)
        return step.lines[0][-1].terms if step and step.lines else ()

    def _differentiated(
        self, terms: tuple[Summand, ...], slope: Callable[[f.Formula], f.Formula]
    ) -> Iterator[Candidate]:
        for term in terms:
            yield Candidate(term.id, slope(term.alone), term.alone, term.side, "differentiated", term.sources)

    def _turned(self, terms: tuple[Summand, ...]) -> Iterator[Candidate]:
        """On the other side, without accelerations."""
        at_rest = {self.system.acceleration(q): sp.Integer(0) for q in self.system.free}
        for term in terms:
            rest = f.Substituted(f.Plus((f.minus(term.alone),)), at_rest)
            yield Candidate(term.id, rest, term.alone, term.side, None, term.sources)


def _candidates(terms: tuple[Summand, ...]) -> Iterator[Candidate]:
    return (Candidate(term.id, term.alone, term.alone, term.side, None, term.sources) for term in terms)
