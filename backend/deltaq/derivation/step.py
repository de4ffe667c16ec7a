"""Steps, chapters and derivations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Literal

from .formula import Formula, Owners


@dataclass(frozen=True)
class Relation:
    """One line of mathematics: formulas joined by `sign`, each equal to the next.

    The sign is `=`, `≠` where two are shown to differ, `⇔` between equations that say the same of the motion, `≈`
    before a number that is exact here and rounded on paper, or `<` and `≤` between numbers in rising order.
    """

    members: tuple[Formula, ...]
    sign: str = "="

    @property
    def before(self) -> Formula:
        """What the law was applied to."""
        return self.members[0]

    @property
    def after(self) -> Formula:
        """What the law leads to."""
        return self.members[-1]


Change = Literal["kept", "sign-turned", "differentiated", "integrated", "expanded", "merged"]
EvidenceKind = Literal["exact", "sampled", "stated"]


@dataclass(frozen=True)
class Origin:
    """A term of an earlier line, by its id, and what became of it."""

    term: str
    change: Change


@dataclass(frozen=True)
class Summand:
    """A term of a line.

    `shown` is what is written, without `sign`; `alone` is the line with no other term in it. `side` is −1 on the right
    of an equation. `inside` tells where the summands of its brackets come from, if not all from the same.
    """

    id: str
    shown: Formula
    alone: Formula
    sign: int = 1
    side: int = 1
    sources: tuple[str, ...] = ()
    origins: tuple[Origin, ...] = ()
    inside: Owners = ()

    def called(self, name: str) -> Summand:
        """The same by this id."""
        return Summand(name, self.shown, self.alone, self.sign, self.side, self.sources, self.origins)

    def coming_from(self, origins: tuple[Origin, ...]) -> Summand:
        """The same with these origins."""
        return Summand(self.id, self.shown, self.alone, self.sign, self.side, self.sources, origins)


@dataclass(frozen=True)
class Line:
    """A member of a relation, term by term, and the ids of the terms it was made of that cancelled."""

    terms: tuple[Summand, ...]
    cancelled: tuple[str, ...] = ()


@dataclass(frozen=True)
class Evidence:
    """How it is known that the relations of a step hold.

    `exact`: their members have one normal form, whatever the values are. `sampled`: they agree at `points` random
    points to `digits` decimal digits. `stated`: nothing is said to be equal, as a principle is not derived.
    """

    kind: EvidenceKind
    points: int = 0
    digits: int = 0


STATED = Evidence("stated")


@dataclass(frozen=True)
class Step:
    """One law applied once.

    `rule` names the law, `subject` what it is applied to, `about` the names its sentence needs. The relations are the
    law's premise turned into its conclusion. `premises` are the ids of the steps it rests on: a rule names those that
    its formulas do not show. `verified`, `evidence` and the `lines` of each relation, member by member, are found out
    about the step, never said by the rule itself.
    """

    rule: str
    subject: str
    relations: tuple[Relation, ...]
    sources: tuple[str, ...] = ()
    about: Mapping[str, str] = field(default_factory=dict)
    substeps: tuple[Step, ...] = ()
    premises: tuple[str, ...] = ()
    verified: bool = False
    evidence: Evidence = STATED
    lines: tuple[tuple[Line, ...], ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "about", MappingProxyType(dict(self.about)))

    @property
    def id(self) -> str:
        """Name of the step, safe in a URL: `virtual-displacement:bob`."""
        return f"{self.rule}:{self.subject}" if self.subject else self.rule

    def walk(self) -> Iterator[Step]:
        """The step and all below it, in reading order."""
        yield self
        for substep in self.substeps:
            yield from substep.walk()

    def with_substeps(self, *substeps: Step) -> Step:
        """The step, its work shown by these."""
        return replace(self, substeps=substeps)


@dataclass(frozen=True)
class Chapter:
    """A part of the derivation, in the lecture's order."""

    id: str
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Derivation:
    """All chapters, from positions to equations of motion."""

    formulation: str
    chapters: tuple[Chapter, ...]

    def steps(self) -> Iterator[Step]:
        """Every step and substep, in reading order."""
        for chapter in self.chapters:
            for step in chapter.steps:
                yield from step.walk()
