"""When two answers say the same: one kind of equality, one module.

A module has `fingerprint(parts, sampler)`, numbers that equal answers share (None: it cannot be told from numbers, ():
the answer says nothing), and `same(given, right, solution)`, the exact decision. Parts are the components of a vector,
the residuals of equations, or one expression.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import sympy as sp

from ..sampling import Sampler
from ..solution import Solution

Parts = tuple[sp.Expr, ...]
Fingerprint = tuple[float, ...]


@dataclass(frozen=True)
class Match:
    """Whether two answers are equal (None: undecided), and in which sense if not literally.

    `nonzero` is what must not be zero for them to be; `about` are the names of what the remark is on.
    """

    equal: bool | None
    remark: str = ""
    nonzero: Parts = ()
    about: tuple[str, ...] = ()


class Equality(Protocol):
    """What every module of this folder offers."""

    def fingerprint(self, parts: Parts, sampler: Sampler, /) -> Fingerprint | None:
        """Numbers that equal answers share; None: cannot be told from numbers, (): the answer says nothing."""

    def same(self, given: Parts, right: Parts, solution: Solution, /) -> Match:
        """Whether an answer equals the right one, decided exactly where that is possible."""


def weakest(outcomes: Sequence[bool | None]) -> bool | None:
    """The conjunction of decisions: false if one is false, else undecided if one is, else true."""
    if False in outcomes:
        return False
    return None if None in outcomes else True
