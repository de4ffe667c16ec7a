"""Virtual work of a moment: δW = M δφ, with the variation of the angle that it turns.

Source: Szabó, Höhere Technische Mechanik, §I.4; the lecture's free moment.
"""

from __future__ import annotations

from ...mechanics.contributions import Moment
from ..formula import Explicit, Formula, Gateaux, Given, Named, Partial, Quantity, Term, Times
from ..step import Relation, Step
from ..system import System

RULE = "work-of-moment"
LOAD = Moment


def apply(system: System, load: Moment, subject: str) -> Step:
    """M as the scene states it (with guides put in, where there are some), then δW = M δφ and its value."""
    work = Explicit(system.virtual_work(load))
    moment = _moment(system, load)
    lines = (
        Relation((moment, *_stated(system, load))),
        Relation(
            (Named(Quantity("virtual-work", load.source), work.value), Times((moment, _turn(system, load))), work)
        ),
    )
    return Step(RULE, subject, lines, (f"load:{load.source}",), {"load": load.source})


def share(system: System, load: Moment, coordinate: str) -> Term:
    """M ∂φ/∂qᵢ"""
    lever = Partial(Explicit(system.angle(load)), system.q(coordinate))
    return Term(Times((_moment(system, load), lever)), (f"load:{load.source}",))


def _moment(system: System, load: Moment) -> Named:
    return Named(Quantity("moment", load.source), system.moment(load))


def _stated(system: System, load: Moment) -> tuple[Formula, ...]:
    if system.guides:
        return (Explicit(system.moment(load)),)
    return (Given((load.moment,), system.expression(load.moment)),)


def _turn(system: System, load: Moment) -> Formula:
    return Gateaux(Explicit(system.angle(load)))
