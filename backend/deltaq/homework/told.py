"""What the texts of a task speak of besides its subject, by the kind of its quantity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import sympy as sp

from ..derivation.generator import Generator
from ..derivation.impacts import contacts_along, contacts_with_losses, gap, restitution
from ..derivation.optional import motions_of
from ..language.latex_printer import Typography, latex
from ..narration.catalog import text
from ..narration.prose import CatalogText, formula, joined
from .feedback import label
from .model_questions import positions, steady
from .ordering.blocks import EQUATION, LAGRANGIAN
from .ordering.telling import wrong_block
from .subjects import contact_of
from .task import Task
from .workbook import Workbook

Texts = dict[str, CatalogText]

OF_REACTIONS = frozenset({"equation", "equations"})
OF_STATES = frozenset({"impulse", "momentum-behind", "impact-loss", "equilibria", "stability"})


def asked_about(task: Task, workbook: Workbook, language: str) -> Texts:
    """The values of a task's texts; none where the subject says all."""
    told = TOLD.get(task.quantity.kind)
    return told(task, workbook, language) if told else {}


def _rest(_task: Task, workbook: Workbook, _language: str) -> Texts:
    """The position of rest about which the motion is small."""
    return {"rest": _place(workbook.solution.rest or {}, workbook)}


def _place(values: Mapping[sp.Symbol, sp.Expr], workbook: Workbook) -> CatalogText:
    typography = Typography(workbook.scene.names)
    equations = (f"{latex(q, typography)} = {latex(value, typography)}" for q, value in values.items())
    return joined(", ", map(formula, equations))


def _conserved(task: Task, workbook: Workbook, language: str) -> Texts:
    """Which quantity is conserved."""
    coordinate = workbook.solution.conserved_of[int(task.subject) - 1]
    named = label(coordinate, workbook.scene, language)
    kind = "momentum" if coordinate else "energy"
    what = text(language, f"homework.conserved.{kind}", coordinate=named)
    model = workbook.solution.model
    met = contacts_along(model, {coordinate: sp.Integer(1)}) if coordinate else contacts_with_losses(model)
    if met:
        names = joined(", ", (label(name, workbook.scene, language) for name in met))
        what = text(language, "homework.conserved.between", what=what, contacts=names)
    return {"number": formula(task.subject), "what": what}


def _equilibria(_task: Task, workbook: Workbook, language: str) -> Texts:
    """The coordinates that have a value in an equilibrium; and that no contact is to be closed, where there are any."""
    wanted = positions.asked(workbook.solution)[0].values
    told = {"coordinates": joined(", ", (label(q.name, workbook.scene, language) for q in wanted))}
    if any(event.bounces for event in workbook.scene.events):
        told["contacts"] = text(language, "homework.open-contacts")
    return told


def _stability(task: Task, workbook: Workbook, _language: str) -> Texts:
    """The equilibrium."""
    linear = motions_of(workbook.solution.model)[int(task.subject) - 1]
    return {"number": formula(task.subject), "place": _place(positions.shown_values(linear.equilibrium), workbook)}


def _symmetry(task: Task, workbook: Workbook, _language: str) -> Texts:
    """The generator, which is no secret."""
    generator = workbook.solution.symmetries[task.subject].generator
    return {"number": formula(task.subject), "generator": formula(_rules(generator, workbook))}


def _rules(generator: Generator, workbook: Workbook) -> str:
    r"""x \to x + \varepsilon t, with the shift as one term"""
    typography, solution = Typography(workbook.scene.names), workbook.solution
    moved = {solution.q(q): shift for q, shift in generator.shifts.items()} | {solution.t: generator.time}
    rules = ((latex(q, typography), shift) for q, shift in moved.items() if shift != 0)
    return r",\; ".join(rf"{q} \to {q} {_added(shift, typography)}" for q, shift in rules)


def _added(shift: sp.Expr, typography: Typography) -> str:
    """+ ε, − ε y, + ε (x + y)"""
    sign = "-" if shift.could_extract_minus_sign() else "+"
    size = -shift if sign == "-" else shift
    factor = latex(size, typography)
    shown = "" if size == 1 else rf"\left({factor}\right)" if size.is_Add else rf"\, {factor}"
    return rf"{sign} \varepsilon {shown}".rstrip()


def _steady(task: Task, workbook: Workbook, language: str) -> Texts:
    """What rests, and the rate that is asked for."""
    motion = steady.motions(workbook.solution)[0]
    rate = latex(workbook.solution.rate(task.subject), Typography(workbook.scene.names))
    return {"resting": label(motion.coordinate, workbook.scene, language), "rate": formula(rate)}


def _ordering(goal: str) -> Callable[[Task, Workbook, str], Texts]:
    """Whether there is a block that does not belong."""
    return lambda task, workbook, language: {
        "wrong_block": wrong_block(workbook.solution, goal, task.subject, language)
    }


def reaction_sentences(task: Task, workbook: Workbook, language: str) -> tuple[CatalogText, ...]:
    """Which constraints are kept; where equations of motion are asked for, by what, and what decides its sign."""
    solution, typography = workbook.solution, Typography(workbook.scene.names)
    if task.quantity.kind not in OF_REACTIONS | OF_STATES:
        return ()
    kinds = ("kept", "kept") if task.quantity.kind in OF_STATES else ("holonomic", "rates")
    return tuple(
        text(
            language,
            f"homework.reactions.{kinds[0 if each.is_holonomic else 1]}",
            condition=formula(rf"\Phi = {latex(solution.model.condition(each), typography)} = 0"),
            multiplier=formula(latex(solution.multiplier(each), typography)),
        )
        for each in solution.conditions
    )


def _bound(task: Task, workbook: Workbook, _language: str) -> Texts:
    """The constraint, and the letter of its multiplier."""
    solution, typography = workbook.solution, Typography(workbook.scene.names)
    condition = next(each for each in solution.conditions if each.source == task.subject)
    left = latex(solution.model.condition(condition), typography)
    return {
        "condition": formula(rf"\Phi = {left} = 0"),
        "multiplier": formula(latex(solution.multiplier(condition), typography)),
    }


def _carried(task: Task, workbook: Workbook, language: str) -> Texts:
    """The constraint, the letter of its multiplier, and the position of rest."""
    linear = motions_of(workbook.solution.model)[0]
    place = _place(positions.shown_values(linear.equilibrium), workbook)
    return {**_bound(task, workbook, language), "place": place}


def _impact(task: Task, workbook: Workbook, language: str) -> Texts:
    """The contact: what happens at it, its gap and its restitution."""
    solution, typography = workbook.solution, Typography(workbook.scene.names)
    name = contact_of(solution, task.subject)
    event = next(event for event in workbook.scene.events if event.name == name)
    return {
        "event": label(name, workbook.scene, language),
        "gap": formula(rf"g_N = {latex(gap(solution.model, event), typography)}"),
        "restitution": formula(latex(restitution(solution.model, event), typography)),
    }


TOLD: Mapping[str, Callable[[Task, Workbook, str], Texts]] = MappingProxyType(
    {
        "linearized": _rest,
        "eigenfrequencies": _rest,
        "conserved": _conserved,
        "equilibria": _equilibria,
        "stability": _stability,
        "symmetry": _symmetry,
        "steady-motion": _steady,
        "constraint-force": _bound,
        "rest-reaction": _carried,
        "impulse": _impact,
        "momentum-behind": _impact,
        "impact-loss": _impact,
        **{f"order-{goal}": _ordering(goal) for goal in (LAGRANGIAN, EQUATION)},
    }
)
