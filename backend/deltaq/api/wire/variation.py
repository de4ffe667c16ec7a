"""Variations: the first variation of an expression or functional of functions of time."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from ..languages import Language
from .base import Answer, ExpressionText, Name, Names, Request, Values, examples
from .derivation import Chapter


class NamedFunction(Request):
    """A function of time or a parameter, and how to write it."""

    name: Name = Field(examples=["phi"])
    latex: Annotated[str, Field(max_length=64, pattern=r"^(\\[A-Za-z]+|[A-Za-z])(_(\w|\{\w{1,16}\}))?$")] | None = None


Texts = Annotated[dict[Name, ExpressionText], Field(max_length=8)]
Functions = Annotated[tuple[Name | NamedFunction, ...], Field(strict=False, min_length=1, max_length=8)]
Parameters = Annotated[tuple[Name | NamedFunction, ...], Field(strict=False, max_length=32)]


class ValueFunctional(Request):
    """The functional that takes the value of the expression at an instant: I(x) = x(t₀)."""

    kind: Literal["value"]
    at: ExpressionText = Field(description="a number or an expression of parameters", examples=["t0"])


class IntegralFunctional(Request):
    """The functional that integrates the expression over the time: I(x) = ∫ F(x, ẋ, t) dt."""

    kind: Literal["integral"]
    start: ExpressionText = Field(alias="from", description="a number or an expression of parameters", examples=["0"])
    to: ExpressionText = Field(examples=["T"])
    ends: Literal["fixed", "free", "fixed-free", "free-fixed"] = Field(
        "fixed", description="whether the functions are prescribed at both ends, or at the lower and at the upper one"
    )

    model_config = ConfigDict(serialize_by_alias=True)


class Numeric(Request):
    """Concrete functions for the comparison of difference quotient and derivative."""

    functions: Texts = Field(description="each function as an expression of t", examples=[{"x": "sin(t)"}])
    direction: Texts = Field(description="by function, its direction as an expression of t", examples=[{"x": "t^2"}])
    t: float = Field(0.0, description="the instant, unless the functional says where to look")
    parameters: Values = Field({}, description="values of parameters", examples=[{"l": 0.8}])


class VariationRequest(Request):
    """What to vary, and in which language."""

    expression: ExpressionText = Field(description="f, or the integrand F", examples=["l*sin(phi)"])
    syntax: Literal["plain", "latex"] = "plain"
    functions: Functions = Field(description="the functions of time; their rates are dot(x), ddot(x)", examples=[["x"]])
    direction: Names = Field((), description="names of the directions v; δ of each function if empty", examples=[["v"]])
    parameters: Parameters = Field((), description="everything else that is constant", examples=[["l"]])
    functional: ValueFunctional | IntegralFunctional | None = Field(None, discriminator="kind")
    include: Annotated[tuple[Literal["quotient"], ...], Field(strict=False, max_length=1)] = ()
    numeric: Numeric | None = None
    lang: Language | None = Field(None, description="language of the texts; else Accept-Language decides")

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


class VariationAnswer(Answer):
    """The first variation by two routes, and its results as plain expressions and as LaTeX.

    `result.first_variation.plain` is in delta(x) and dot(delta(x)), or in the names of the directions; for an integral
    it is the integrand, and `euler_lagrange` and `boundary_terms` are there too.
    """

    id: str = Field(description="content hash", examples=["9f3c…"])
    chapters: tuple[Chapter, ...]
    result: dict[str, Any]
    quotient: Quotient | None = None
