"""The levels of practice: which systems are drawn, and what is asked about them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from . import moving, one_degree, one_particle, two_degrees
from .draw import Draw
from .parts import Document, Part, document_of

Family = Callable[[Draw], Part]

FOUNDATIONS = (
    "position",
    "virtual-displacement",
    "kinetic-energy",
    "potential-energy",
    "virtual-work",
    "generalized-force",
)
EQUATIONS = ("lagrangian", "momentum", "equation", "equations")
MODEL = ("linearized", "eigenfrequencies", "conserved", "equilibria", "stability", "symmetry", "steady-motion")
TWO = (*two_degrees.FAMILIES, *one_particle.FAMILIES)
FREE = tuple(family for family in moving.FAMILIES if family not in moving.DRIVEN)


@dataclass(frozen=True)
class Level:
    """A level: its systems, and the kinds of tasks that are asked about them."""

    number: int
    families: tuple[Family, ...]
    kinds: tuple[str, ...]


LEVELS = (
    Level(1, one_degree.FAMILIES, FOUNDATIONS),
    Level(2, one_degree.FAMILIES, EQUATIONS),
    Level(3, TWO, FOUNDATIONS),
    Level(4, TWO, EQUATIONS),
    Level(5, moving.FAMILIES, (*FOUNDATIONS, *EQUATIONS)),
    Level(6, (*one_degree.FAMILIES, *TWO, *FREE), MODEL),
)


def system_of(level: Level, seed: str, number: int, trial: int = 0) -> Document:
    """The scene document that is the so manyeth of a seed, from 1; another one of its family for each trial.

    No two of one round are of one family.
    """
    turn, place = divmod(number - 1, len(level.families))
    family = Draw(seed, level.number, turn).shuffled(level.families)[place]
    draw = Draw(seed, level.number, number, trial)
    return document_of(family(draw), draw, family.__name__.replace("_", "-"))
