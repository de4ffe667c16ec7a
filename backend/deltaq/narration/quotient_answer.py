"""Difference quotient against derivative, as data for a chart."""

from __future__ import annotations

import math
from collections.abc import Mapping

import sympy as sp

from ..contract.variation import Numeric
from ..derivation.difference_quotient import SIZES, Quotients, compare
from ..derivation.functional import Functional
from ..derivation.functional_values import Motion, line_of
from ..derivation.motion_curves import Curves, curves_of
from ..errors import ExpressionError, Problem, RequestError, escaped
from ..language.names import Names
from ..language.parser import parse
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from .variation_request import Question

Document = dict[str, object]


def quotient_answer(question: Question, numeric: Numeric | None) -> Document:
    """Concrete functions → h, quotients, errors' parts, curves. RequestError for what is missing or has no value."""
    functional = question.functional
    if numeric is None:
        raise RequestError(Problem("missing-field", "/numeric", parameters={"field": "numeric"}))
    if len(functional.trees) > 1:
        raise RequestError(Problem("not-scalar", "/expression"))
    motion, time = _motion(functional, numeric), numeric.t
    compared = compare(line_of(functional, motion, time))
    if not (math.isfinite(compared.value) and math.isfinite(compared.derivative)):
        raise RequestError(Problem("value-undefined", "/numeric"))
    kinds = {kind: _written(quotients) for kind, quotients in compared.quotients.items()}
    drawn = _drawn(curves_of(functional, motion, time))
    return {"value": compared.value, "derivative": compared.derivative, "h": list(SIZES), **kinds, "curves": drawn}


def _motion(functional: Functional, numeric: Numeric) -> Motion:
    names = Names(tuple(s for s in functional.names.symbols if s.kind == "parameter"))
    given = numeric.parameters
    wanted = {symbol.name for symbol in names.symbols if symbol.kind == "parameter"}
    problems = [
        *(
            Problem("missing-field", f"/numeric/parameters/{n}", parameters={"field": n})
            for n in sorted(wanted - given.keys())
        ),
        *(
            Problem("unknown-field", f"/numeric/parameters/{escaped(n)}", parameters={"field": n[:40]})
            for n in sorted(given.keys() - wanted)
        ),
    ]
    if problems:
        raise RequestError(*problems)
    functions = _functions(functional, numeric.functions, "functions", names)
    directions = _functions(functional, numeric.direction, "direction", names)
    return Motion(functions, directions, given)


def _functions(functional: Functional, texts: Mapping[str, str], part: str, names: Names) -> dict[str, sp.Expr]:
    """Each function as an expression of the time."""
    return {x: _function(texts, x, f"/numeric/{part}/{x}", names) for x in functional.functions}


def _function(texts: Mapping[str, str], name: str, pointer: str, names: Names) -> sp.Expr:
    if name not in texts:
        raise RequestError(Problem("missing-field", pointer, parameters={"field": name}))
    try:
        expression = parse(texts[name], names)
        if not expression.is_scalar:
            raise RequestError(Problem("not-scalar", pointer))
        value = to_sympy(expression.tree, Symbols(names))
        if value.diff(Symbols(names).time, 2).has(sp.DiracDelta, sp.Derivative, sp.Subs):
            raise RequestError(Problem("not-differentiable", pointer))
    except ExpressionError as error:
        raise RequestError(*(problem.below(pointer) for problem in error.problems)) from None
    return value


def _written(quotients: Quotients) -> Document:
    """The parts as lists; `best` is where the error is smallest, `predicted` where the theory expects it."""
    best = quotients.best
    return {
        "quotient": _finite(quotients.quotient),
        "truncation": _finite(quotients.truncation),
        "rounding": _finite(quotients.rounding),
        "error": _finite(quotients.error),
        "best": None if best is None else {"h": SIZES[best], "error": quotients.error[best]},
        "predicted": quotients.predicted if math.isfinite(quotients.predicted) else None,
    }


def _drawn(curves: Curves) -> Document:
    functions, directions = (
        {name: _finite(values) for name, values in part.items()} for part in (curves.functions, curves.directions)
    )
    return {"t": list(curves.t), "at": curves.at, "functions": functions, "direction": directions}


def _finite(values: tuple[float, ...]) -> list[float | None]:
    return [value if math.isfinite(value) else None for value in values]
