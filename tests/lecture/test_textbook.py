"""Formulas are as long as in textbooks: operations shown over operations printed."""

from __future__ import annotations

import pytest
import sympy as sp
from tests.lecture.textbook_lines import Line, count, lines

from deltaq.derivation.matrix_form import forcing, left_side, mass_matrix
from deltaq.derivation.system import System
from deltaq.language.canonical import is_zero
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.symbols import Symbols
from deltaq.mechanics.library import load_scene, scene_ids

LONGEST = 1.2
SHARE = 0.9
ALL = [*lines(held_out=False), *lines(held_out=True)]


@pytest.mark.parametrize("line", ALL, ids=lambda line: line.id)
def test_what_is_printed_is_what_is_shown(line: Line) -> None:
    difference = line.printed_value - line.value
    assert is_zero(difference, Symbols(Names())) is True, line.shown
    numbers = {s: sp.Float(0.3 + 0.37 * i, 30) for i, s in enumerate(sorted(difference.free_symbols, key=str))}
    assert abs(difference.xreplace(numbers).evalf(30)) < 1e-20


@pytest.mark.parametrize("held_out", [False, True], ids=["worked with", "held out"])
def test_nine_of_ten_formulas_are_no_longer_than_the_printed_ones(held_out: bool) -> None:
    ratios = {line.id: line.ratio for line in lines(held_out=held_out)}
    longer = {name: ratio for name, ratio in ratios.items() if ratio > LONGEST}
    assert len(longer) <= (1 - SHARE) * len(ratios), longer


@pytest.mark.parametrize("line", ALL, ids=lambda line: line.id)
def test_no_unity_is_left_in_squares(line: Line) -> None:
    assert not _has_unity(line.value)


def _has_unity(value: sp.Expr) -> bool:
    """Whether sin² + cos² is in it, open or hidden: sin² and cos² of one angle with the same factors."""
    terms = [sp.Mul.make_args(term) for term in sp.Add.make_args(sp.expand(value))]
    sines, cosines = (
        {frozenset(_without(term, wave)) | {wave.args[0]} for term in terms for wave in _squared(term, function)}
        for function in (sp.sin, sp.cos)
    )
    return bool(sines & cosines)


@pytest.mark.parametrize("scene", scene_ids())
def test_no_unity_is_left_in_the_scenes_of_the_library(scene: str) -> None:
    system = System(load_scene(scene))
    shown = [system.kinetic_energy, system.potential_energy, *mass_matrix(system), *forcing(system)]
    assert not any(_has_unity(value) for value in [*shown, *(left_side(system, q) for q in system.free)])


def _squared(term: tuple[sp.Expr, ...], function: type) -> list[sp.Expr]:
    return [f.base for f in term if f.is_Pow and f.exp == 2 and isinstance(f.base, function)]


def _without(term: tuple[sp.Expr, ...], wave: sp.Expr) -> list[sp.Expr]:
    return [f for f in term if f != wave**2]


@pytest.mark.parametrize(
    ("text", "operations"),
    [
        ("x", 0), ("-x", 0), ("2*x", 1), ("m*x^2/2", 3), ("1/2*m*x^2", 3), ("1/x", 1), ("1/(2*x)", 2), ("3/x", 1),
        ("x/m", 1), ("sin(x)^2", 2), ("m*(x + 1)", 2), ("x - m", 1), ("sqrt(x^2 + m^2)", 4), ("m*x/(2*k)", 3),
        ("dot(x)^2", 1),
    ],
)  # fmt: skip
def test_operations_are_counted_as_they_are_read(text: str, operations: int) -> None:
    names = Names((Symbol("x", "coordinate"), Symbol("m", "parameter"), Symbol("k", "parameter")))
    assert count(parse(text, names).tree) == operations
