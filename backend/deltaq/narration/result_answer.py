"""The result of a derivation as data: each expression as plain text of the language, as LaTeX, and term by term."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from ..derivation.formula import Term
from ..derivation.generator import Generator
from ..derivation.result import Conserved, Result
from ..language.latex_printer import Typography, latex
from ..language.order import Order
from ..language.plain_printer import plain
from .model_answer import equilibrium, load, own_symbols, routh, search, steady
from .speech import Speech

Document = dict[str, object]


def written(result: Result, typography: Typography, speech: Speech) -> Document:
    """The `result` of the answer to POST /derivations."""
    write = _Writer(result, typography, speech)
    return {
        "positions": {name: write.vector(value) for name, value in result.positions.items()},
        "points": {name: write.vector(value) for name, value in result.points.items()},
        "virtual_displacements": {name: write.vector(value) for name, value in result.virtual_displacements.items()},
        "virtual_work": write.sum("virtual_work", result.virtual_work),
        "kinetic_energy": write.sum("kinetic_energy", result.kinetic_energy),
        "potential_energy": write.sum("potential_energy", result.potential_energy),
        "generalized_forces": {
            "total": write.each("total", result.total_forces),
            "conservative": write.each("conservative", result.conservative_forces),
            "nonconservative": write.each("nonconservative", result.nonconservative_forces),
        },
        "lagrangian": write.sum("lagrangian", result.lagrangian),
        "equations": write.each("equations", result.equations, " = 0"),
        "mass_matrix": {
            "plain": [[plain(entry, write.order) for entry in row] for row in result.mass_matrix.tolist()],
            "latex": latex(result.mass_matrix, typography),
            "spoken": speech.value(result.mass_matrix),
            "terms": write.entries("mass_matrix"),
        },
        "forcing": {**write.vector(result.forcing), "terms": write.rows("forcing")},
        "conserved": [write.conserved(each) for each in result.conserved],
        "equilibria": [equilibrium(each, result.scene, typography) for each in result.equilibria],
        "equilibrium_search": search(result.search),
        "jacobi_energy": {**write.sum("jacobi_energy", result.jacobi_energy), "equals_energy": result.is_energy},
        "loads": [load(each, typography) for each in result.loads],
        "symbols": own_symbols(result),
        "routh": routh(result.routh, typography),
        "relative_equilibria": [steady(each, number, typography) for number, each in enumerate(result.steady, 1)],
    }


@dataclass(frozen=True)
class _Writer:
    result: Result
    typography: Typography
    speech: Speech
    order: Order = field(default_factory=Order)

    def both(self, value: sp.Expr, suffix: str = "") -> Document:
        return {"plain": plain(value, self.order) + suffix, "latex": latex(value, self.typography) + suffix}

    def vector(self, value: sp.ImmutableMatrix) -> Document:
        text = [plain(component, self.order) for component in value]
        return {"plain": text, "latex": latex(value, self.typography), "spoken": self.speech.value(value)}

    def sum(self, key: str, value: sp.Expr, coordinate: str = "", suffix: str = "") -> Document:
        """The expression, and its terms with the bodies and loads they come from."""
        terms = self.result.terms[key][coordinate]
        spoken = self.speech.equated(value) if suffix else self.speech.value(value)
        return {**self.both(value, suffix), "spoken": spoken, "terms": [self._term(term) for term in terms]}

    def each(self, key: str, values: Mapping[str, sp.Expr], suffix: str = "") -> list[Document]:
        return [{"coordinate": q, **self.sum(key, value, q, suffix)} for q, value in values.items()]

    def rows(self, key: str) -> list[list[Document]]:
        """The terms of a vector, component by component."""
        return [[self._term(term) for term in terms] for terms in self.result.terms[key].values()]

    def entries(self, key: str) -> list[list[list[Document]]]:
        """The terms of a matrix, row by row."""
        rows: dict[str, list[list[Document]]] = {name.split()[0]: [] for name in self.result.terms[key]}
        for name, terms in self.result.terms[key].items():
            rows[name.split()[0]].append([self._term(term) for term in terms])
        return list(rows.values())

    def conserved(self, quantity: Conserved) -> Document:
        return {
            "kind": quantity.kind,
            "coordinate": quantity.coordinate,
            **self._integral(quantity),
            "generator": self._generator(quantity.generator),
            "meaning": quantity.meaning,
            "conditions": [self.both(condition, " = 0") for condition in quantity.conditions],
            "step": quantity.step,
        }

    def _integral(self, quantity: Conserved) -> Document:
        """With the bodies and loads that its terms come from."""
        if quantity.kind == "symmetry":
            terms = self.result.terms["integrals"][quantity.step]
            return {**self.both(quantity.value), "terms": [self._term(term) for term in terms]}
        key = "momentum" if quantity.coordinate else "jacobi_energy"
        return self.sum(key, quantity.value, quantity.coordinate)

    def _generator(self, generator: Generator) -> Document:
        shifts = {q: self.both(shift) for q, shift in generator.shifts.items()}
        return {"shifts": shifts, "time": self.both(generator.time)}

    def _term(self, term: Term) -> Document:
        return {**self.both(term.sign * term.written_out), "sources": list(term.sources)}
