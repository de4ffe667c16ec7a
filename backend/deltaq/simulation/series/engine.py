"""Which code a model's series run in: code that is compiled quickly at first, faster code in the long run."""

from __future__ import annotations

from functools import lru_cache

from ...model.model import Model
from ..kernels.motion import SMALLEST_PIVOT
from .code import QUICK, THOROUGH, MachineCode, compiled, host
from .generated import Jet, jet_of
from .neighbour import begin, carry, compare, look, settle
from .shape import Shape
from .stepping import advance, measure

SHAPES = 64  # of models whose code for steps is kept


def lanes_of_host() -> int:
    """Those of a whole ensemble, of which each lane has many: one vector of this processor, but four at least.

    With two vectors a processor that has registers for one spends more time on memory than it saves by waiting less.
    """
    return max(4, host().width)


def jet_of_model(model: Model, *, is_long: bool, lanes: int = 1) -> Jet:
    """The code for a model's series; made once for each effort, and the thorough one serves all once it is there."""
    effort = THOROUGH if is_long or model.has(("jet", lanes, THOROUGH)) else QUICK
    return model.kept(("jet", lanes, effort), lambda: jet_of(model.recurrences, lanes, effort))


@lru_cache(SHAPES)
def code_of_steps(shape: Shape) -> MachineCode:
    """How lanes go a step and tell what it did: of the shape alone, so that it is there for most new models."""
    return compiled({"advance": advance(shape), "measure": measure(shape, SMALLEST_PIVOT)}, THOROUGH)


@lru_cache(SHAPES)
def code_of_neighbours(shape: Shape) -> MachineCode:
    """What neighbours do (`neighbour`), of the shape alone: asked for only where errors are."""
    functions = {"begin": begin(shape), "carry": carry(shape), "settle": settle(shape)}
    return compiled(functions | {"look": look(shape), "compare": compare(shape)}, THOROUGH)
