"""Where forces at rest jump: switching functions s(q), and forces as they are on one side of s = 0.

Source: Filippov, Differential Equations with Discontinuous Righthand Sides, §4; Clarke, Optimization and Nonsmooth
Analysis, §2.5.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ..language.derivatives import diff
from ..language.memory import cached_method
from .matrix_form import forces_at_rest
from .system import System

JUMPS = (sp.sign, sp.Heaviside)
BENDS = (*JUMPS, sp.Abs, sp.Max, sp.Min)
DEEPEST = 6  # one within another

Signs = Mapping[sp.Expr, sp.Expr]


@cached_method
def switches(system: System) -> tuple[sp.Expr, ...]:
    """The functions s(q) at whose zeros a force jumps. One that is multiplied by zero there does not."""
    found: dict[sp.Expr, None] = {}
    numbers = dict(system.parameter_values)
    for force in forces_at_rest(system):
        for atom in force.atoms(*JUMPS):
            oriented = _oriented(system, atom.args[0])
            inner = atom.xreplace(numbers).atoms(*JUMPS)
            if oriented is not None and any(_jumps(system, force.xreplace(numbers), each) for each in inner):
                found[oriented[0]] = None
    return tuple(sorted(found, key=sp.default_sort_key))


@cached_method
def bends(system: System) -> tuple[sp.Expr, ...]:
    """The functions s(q) at whose zeros a force at rest is another expression, whether it jumps there or not."""
    atoms = (atom for force in forces_at_rest(system) for atom in force.atoms(*BENDS))
    found = (_oriented(system, argument) for argument in map(_argument, atoms) if argument is not None)
    return tuple(sorted({each[0] for each in found if each is not None}, key=sp.default_sort_key))


def beside(system: System, expression: sp.Basic, signs: Signs) -> sp.Basic:
    """The expression where the switching functions have these signs: −1 and 1, or what stands for one between."""
    for _ in range(DEEPEST):
        chosen = {atom: new for atom in expression.atoms(*BENDS) if (new := _on_side(system, atom, signs)) is not None}
        if not chosen:
            break
        expression = expression.xreplace(chosen)
    return expression


def _on_side(system: System, atom: sp.Expr, signs: Signs) -> sp.Expr | None:
    argument = _argument(atom)
    oriented = None if argument is None else _oriented(system, argument)
    if argument is None or oriented is None or oriented[0] not in signs:
        return None
    sign = oriented[1] * signs[oriented[0]]
    if isinstance(atom, sp.sign):
        return sign
    if isinstance(atom, sp.Heaviside):
        return (1 + sign) / 2
    if isinstance(atom, sp.Abs):
        return sign * argument
    larger = sign if isinstance(atom, sp.Max) else -sign
    return (sp.Add(*atom.args) + larger * argument) / 2


def _argument(atom: sp.Expr) -> sp.Expr | None:
    """What changes its sign where the expression switches; None of a maximum of more than two."""
    if not isinstance(atom, (sp.Max, sp.Min)):
        return atom.args[0]
    return atom.args[0] - atom.args[1] if len(atom.args) == 2 else None


def _oriented(system: System, argument: sp.Expr) -> tuple[sp.Expr, int] | None:
    """The argument without factors that no coordinate changes, and which way it goes; None if it never switches."""
    moving = set(map(system.q, system.free))
    factors = sp.Mul.make_args(sp.factor_terms(argument))
    rest = sp.Mul(*(each for each in factors if each.free_symbols & moving))
    still = sp.Mul(*(each for each in factors if not each.free_symbols & moving)).xreplace(
        dict(system.parameter_values)
    )
    if not rest.free_symbols & moving or not still.is_number or still == 0:
        return None
    way = 1 if sp.N(still) > 0 else -1
    return (-rest, -way) if rest.could_extract_minus_sign() else (rest, way)


def _is_multiple(difference: sp.Expr, value: sp.Expr, unknowns: list[sp.Symbol]) -> bool:
    """Whether one polynomial is a multiple of another, and so zero with it."""
    if not (value.is_polynomial(*unknowns) and difference.is_polynomial(*unknowns)):
        return False
    return bool(sp.reduced(difference.expand(), [value.expand()], *unknowns)[1] == 0)


def _jumps(system: System, force: sp.Expr, switch: sp.Expr) -> bool:
    """Whether a force is another one on either side of where a switch is zero; where that is not known, it is."""
    (value,) = switch.args[:1]
    difference = force.xreplace({switch: sp.Integer(1)}) - force.xreplace({switch: switch.func(-1)})
    slopes = {q: diff(value, q) for q in map(system.q, system.free) if value.has(q)}
    linear = next((q for q, slope in slopes.items() if slope.is_number and slope != 0), None)
    if linear is None:
        return bool(slopes) and not _is_multiple(difference, value, list(slopes))
    crossing = linear - value / slopes[linear]
    return not system.is_zero(difference.xreplace({linear: crossing}))
