"""Derivations as documents: chapters and steps with titles, sentences and LaTeX in one language."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..derivation.step import Chapter, Derivation, Step
from .catalog import text
from .marks import without_classes
from .notation import Notation

Document = dict[str, object]


@dataclass(frozen=True)
class Narrator:
    """Tells a derivation. `notation` writes LaTeX with the classes of the page; the LaTeX for everyone is without."""

    language: str
    notation: Notation

    def chapters(self, derivation: Derivation) -> list[Document]:
        return [self.chapter(chapter) for chapter in derivation.chapters if chapter.steps]

    def chapter(self, chapter: Chapter) -> Document:
        title = text(self.language, f"rules.chapters.{chapter.id}")
        return {"id": chapter.id, "title": title, "steps": [self.step(step) for step in chapter.steps]}

    def step(self, step: Step) -> Document:
        names = self._names(step.about)
        outcome = step.about.get("outcome")
        key = f"rules.steps.{step.rule}"
        marked = self.notation.block(step.relations)
        return {
            "id": step.id,
            "rule": step.rule,
            "title": text(self.language, f"{key}.title", **names),
            "text": text(self.language, f"{key}.{outcome or 'text'}", **names),
            "latex": without_classes(marked),
            "marked": marked,
            "verified": step.verified,
            "sources": list(step.sources),
            "substeps": [self.step(substep) for substep in step.substeps],
        }

    def _names(self, about: Mapping[str, str]) -> dict[str, str]:
        """Names for a sentence; coordinates become mathematics between dollar signs."""
        return {key: self._name(key, value) for key, value in about.items()}

    def _name(self, key: str, value: str) -> str:
        if key != "coordinate":
            return ", ".join(map(self.notation.symbols.label, value.split(", ")))
        latex = self.notation.symbols.coordinate_latex
        return ", ".join(f"${latex.get(name, name)}$" for name in value.split(", "))
