"""Dimensions of an answer: terms that cannot be added, and a unit other than the one asked for."""

from __future__ import annotations

from ..errors import ExpressionError, Problem
from ..language.latex_printer import Typography, latex
from ..language.parser import Syntax, parse
from ..language.plain_printer import plain
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..mechanics.homogeneity import DimensionCheck
from ..mechanics.reaction_units import units_of
from ..mechanics.scene import Scene
from ..mechanics.units import Dimension
from ..narration.prose import formula
from .equality import Parts
from .reading import Reading, sums

Told = tuple[str, dict[str, str]]


def unlike_terms(reading: Reading, scene: Scene, syntax: Syntax) -> Told | None:
    """The message on the first term whose dimension differs from that of the terms before it; None if all fit."""
    for text, tree in reading.trees:
        for part in sums(tree):
            check = DimensionCheck(units_of(scene), text, [])
            check.of(part)
            for problem in check.problems:
                return "wrong-dimension", _told(problem, scene, syntax)
    return None


def other_unit(reading: Reading, right: Parts, scene: Scene) -> Told | None:
    """The message on an answer whose terms fit together but whose dimension is not that of the right answer."""
    check = DimensionCheck(units_of(scene), "", [])
    known = (check.of(parse(plain(part), scene.names).tree) for part in right)
    expected = next((each for each in known if isinstance(each, Dimension)), None)
    for _, tree in reading.trees if expected else ():
        for found in map(check.of, sums(tree)):
            if expected and isinstance(found, Dimension) and not found.fits(expected):
                return "other-unit", {"found": str(found), "expected": str(expected)}
    return None


def _told(problem: Problem, scene: Scene, syntax: Syntax) -> dict[str, str]:
    """The term as a formula."""
    told = {key: str(value) for key, value in problem.parameters.items()}
    term = str(problem.parameters["term"])
    try:
        typeset = latex(to_sympy(parse(term, scene.names, syntax).tree, Symbols(scene.names)), Typography(scene.names))
    except ExpressionError:
        return told | {"term": f"“{term}”"}
    return told | {"term": formula(typeset)}
