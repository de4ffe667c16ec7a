"""Derivations as documents: chapters and steps with titles, sentences and LaTeX in one language."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..derivation.step import Chapter, Derivation, Step
from .aligned import aligned
from .catalog import filled, template, text
from .letters import Letters, in_sentence
from .marks import without_classes
from .notation import Notation
from .prose import CatalogText, formula, joined

Document = dict[str, object]


@dataclass(frozen=True)
class Narrator:
    """Tells a derivation. `notation` writes LaTeX with the classes of the page; the LaTeX for everyone is without.

    `letters` are those that its sentences have instead of the lecture's.
    """

    language: str
    notation: Notation
    letters: Letters = field(default_factory=dict)

    def chapters(self, derivation: Derivation) -> list[Document]:
        return [self.chapter(chapter) for chapter in derivation.chapters if chapter.steps]

    def chapter(self, chapter: Chapter) -> Document:
        title = text(self.language, f"rules.chapters.{chapter.id}")
        return {"id": chapter.id, "title": title, "steps": [self.step(step) for step in chapter.steps]}

    def step(self, step: Step) -> Document:
        names = self._names(step.about)
        outcome = step.about.get("outcome")
        key = f"rules.steps.{step.rule}"
        marked = aligned(step.relations, self.notation.formula)
        return {
            "id": step.id,
            "rule": step.rule,
            "title": text(self.language, f"{key}.title", **names),
            "text": self._sentence(f"{key}.{outcome or 'text'}", names),
            "latex": without_classes(marked),
            "marked": marked,
            "verified": step.verified,
            "sources": list(step.sources),
            "substeps": [self.step(substep) for substep in step.substeps],
        }

    def _sentence(self, key: str, names: Mapping[str, CatalogText]) -> CatalogText:
        return filled(in_sentence(template(self.language, key), self.letters), names)

    def _names(self, about: Mapping[str, str]) -> dict[str, CatalogText]:
        """Names for a sentence; coordinates become mathematics between dollar signs."""
        return {key: self._name(key, value) for key, value in about.items()}

    def _name(self, key: str, value: str) -> CatalogText:
        if key != "coordinate":
            return joined(", ", map(self.notation.symbols.label, value.split(", ")))
        latex = self.notation.symbols.coordinate_latex
        return joined(", ", (formula(latex.get(name, name)) for name in value.split(", ")))
