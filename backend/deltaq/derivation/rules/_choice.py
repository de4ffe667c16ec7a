"""Which rule a load or a body needs: the one whose file says that it is for this kind."""

from __future__ import annotations

from types import ModuleType

from ...mechanics.bodies import Body
from ...mechanics.contributions import Contribution
from ...packages import modules_of

RULES = "deltaq.derivation.rules"


def rule_of(load: Contribution) -> ModuleType:
    """The rule of virtual work whose `LOAD` is the kind of this contribution."""
    return next(module for module in modules_of(RULES) if getattr(module, "LOAD", None) is type(load))


def energy_rule_of(body: Body) -> ModuleType:
    """The rule of kinetic energy whose `BODY` is the kind of this body."""
    return next(module for module in modules_of(RULES) if getattr(module, "BODY", None) is type(body))
