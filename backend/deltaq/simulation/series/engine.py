"""Which code a model's series run in: they are interpreted at first, and in the long run have code of their own."""

from __future__ import annotations

from functools import lru_cache

from ...model.model import Model
from ..kernels.motion import SMALLEST_PIVOT
from .code import MachineCode, compiled, host
from .generated import Jet, jet_of
from .interpreter import interpreted
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
    """The code for a model's series; once it has code of its own, that serves all runs of as many lanes."""
    if lanes == 1 and not is_long and not model.has(("jet", lanes)):
        return model.kept("interpreted jet", lambda: interpreted(model.recurrences))
    return model.kept(("jet", lanes), lambda: jet_of(model.recurrences, lanes))


@lru_cache(SHAPES)
def code_of_steps(shape: Shape) -> MachineCode:
    """How lanes go a step and tell what it did: of the shape alone, so that it is there for most new models."""
    return compiled({"advance": advance(shape), "measure": measure(shape, SMALLEST_PIVOT)})


@lru_cache(SHAPES)
def code_of_neighbours(shape: Shape) -> MachineCode:
    """What neighbours do (`neighbour`), of the shape alone: asked for only where errors are."""
    functions = {"begin": begin(shape), "carry": carry(shape), "settle": settle(shape)}
    return compiled(functions | {"look": look(shape), "compare": compare(shape)})
