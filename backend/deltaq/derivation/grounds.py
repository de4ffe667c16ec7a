"""The grounds of each step: how it is known that it holds, which steps it rests on, and where its terms come from."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

from .history import Algebra, History
from .premises import Signature, premises
from .step import Chapter, Derivation, Evidence, EvidenceKind, Relation, Step

STRENGTH: tuple[EvidenceKind, ...] = ("sampled", "exact", "stated")  # a step is as well known as its weakest part
Proves = Callable[[Relation], bool]


@dataclass(frozen=True)
class Grounds:
    """Finds the grounds of steps, one after the other, in the order in which they build on each other.

    `proves` decides whether a relation holds exactly; `sampled` is the evidence of those it does not prove.
    """

    algebra: Algebra
    proves: Proves
    sampled: Evidence
    history: History = field(init=False)
    known: dict[Signature, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "history", History(self.algebra))

    def of(self, derivation: Derivation) -> Derivation:
        """The derivation, each step with its grounds."""
        return replace(derivation, chapters=tuple(map(self.of_chapter, derivation.chapters)))

    def of_chapter(self, chapter: Chapter) -> Chapter:
        """The chapter after those before it, each step with its grounds."""
        return Chapter(chapter.id, tuple(map(self._of_step, chapter.steps)))

    def _of_step(self, step: Step) -> Step:
        """Its substeps come first: it is their sum."""
        substeps = tuple(map(self._of_step, step.substeps))
        whole = replace(step, substeps=substeps)
        rests_on = premises(whole, self.history.names, self.known)
        lines = self.history.lines(whole)
        told = replace(whole, premises=rests_on, evidence=self._evidence(whole), lines=lines)
        self.known.update(dict.fromkeys(self.history.learned(told), step.id))
        for source in step.sources:
            self.known.setdefault((source,), step.id)
        return told

    def _evidence(self, step: Step) -> Evidence:
        """How well the weakest of its relations and substeps is known."""
        kinds = {*map(self._kind, step.relations), *self._kinds_below(step)} or {"stated"}
        weakest = next(kind for kind in STRENGTH if kind in kinds)
        return self.sampled if weakest == "sampled" else Evidence(weakest)

    def _kind(self, relation: Relation) -> EvidenceKind:
        if len(relation.members) == 1:
            return "stated"
        return "exact" if self.proves(relation) else "sampled"

    def _kinds_below(self, step: Step) -> Iterator[EvidenceKind]:
        return (substep.evidence.kind for substep in step.substeps)
