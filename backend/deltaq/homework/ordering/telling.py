"""Blocks as documents: letter, title and formulas, as they come with their task."""

from __future__ import annotations

from ...mechanics.scene import Scene
from ...narration.aligned import aligned
from ...narration.catalog import text
from ...narration.derive import narrator_of
from ...narration.marks import without_classes
from ...narration.narrator import Narrator
from ...narration.prose import CatalogText, joined
from ..feedback import Document, step_title
from ..solution import Solution
from .blocks import Block, blocks_of, shown_relations


def block_documents(solution: Solution, goal: str, subject: str, language: str) -> list[Document]:
    """The blocks in the order in which they are shown."""
    known = blocks_of(solution, goal, subject)
    narrator = narrator_of(solution.model, language)
    return [_document(block, solution.scene, narrator) for block in known.shown]


def _document(block: Block, scene: Scene, narrator: Narrator) -> Document:
    relations = shown_relations(block.step)
    title = step_title(block.step.rule, block.step.about, scene, narrator.language)
    marked = aligned(relations, narrator.notation.formula)
    spoken, _ = narrator.speech.spoken(relations)
    return {
        "id": block.id,
        "title": title,
        "announced": narrator.speech.sentences(title),
        "latex": without_classes(marked),
        "marked": marked,
        "spoken": spoken,
    }


def wrong_block(solution: Solution, goal: str, subject: str, language: str) -> CatalogText:
    """That one of the blocks does not belong, as a further sentence; nothing if all do."""
    known = blocks_of(solution, goal, subject)
    wrong = any(block.mistake is not None for block in known.shown)
    return joined(" ", ("", text(language, "homework.ordering.wrong-block"))) if wrong else CatalogText("")
