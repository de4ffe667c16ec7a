"""The result of a derivation as data: expressions as plain text, as LaTeX and in words, sums term by term."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import sympy as sp

from ..derivation.formula import Term
from ..derivation.generator import Generator
from ..derivation.rest_sets import RestSearch
from ..derivation.result import Conserved, Result
from ..derivation.result_history import Origins
from ..derivation.step import Origin
from .constraint_answer import constraint, contact, reaction, releasable, sticking
from .expression_writer import ExpressionWriter
from .model_answer import (
    contact_equilibrium,
    equilibrium,
    kink_equilibrium,
    load,
    own_symbols,
    rest_range,
    routh,
    search,
    steady,
)

Document = dict[str, object]


def written(result: Result, origins: Mapping[str, Mapping[str, Origins]], write: ExpressionWriter) -> Document:
    """The `result` of the answer to POST /derivations."""
    kinked = result.kinked or RestSearch()
    sums, resting = _Sums(result, origins, write), result.resting.found if result.resting else ()
    return {
        "degrees_of_freedom": result.scene.degrees_of_freedom,
        "positions": {name: write.vector(value) for name, value in result.positions.items()},
        "points": {name: write.vector(value) for name, value in result.points.items()},
        "virtual_displacements": {name: write.vector(value) for name, value in result.virtual_displacements.items()},
        "virtual_work": sums.sum("virtual_work", result.virtual_work),
        "kinetic_energy": sums.sum("kinetic_energy", result.kinetic_energy),
        "potential_energy": sums.sum("potential_energy", result.potential_energy),
        "generalized_forces": {
            "total": sums.each("total", result.total_forces),
            "conservative": sums.each("conservative", result.conservative_forces),
            "nonconservative": sums.each("nonconservative", result.nonconservative_forces),
        },
        "lagrangian": sums.sum("lagrangian", result.lagrangian),
        "equations": sums.each("equations", result.equations, is_equation=True),
        "mass_matrix": {**write.matrix(result.mass_matrix), "terms": sums.entries("mass_matrix")},
        "forcing": {**write.vector(result.forcing), "terms": sums.rows("forcing")},
        "conserved": [sums.conserved(each) for each in result.conserved],
        "symmetry_search": {"generators": list(result.generators)},
        "equilibria": [equilibrium(each, result.scene, write) for each in result.equilibria],
        "contact_equilibria": [contact_equilibrium(each, result.scene, write) for each in resting],
        "kink_equilibria": [kink_equilibrium(each, result.scene, write) for each in kinked.kinks],
        "rest_ranges": [rest_range(each, result.scene, write) for each in kinked.found],
        "equilibrium_search": search(result),
        "jacobi_energy": {**sums.sum("jacobi_energy", result.jacobi_energy), "equals_energy": result.is_energy},
        "loads": [load(each, write) for each in result.loads],
        "symbols": own_symbols(result, write),
        "constraints": [constraint(each, write) for each in result.constraints],
        "reactions": [reaction(each, write) for each in result.reactions],
        "releasable": releasable(result.scene, write),
        "routh": routh(result.routh, write),
        "relative_equilibria": [steady(each, number, write) for number, each in enumerate(result.steady, 1)],
        "contacts": [contact(each, write) for each in result.contacts],
        "sticking": [sticking(each, write) for each in result.sticking],
    }


@dataclass(frozen=True)
class _Sums:
    """Writes sums with their terms, each with the bodies and loads and the earlier terms that it comes from."""

    result: Result
    origins: Mapping[str, Mapping[str, Origins]]
    write: ExpressionWriter

    def sum(self, key: str, value: sp.Expr, coordinate: str = "", *, is_equation: bool = False) -> Document:
        """The expression, and its terms."""
        shown = self.write.equated(value) if is_equation else self.write.written(value)
        return {**shown, "terms": self._terms(key, coordinate)}

    def each(self, key: str, values: Mapping[str, sp.Expr], *, is_equation: bool = False) -> list[Document]:
        return [{"coordinate": q, **self.sum(key, value, q, is_equation=is_equation)} for q, value in values.items()]

    def rows(self, key: str) -> list[list[Document]]:
        """The terms of a vector, component by component."""
        return [self._terms(key, name) for name in self.result.terms[key]]

    def entries(self, key: str) -> list[list[list[Document]]]:
        """The terms of a matrix, row by row."""
        rows: dict[str, list[list[Document]]] = {name.split()[0]: [] for name in self.result.terms[key]}
        for name in self.result.terms[key]:
            rows[name.split()[0]].append(self._terms(key, name))
        return list(rows.values())

    def conserved(self, quantity: Conserved) -> Document:
        return {
            "kind": quantity.kind,
            "coordinate": quantity.coordinate,
            **self._integral(quantity),
            "generator": self._generator(quantity.generator),
            "meaning": quantity.meaning,
            "conditions": [self.write.equation(*pair) for pair in quantity.special.items()],
            "step": quantity.step,
            **({"contacts": list(quantity.contacts)} if quantity.contacts else {}),
        }

    def _integral(self, quantity: Conserved) -> Document:
        if quantity.kind == "symmetry":
            return self.sum("integrals", quantity.value, quantity.step)
        return self.sum("momentum" if quantity.coordinate else "jacobi_energy", quantity.value, quantity.coordinate)

    def _generator(self, generator: Generator) -> Document:
        shifts = {q: self.write.written(shift) for q, shift in generator.shifts.items()}
        return {"shifts": shifts, "time": self.write.written(generator.time)}

    def _terms(self, key: str, name: str) -> list[Document]:
        return list(map(self._term, self.result.terms[key][name], self.origins[key][name]))

    def _term(self, term: Term, origins: Iterable[Origin]) -> Document:
        return {
            **self.write.written(term.sign * term.written_out),
            "sources": list(term.sources),
            "from": [{"term": origin.term, "change": origin.change} for origin in origins],
        }
