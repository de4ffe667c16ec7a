"""The answer to `POST /derivations`: plain data in, plain data out."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import cast

import sympy as sp

from ..derivation.engine import derive
from ..derivation.result import Result, result_of
from ..derivation.system import System
from ..language.latex_printer import Typography, latex
from ..language.plain_printer import plain
from ..mechanics.requests import changed_scene
from ..mechanics.scene import Scene
from .catalog import language_of
from .marks import Wrap, by_coordinate, in_class, unmarked
from .model_answer import equilibrium, routh
from .narrator import Narrator
from .notation import Notation
from .symbols import QuantitySymbols

Document = dict[str, object]


def derive_request(document: Mapping[str, object]) -> Document:
    """Derives what the request names. Raises InputError for what cannot be read.

    `document`: {scene: id or document, guides?, freeze?, parameters?, formulation?, lang?}, already checked for types.
    """
    scene = scene_of(document)
    formulation = str(document.get("formulation") or "dalembert-lagrange")
    system, derivation = derive(scene, formulation)
    narrator = _narrator(system, language_of(cast("str | None", document.get("lang"))))
    key = json.dumps(document, sort_keys=True, ensure_ascii=False)
    return {
        "id": hashlib.sha256(key.encode()).hexdigest()[:24],
        "scene": scene.id,
        "formulation": formulation,
        "chapters": narrator.chapters(derivation),
        "result": _written(result_of(system), narrator.clean.typography),
    }


def scene_of(document: Mapping[str, object]) -> Scene:
    """The scene a request names or brings, with its changes."""
    return changed_scene(
        document["scene"],
        cast("list[dict[str, str]]", document.get("guides") or []),
        cast("list[str]", document.get("freeze") or []),
        cast("dict[str, float]", document.get("parameters") or {}),
    )


def _narrator(system: System, language: str) -> Narrator:
    return Narrator(language, _notation(system, language, unmarked), _notation(system, language, in_class))


def _notation(system: System, language: str, wrap: Wrap) -> Notation:
    typography = Typography(system.scene.names, mark=by_coordinate(system.scene, wrap))
    names = {symbol.name: symbol.typeset for symbol in system.scene.names.symbols if symbol.kind == "coordinate"}
    return Notation(typography, QuantitySymbols(system.scene, language, names, wrap), system.h)


def _written(result: Result, typography: Typography) -> Document:
    """Each expression as plain text of the language and as LaTeX."""

    def both(value: sp.Expr) -> Document:
        return {"plain": plain(value), "latex": latex(value, typography)}

    def vector(value: sp.ImmutableMatrix) -> Document:
        return {"plain": [plain(component) for component in value], "latex": latex(value, typography)}

    def each(values: Mapping[str, sp.Expr], suffix: str = "") -> list[Document]:
        return [
            {"coordinate": q, "plain": plain(value) + suffix, "latex": latex(value, typography) + suffix}
            for q, value in values.items()
        ]

    return {
        "positions": {name: vector(value) for name, value in result.positions.items()},
        "virtual_displacements": {name: vector(value) for name, value in result.virtual_displacements.items()},
        "virtual_work": both(result.virtual_work),
        "kinetic_energy": both(result.kinetic_energy),
        "potential_energy": both(result.potential_energy),
        "generalized_forces": {
            "total": each(result.total_forces),
            "conservative": each(result.conservative_forces),
            "nonconservative": each(result.nonconservative_forces),
        },
        "lagrangian": both(result.lagrangian),
        "equations": each(result.equations, " = 0"),
        "mass_matrix": {
            "plain": [[plain(entry) for entry in row] for row in result.mass_matrix.tolist()],
            "latex": latex(result.mass_matrix, typography),
        },
        "forcing": vector(result.forcing),
        "conserved": [{"kind": c.kind, "coordinate": c.coordinate, **both(c.value)} for c in result.conserved],
        "equilibria": [equilibrium(linear, result.scene, typography) for linear in result.equilibria],
        "jacobi_energy": {**both(result.jacobi_energy), "equals_energy": result.is_energy},
        "routh": routh(result.routh, typography),
    }
