"""What a hall is asked besides the tasks: results of steps that are chosen among wrong ones, but not worked out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from types import MappingProxyType
from typing import cast

import sympy as sp

from ..derivation.formula import Quantity as Symbol
from ..derivation.impacts import bouncing, frictions, holding_force
from ..narration.symbols import QuantitySymbols
from .equality import Equality, Parts, expression, holding
from .quantity import Quantity
from .solution import Solution
from .task import Task

BLOCKS = (
    r"\begin{{bmatrix}} \mathbf M & {} \\ \mathbf A & \mathbf 0 \end{{bmatrix}}"
    r"\begin{{bmatrix}} \ddot{{\mathbf q}} \\ -\boldsymbol\lambda \end{{bmatrix}} ="
    r"\begin{{bmatrix}} \mathbf f \\ {} \end{{bmatrix}}"
)
TRANSPOSED = MappingProxyType({1: r"\mathbf A^T", -1: r"-\mathbf A^T", 0: r"\mathbf 0"})
DRIFT = MappingProxyType({1: r"-\boldsymbol\gamma", -1: r"\boldsymbol\gamma", 0: r"\mathbf 0"})


def _rows(solution: Solution, _subject: str) -> Parts:
    """What every row of the augmented system says to be zero, but for what M and f say."""
    reactions = (solution.reaction(q) for q in solution.free)
    rates = (
        sp.Add(*(solution.coefficient(each, q) * solution.acceleration(q) for q in solution.bound(each)))
        + solution.drift_term(each)
        for each in solution.conditions
    )
    return (*reactions, *rates)


EXACT, HOLDING = (cast("Equality", module) for module in (expression, holding))
AUGMENTED, GAP_RATE, HOLDING_FORCE = "augmented-system", "gap-rate", "holding-force"

ASKED: tuple[Quantity, ...] = (
    Quantity(
        "constraint",
        "equation",
        HOLDING,
        lambda solution, source: (solution.kept(source),),
        lambda solution: [condition.source for condition in solution.conditions],
        "constraints",
        steps=("constraint:{subject}",),
    ),
    Quantity(
        AUGMENTED,
        "equations",
        EXACT,
        _rows,
        lambda solution: ("",) if solution.conditions else (),
        "constraints",
        steps=("augmented-system",),
    ),
    Quantity(
        GAP_RATE,
        "expression",
        EXACT,
        lambda solution, contact: (solution.gap_rate(contact),),
        lambda solution: [event.name for event in bouncing(solution.model)],
        "contact",
        steps=("contact-gap:{subject}",),
    ),
    Quantity(
        HOLDING_FORCE,
        "expression",
        EXACT,
        lambda solution, load: (solution.holding_force(load),),
        lambda solution: [load.source for load in frictions(solution.model) if holding_force(solution.model, load)],
        "contact",
        steps=("sticking-condition:{subject}",),
    ),
)


def asked_of_halls(solution: Solution) -> Iterator[Task]:
    """All of them, of all that they can be asked of."""
    for quantity in ASKED:
        for subject in quantity.subjects(solution):
            yield Task(quantity, subject)


def left_side(task: Task, solution: Solution, symbols: QuantitySymbols) -> str:
    """What the step calls what is asked, where it tells other things, too; else nothing."""
    if task.quantity.kind == GAP_RATE:
        several = len(bouncing(solution.model)) > 1
        gap = symbols.latex(Symbol("gap", task.subject if several else ""))
        return rf"\frac{{\mathrm{{d}} {gap}}}{{\mathrm{{d}} t}} ={{}}"
    return symbols.latex(Symbol(HOLDING_FORCE, task.subject)) + " ={}" if task.quantity.kind == HOLDING_FORCE else ""


def blocks(solution: Solution, true: Solution) -> str:
    """The augmented system by its blocks, as a solution has them; nothing where it cannot be told by them."""
    count = len(true.free)
    still = {true.acceleration(q): true.zero for q in true.free}
    own, right = ([row.xreplace(still) for row in _rows(each, "")] for each in (solution, true))
    transposed, drift = _sign(own[:count], right[:count]), _sign(own[count:], right[count:])
    return "" if transposed is None or drift is None else BLOCKS.format(TRANSPOSED[transposed], DRIFT[drift])


def _sign(own: Sequence[sp.Expr], right: Sequence[sp.Expr]) -> int | None:
    """Of which sign rows are as they should be, 0 where nothing is left of them; None where they are something else."""
    pairs = list(zip(own, right, strict=True))
    wanted = {1: right, -1: [-each for each in right], 0: [sp.Integer(0)] * len(pairs)}
    fits = (sign for sign, rows in wanted.items() if all(sp.expand(a - b) == 0 for a, b in zip(own, rows, strict=True)))
    return next(fits, None)
