"""What a student's own variant of a task changes, in words: the statement says it, for no drawing says all of it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import sympy as sp

from ..language.latex_printer import Typography, latex
from ..mechanics.drawing import Element
from ..narration.catalog import text
from ..narration.prose import CatalogText, formula, joined
from ..narration.things import called
from .variants import Variant
from .workbook import Workbook

SCREEN = {0: "down", 1: "right", 2: "up", 3: "left"}  # quarter turns from downwards, counterclockwise


def variant_sentences(workbook: Workbook, language: str) -> Iterator[CatalogText]:
    """A sentence for each thing that is told otherwise; none for a scene as it is."""
    variant = workbook.variant
    for element in _counting(workbook, variant):
        yield _angle(workbook, element, language) if element.kind == "angle" else _length(workbook, element, language)
    if variant.factors:
        yield _factors(workbook, variant, language)


def _counting(workbook: Workbook, variant: Variant) -> list[Element]:
    """The elements that show a coordinate which is counted otherwise; of each coordinate the first."""
    shifted = variant.shift_of
    found: dict[object, Element] = {}
    for element in workbook.scene.drawing.elements:
        name = dict(element.options).get("coordinate")
        if element.kind in ("angle", "dimension") and (name in shifted or (variant.mirrored and name)):
            found.setdefault(name, element)
    return list(found.values())


def _symbol(workbook: Workbook, name: str) -> CatalogText:
    symbol = workbook.scene.names.get(name)
    return formula(symbol.typeset if symbol else name)


def _angle(workbook: Workbook, element: Element, language: str) -> CatalogText:
    options = dict(element.options)
    zero = options.get("offset", 0.0)
    quarter = round((zero if isinstance(zero, float) else 0.0) / (math.pi / 2)) % 4
    sense = "clockwise" if options.get("direction") == "clockwise" else "counterclockwise"
    return text(
        language,
        f"homework.variant.angle-{SCREEN[quarter]}",
        coordinate=_symbol(workbook, str(options["coordinate"])),
        sense=text(language, f"homework.variant.{sense}"),
    )


def _length(workbook: Workbook, element: Element, language: str) -> CatalogText:
    """Where the shown place is when the coordinate is zero, and where it goes when the coordinate grows."""
    name, place = str(dict(element.options)["coordinate"]), dict(element.places)["to"]
    solution = workbook.solution
    position = workbook.short(tuple(solution.position(place)))
    q = solution.q(name)
    growth = tuple(part.diff(q) for part in position)
    at_zero = sp.Matrix([[part.subs(q, 0) for part in position]])
    return text(
        language,
        "homework.variant.length",
        coordinate=_symbol(workbook, name),
        place=called(workbook.scene, place, language),
        position=_row(workbook, tuple(at_zero)),
        direction=_direction(workbook, growth, language),
    )


def _row(workbook: Workbook, parts: tuple[sp.Expr, ...]) -> CatalogText:
    typography = Typography(workbook.scene.names)
    return formula(r"\left(" + r",\; ".join(latex(part, typography) for part in parts) + r"\right)")


def _direction(workbook: Workbook, growth: tuple[sp.Expr, ...], language: str) -> CatalogText:
    """Along an axis in words as it is seen in the drawing, else as a vector."""
    along = [n for n, part in enumerate(growth) if part != 0]
    if len(along) != 1 or not growth[along[0]].is_Number:
        return joined(" ", [text(language, "homework.variant.towards"), _row(workbook, growth)])
    positive = growth[along[0]] > 0
    upward = positive == (workbook.scene.drawing.vertical == "up")
    word = ("right" if positive else "left") if along[0] == 0 else ("up" if upward else "down")
    return text(language, f"homework.variant.{word}")


def _factors(workbook: Workbook, variant: Variant, language: str) -> CatalogText:
    typography = Typography(workbook.scene.names)

    def multiple(name: str, factor: object) -> CatalogText:
        symbol = workbook.solution.q(name)
        told = formula(latex(sp.Rational(str(factor)) * symbol, typography))
        return text(language, "homework.variant.factor", multiple=told, symbol=_symbol(workbook, name))

    return text(language, "homework.variant.factors", list=joined(", ", (multiple(*pair) for pair in variant.factors)))
