"""Derivations as documents: chapters and steps with titles, sentences and LaTeX in one language."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import sympy as sp

from ..derivation.formula import Formula, Plus, Term
from ..derivation.history import with_inside, with_names
from ..derivation.step import Chapter, Derivation, Line, Relation, Step, Summand
from ..language.memory import cached_method
from ..language.plain_printer import plain
from .aligned import aligned
from .catalog import filled, keys, template, text, with_decimal_mark
from .letters import Letters, in_sentence
from .marks import without_classes
from .matrix_writing import number_latex
from .notation import Notation, in_classes
from .prose import CatalogText, formula, joined, words
from .roots import Roots, explained, named_roots, with_roots
from .speech import Speech, speech_of

Document = dict[str, object]
SYMMETRY = ("symmetry", "integral")  # what a generator does, and what its integral is called
WORDS = ("reason", "potential", "of_potential")  # named by their keys in the catalog


@dataclass(frozen=True)
class Narrator:
    """Tells a derivation. `notation` writes LaTeX with the classes of the page; the LaTeX for everyone is without.

    `letters` are those that its sentences have instead of the lecture's, `roots` those that stand for roots.
    """

    language: str
    notation: Notation
    letters: Letters = field(default_factory=dict)
    roots: Roots = Roots()

    @cached_property
    def speech(self) -> Speech:
        """Who says aloud what the notation writes."""
        return speech_of(self.notation, self.language)

    def chapters(self, derivation: Derivation) -> list[Document]:
        """The derivation in reading order; chapters without steps are left out."""
        return self.told(derivation.chapters)[0]

    def told(self, chapters: tuple[Chapter, ...], before: Roots | None = None) -> tuple[list[Document], Roots]:
        """Chapters as they come, those without steps left out; and the letters of roots, `before` included."""
        roots = named_roots(chapters, self.notation, before.letters if before else {})
        teller = replace(self, roots=roots)
        return [teller.chapter(chapter) for chapter in chapters if chapter.steps], roots

    def chapter(self, chapter: Chapter) -> Document:
        """A JSON object with `id`, `title` and `steps`; where titles are alike, each says whose step it is."""
        title = text(self.language, f"rules.chapters.{self._chapter_title(chapter)}")
        titles = [self._title(step) for step in chapter.steps]
        steps = [
            self.step(step, whose=titles.count(title) > 1) for step, title in zip(chapter.steps, titles, strict=True)
        ]
        return {"id": chapter.id, "title": title, "steps": steps}

    def _chapter_title(self, chapter: Chapter) -> str:
        """The key of its own title where the outcome of one of its steps has one."""
        known = keys(self.language, "rules.chapters")
        own = (f"{chapter.id}-{step.about.get('outcome', '')}" for step in chapter.steps)
        return next((key for key in own if key in known), chapter.id)

    def step(self, step: Step, *, whose: bool = False) -> Document:
        """A JSON object: `id`, `rule`, title and sentence in the language, the mathematics, the same of each substep.

        `marked` is LaTeX with the classes of the page, `latex` is without. `verified`, `sources` are those of the step.
        """
        title = self._title(step)
        if whose:
            label = self.notation.symbols.label(step.subject.rpartition(":")[2])
            title = joined("", (title, words(" ("), label, words(")")))
        sentence = self._sentence(
            f"rules.steps.{step.rule}.{step.about.get('outcome') or 'text'}", self._names(step.about)
        )
        if "contacts" in step.about:
            between = self._sentence("rules.between-impacts", self._names(step.about))
            sentence = joined(" ", (sentence, between))
        return {
            "id": step.id,
            "rule": step.rule,
            "title": title,
            "text": sentence,
            "announced": self.speech.sentences(title, sentence),
            **self._mathematics(step),
            "verified": step.verified,
            "evidence": {"kind": step.evidence.kind, "points": step.evidence.points, "digits": step.evidence.digits},
            "premises": list(step.premises),
            "sources": list(step.sources),
            "cancelled": list(
                dict.fromkeys(one for members in step.lines for line in members for one in line.cancelled)
            ),
            "substeps": [self.step(substep) for substep in step.substeps],
        }

    def _title(self, step: Step) -> CatalogText:
        """Its own one where the outcome has one."""
        rule = f"rules.steps.{step.rule}"
        told = keys(self.language, f"{rule}.titles") if "titles" in keys(self.language, rule) else ()
        outcome = step.about.get("outcome")
        key = f"titles.{outcome}" if outcome in told else "title"
        return text(self.language, f"{rule}.{key}", **self._names(step.about))

    def _mathematics(self, step: Step) -> Document:
        """The lines of a step, its terms, and the roots that have letters in it."""
        letters, relations = self.roots.of(step), _with_names(step)
        teller = replace(self, notation=with_roots(self.notation, letters)) if letters else self
        where = [self._explained(*one) for one in explained(letters)]
        marked = aligned(relations, teller.notation.formula, self._rows(where))
        spoken, places = teller.speech.spoken(relations, [(one["symbol_spoken"], one["spoken"]) for one in where])
        return {
            "latex": without_classes(marked),
            "marked": marked,
            "spoken": spoken,
            "spoken_terms": places,
            "terms": [teller.term(term) for term in _terms(step)],
            "where": where,
        }

    def _explained(self, symbol: sp.Symbol, root: sp.Expr) -> dict[str, str]:
        """What a letter stands for."""
        return {
            "symbol": symbol.name,
            "symbol_latex": self.notation.value(symbol),
            "symbol_spoken": self.speech.value(symbol),
            "plain": plain(root),
            "latex": without_classes(self.notation.value(root)),
            "spoken": self.speech.value(root),
        }

    def _rows(self, where: list[dict[str, str]]) -> tuple[tuple[str, str], ...]:
        """The lines that say it: with s = √(x² + y²), and …"""
        joints = ("with", *("and" for _ in where[1:]))
        words = (text(self.language, f"rules.words.{joint}") for joint in joints)
        return tuple(
            (rf"\text{{{word} }}{one['symbol_latex']}", one["latex"]) for word, one in zip(words, where, strict=False)
        )

    @cached_method
    def _shown(self, formula: Formula, sign: int) -> tuple[str, str]:
        """A term on paper and in words; many stand in several lines."""
        shown = Term(formula, (), sign)
        return without_classes(self.notation.term(shown)), self.speech.formula(Plus((shown,)))

    def term(self, term: Summand) -> Document:
        """A term of a line, with its sign, and where it comes from."""
        latex, spoken = self._shown(term.shown, term.sign)
        return {
            "id": term.id,
            "latex": latex,
            "spoken": spoken,
            "sources": list(term.sources),
            "from": [{"term": origin.term, "change": origin.change} for origin in term.origins],
        }

    def _sentence(self, key: str, names: Mapping[str, CatalogText]) -> CatalogText:
        return filled(in_sentence(template(self.language, key), self.letters), names)

    def _names(self, about: Mapping[str, str]) -> dict[str, CatalogText]:
        """Names for a sentence; coordinates become mathematics between dollar signs."""
        names = {key: self._name(key, value) for key, value in about.items() if key not in SYMMETRY}
        said = {key: f"rules.symmetries.{about[key]}.{key}" for key in SYMMETRY if key in about}
        return names | {key: text(self.language, entry, **names) for key, entry in said.items()}

    def _name(self, key: str, value: str) -> CatalogText:
        if key == "rate":
            return formula(with_decimal_mark(self.language, number_latex(float(value))))
        if key in WORDS:
            return joined("; ", (self._sentence(f"rules.words.{each}", {}) for each in value.split(", ") if each))
        if key not in ("coordinate", "displacement"):
            return joined(", ", map(self.notation.symbols.label, value.split(", ")))
        latex = self.notation.symbols.coordinate_latex
        written = (latex.get(name) or self._parameter(name) for name in value.split(", "))
        return joined(", ", map(formula, written))

    def _parameter(self, name: str) -> str:
        """LaTeX of a parameter; anything else as it is named."""
        known = self.notation.typography.names.get(name)
        return known.typeset if known else name


def _terms(step: Step) -> Iterator[Summand]:
    return (term for members in step.lines for line in members for term in line.terms)


def _with_names(step: Step) -> tuple[Relation, ...]:
    """The relations with a class for each of their terms: `t-0-1-2` for the last part of its id."""
    return tuple(
        replace(
            relation, members=tuple(_named(member, line) for member, line in zip(relation.members, lines, strict=True))
        )
        for relation, lines in zip(step.relations, step.lines, strict=True)
    )


def _classes(term: Summand) -> str:
    """Its name, and unless a rule has told it, whose it is."""
    name = f"t-{term.id.rpartition('/')[2].replace('.', '-')}"
    told = isinstance(term.alone, Plus) and any(part.sources for part in term.alone.terms)
    return name if told else f"{in_classes(term.sources)} {name}".strip()


def _named(member: Formula, line: Line) -> Formula:
    names = (_classes(term) for term in line.terms)
    told = with_inside(member, line.terms)
    return with_names(told, names) if len(line.terms) > 1 else told
