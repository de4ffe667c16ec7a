"""The answer to `POST /variations`: plain data in, plain data out."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import replace

import sympy as sp

from ..contract.reading import read
from ..contract.variation import VariationRequest
from ..derivation.clearing import cleared, constant_of_motion
from ..derivation.differential_expression import direction
from ..derivation.domain import Instant, Interval
from ..derivation.formula import Equation, Explicit, Formula, Named, Quantity
from ..derivation.functional import Functional
from ..derivation.rules.integration_by_parts import boundary_term
from ..derivation.variation import vary
from ..errors import ExpressionError, Problem, RequestError
from ..language.names import Names
from ..language.plain_printer import plain
from ..language.spelling import latex_of, spell_rate
from .catalog import language_of
from .function_notation import FunctionNotation, FunctionSymbols, FunctionTypography
from .letters import OF_FUNCTIONALS, Letters, letters_of
from .marks import Wrap, in_class, unmarked
from .narrator import Narrator
from .notation import NEIGHBOUR
from .quotient_answer import quotient_answer
from .speech import Speech
from .variation_request import Question, read_question

Document = dict[str, object]


def vary_request(document: Mapping[str, object]) -> Document:
    """The first variation of what the request names. Raises InputError for what cannot be read.

    `document`: the fields of a VariationRequest.
    """
    asked = read(VariationRequest, document)
    question, language = read_question(asked), language_of(asked.lang)
    try:
        derivation = vary(question.functional)
    except ExpressionError as error:
        raise RequestError(*(problem.below("/expression") for problem in error.problems)) from None
    if not derivation.chapters[0].steps[0].verified:
        raise RequestError(Problem("value-undefined", "/expression"))  # nowhere could it be evaluated
    clean = _notation(question, unmarked)
    narrator = Narrator(language, _notation(question, in_class), _letters(question))
    key = json.dumps(document, sort_keys=True, ensure_ascii=False)
    answer: Document = {
        "id": hashlib.sha256(key.encode()).hexdigest()[:24],
        "chapters": narrator.chapters(derivation),
        "result": _result(question, clean, narrator.speech),
    }
    if "quotient" in asked.include:
        answer["quotient"] = quotient_answer(question, asked.numeric)
    return answer


def _notation(question: Question, wrap: Wrap) -> FunctionNotation:
    functional = question.functional
    directions = {x: latex_of(v) if v else "" for x, v in question.directions.items()}
    typography = FunctionTypography(
        functional.names, _mark(functional.names, wrap), directions=directions, h=latex_of(functional.h.name)
    )
    symbols = FunctionSymbols(
        {symbol.name: symbol.typeset for symbol in functional.names.symbols if symbol.kind == "coordinate"},
        wrap,
        letters=letters_of(functional.names, OF_FUNCTIONALS),
    )
    notation = FunctionNotation(typography, symbols, functional.h)
    if not isinstance(functional.domain, Instant):
        return notation
    at = notation.value(functional.expression(functional.domain.at))
    return FunctionNotation(typography, replace(symbols, at=at), functional.h)


def _letters(question: Question) -> Letters:
    """What stands in sentences for letters that the question has taken."""
    functional = question.functional
    small = {} if functional.h.name == "h" else {"h": latex_of(functional.h.name).replace("{", "{{").replace("}", "}}")}
    return {**letters_of(functional.names, OF_FUNCTIONALS), **small}


def _mark(names: Names, wrap: Wrap) -> Wrap:
    """The classes of the page: `q-0` for the first function and its rates, with `variation` for its direction."""
    numbers = {function: index for index, function in enumerate(names.coordinates)}

    def mark(name: str, latex: str) -> str:
        base = name.rstrip(")").rpartition("(")[2].rstrip(NEIGHBOUR)
        if base not in numbers:
            return latex
        return wrap(f"q-{numbers[base]}{' variation' if 'delta(' in name else ''}", latex)

    return mark


def _result(question: Question, notation: FunctionNotation, speech: Speech) -> Document:
    functional = question.functional
    both = _Writer(question, notation, speech)
    variation = functional.by_chain_rule
    first = both.vector(variation) | both.written(functional.on(Explicit(variation)))
    if isinstance(functional.domain, Instant):
        first["at"] = plain(functional.expression(functional.domain.at))
    if not isinstance(functional.domain, Interval):
        return {"first_variation": first}
    bounds = functional.interval
    interval = {"from": plain(bounds.lower), "to": plain(bounds.upper), "ends": functional.domain.ends}
    return {
        "first_variation": first | interval,
        "euler_lagrange": [
            {"function": x, **both.equation(functional.cleared_equation(x).value)} for x in functional.present
        ],
        "boundary_terms": [_boundary(functional, x, order, both) for x, order in functional.boundary],
        "first_integrals": [*_first_integrals(functional, both)],
    }


def _boundary(functional: Functional, function: str, order: int, both: _Writer) -> Document:
    """The factor times δx or δẋ, at both ends; at free ends the natural conditions: the factor is zero."""
    momentum, ends = functional.momentum(function, order), functional.free_ends(order)
    condition = both.equation(cleared(momentum, functional.symbols).value) if ends else None
    return {
        "function": function,
        "order": order,
        "plain": both.plain(momentum * direction(function, order)),
        **both.written(boundary_term(functional, Explicit(momentum), function, order)),
        "vanishes": not ends,
        "at": [plain(end) for end in ends],
        "condition": condition,
    }


def _first_integrals(functional: Functional, both: _Writer) -> Iterator[Document]:
    """What is constant along the solutions: momenta of functions that F does not hold, then Beltrami's."""
    found: list[tuple[str, str | None, sp.Expr]] = [
        ("momentum", x, functional.momentum(x)) for x in functional.ignorable
    ]
    if functional.has_energy:
        found.append(("energy", None, functional.energy))
    for kind, function, value in found:
        shown, _, _ = constant_of_motion(value, functional.symbols)
        yield {"kind": kind, "function": function, **both.constant(shown)}


class _Writer:
    """Expressions as plain text in the user's names, and as LaTeX."""

    def __init__(self, question: Question, notation: FunctionNotation, speech: Speech) -> None:
        self._notation = notation
        self._speech = speech
        self._named = {
            direction(x, n): sp.Symbol(spell_rate(v, n), real=True)
            for x, v in question.directions.items()
            if v
            for n in range(3)
        }

    def plain(self, value: sp.Expr) -> str:
        return plain(value.xreplace(self._named))

    def written(self, formula: Formula) -> Document:
        return {"latex": self._notation.formula(formula), "spoken": self._speech.formula(formula)}

    def vector(self, value: sp.Expr | sp.ImmutableMatrix) -> Document:
        text = [self.plain(c) for c in value] if isinstance(value, sp.MatrixBase) else self.plain(value)
        return {"plain": text, "latex": self._notation.value(value), "spoken": self._speech.value(value)}

    def constant(self, value: sp.Expr) -> Document:
        """What does not change."""
        named = Named(Quantity("constant"), value)
        return {"plain": self.plain(value), **self.written(Equation(Explicit(value), named))}

    def equation(self, left: sp.Expr) -> Document:
        latex, spoken = f"{self._notation.value(left)} = 0", self._speech.equated(left)
        return {"plain": f"{self.plain(left)} = 0", "latex": latex, "spoken": spoken}
