"""Variations: the first variation of an expression or functional of functions of time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import ConfigDict, Discriminator, Field, Tag

from ..vocabulary import Ends
from .base import OF_KIND, Answer, AskedLanguage, ExpressionText, Name, Names, Request, Syntax, Values, examples, items
from .derivation import Chapter
from .result import Formula

Latex = Annotated[str, Field(max_length=64, pattern=r"^(\\[A-Za-z]+|[A-Za-z])(_(\w|\{\w{1,16}\}))?$")]


class NamedFunction(Request):
    """A function of time or a parameter, and how to write it."""

    name: Name = Field(description="its name in expressions", examples=["phi"])
    latex: Latex | None = Field(None, description="how it is written; else by its name", examples=["\\varphi"])


def _form(given: object) -> str:
    """Whether a name comes with how it is written: so only what is wrong with that form is told."""
    return OF_KIND + ("written" if isinstance(given, Mapping | NamedFunction) else "name")


Texts = Annotated[dict[Name, ExpressionText], Field(max_length=8)]
Named = Annotated[
    Annotated[Name, Tag(OF_KIND + "name")] | Annotated[NamedFunction, Tag(OF_KIND + "written")], Discriminator(_form)
]
Functions = Annotated[tuple[Named, ...], items(min_length=1, max_length=8)]
Parameters = Annotated[tuple[Named, ...], items(max_length=32)]


class ValueFunctional(Request):
    """The functional that takes the value of the expression at an instant: I(x) = x(t₀)."""

    kind: Literal["value"] = Field(description="the value at an instant")
    at: ExpressionText = Field(description="a number or an expression of parameters", examples=["t0"])


class IntegralFunctional(Request):
    """The functional that integrates the expression over the time: I(x) = ∫ F(x, ẋ, t) dt."""

    kind: Literal["integral"] = Field(description="the integral over the time")
    start: ExpressionText = Field(alias="from", description="a number or an expression of parameters", examples=["0"])
    to: ExpressionText = Field(description="likewise", examples=["T"])
    ends: Ends = Field(
        "fixed",
        description="what is prescribed at both ends, or at the lower and at the upper one: the functions with the "
        "rates that need it (fixed), the functions alone (hinged), nothing (free)",
    )

    model_config = ConfigDict(serialize_by_alias=True)


def _kind(given: object) -> str:
    """Which of both a functional is meant to be: so only what is wrong with that one is told."""
    kind = given.get("kind") if isinstance(given, Mapping) else getattr(given, "kind", "integral")
    return f"{OF_KIND}{kind if isinstance(kind, str) else ''}"


Functional = Annotated[
    Annotated[ValueFunctional, Tag(OF_KIND + "value")] | Annotated[IntegralFunctional, Tag(OF_KIND + "integral")],
    Discriminator(_kind),
]


class Numeric(Request):
    """Concrete functions for the comparison of difference quotient and derivative."""

    functions: Texts = Field(description="each function as an expression of t", examples=[{"x": "sin(t)"}])
    direction: Texts = Field(description="by function, its direction as an expression of t", examples=[{"x": "t^2"}])
    t: float = Field(0.0, description="the instant, unless the functional says where to look")
    parameters: Values = Field({})


class VariationRequest(Request):
    """What to vary, and in which language."""

    expression: ExpressionText = Field(description="f, or the integrand F", examples=["l*sin(phi)"])
    syntax: Syntax = "plain"
    functions: Functions = Field(description="the functions of time; their rates are dot(x), ddot(x)", examples=[["x"]])
    direction: Names = Field((), description="names of the directions v; δ of each function if empty", examples=[["v"]])
    parameters: Parameters = Field((), description="everything else that is constant", examples=[["l"]])
    functional: Functional | None = Field(
        None, description="what is made of the expression; the expression itself if empty"
    )
    include: Annotated[tuple[Literal["quotient"], ...], items(max_length=1)] = Field(
        (), description="quotient: difference quotients of the concrete functions against the derivative"
    )
    numeric: Numeric | None = Field(None, description="the concrete functions")
    lang: AskedLanguage = None

    model_config = examples(
        {"expression": "[l*sin(phi), y + l*cos(phi)]", "functions": ["y", "phi"], "parameters": ["l"]},
        {
            "expression": "x",
            "functions": ["x"],
            "direction": ["v"],
            "parameters": ["t0"],
            "functional": {"kind": "value", "at": "t0"},
        },
        {
            "expression": "m*dot(x)^2/2 - k*x^2/2",
            "functions": ["x"],
            "parameters": ["m", "k", "T"],
            "functional": {"kind": "integral", "from": "0", "to": "T", "ends": "free"},
        },
        {
            "expression": "x^2*dot(x)",
            "functions": ["x"],
            "include": ["quotient"],
            "numeric": {"functions": {"x": "sin(t)"}, "direction": {"x": "t^2"}, "t": 0.7},
        },
    )


class Best(Answer):
    """Where the error is smallest."""

    h: float
    error: float


class QuotientErrors(Answer):
    """A difference quotient for every h: error = truncation + rounding; null where the expression has no value."""

    quotient: tuple[float | None, ...]
    truncation: tuple[float | None, ...]
    rounding: tuple[float | None, ...]
    error: tuple[float | None, ...]
    best: Best | None
    predicted: float | None = Field(description="where theory expects the smallest error; null if the error only falls")


class Curves(Answer):
    """The given functions and directions over the time; null where they have no value."""

    t: tuple[float, ...]
    at: float | None = Field(description="the instant that is looked at; null for an integral")
    functions: dict[str, tuple[float | None, ...]]
    direction: dict[str, tuple[float | None, ...]]


class Quotient(Answer):
    """Difference quotients in double precision against the derivative."""

    value: float
    derivative: float
    h: tuple[float, ...]
    one_sided: QuotientErrors
    central: QuotientErrors
    curves: Curves


class FirstVariation(Answer):
    """δ of the expression or functional; of an integral `plain` is the integrand."""

    plain: str | tuple[str, ...] = Field(
        description="in delta(x) and dot(delta(x)), or in the names of the directions; of a vector its components",
        examples=["l*cos(phi)*delta(phi)"],
    )
    latex: str
    spoken: str = Field("", description="the same in words, to be read aloud")
    at: str | None = Field(None, description="the instant, of a functional that takes a value")
    start: str | None = Field(None, alias="from", description="lower bound of an integral")
    to: str | None = Field(None, description="upper bound of an integral")
    ends: Ends | None = Field(None, description="what is prescribed at the ends of an integral")


class EulerLagrangeEquation(Formula):
    """The equation `… = 0` that belongs to a function, without denominators and common factors."""

    function: str = Field(examples=["x"])


class BoundaryTerm(Formula):
    """What integration by parts leaves at the ends: a factor times δx or δẋ."""

    function: str = Field(examples=["x"])
    order: int = Field(description="0: of δx, 1: of δẋ")
    vanishes: bool = Field(description="whether the ends prescribe what is varied")
    at: tuple[str, ...] = Field(description="the free ends, where it does not vanish")
    condition: Formula | None = Field(description="the natural condition there: the factor is zero")


class FirstIntegral(Formula):
    """What is constant along the solutions."""

    kind: Literal["momentum", "energy"]
    function: str | None = Field(description="whose momentum; null of the energy")


class VariationResult(Answer):
    """What comes of it; all but the first variation is there for an integral alone."""

    first_variation: FirstVariation
    euler_lagrange: tuple[EulerLagrangeEquation, ...] | None = None
    boundary_terms: tuple[BoundaryTerm, ...] | None = None
    first_integrals: tuple[FirstIntegral, ...] | None = None


class VariationAnswer(Answer):
    """The first variation by two routes, and its results as plain expressions and as LaTeX.

    Rates above the second are written dddot(x) and ddddot(x).
    """

    id: str = Field(description="content hash", examples=["9f3c…"])
    chapters: tuple[Chapter, ...]
    result: VariationResult
    quotient: Quotient | None = None
