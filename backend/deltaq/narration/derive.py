"""The answer to `POST /derivations`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import Any

from ..contract.derivation import DerivationRequest
from ..contract.reading import read
from ..derivation.effort import UNBOUNDED, Allowance
from ..derivation.engine import chapters, chapters_of_equations, equations_alone, extent, reactions, untold
from ..derivation.released import Release
from ..derivation.result import Result, equations_of, result_of
from ..derivation.result_history import result_origins
from ..derivation.step import Chapter, Derivation
from ..derivation.system import System
from ..errors import DeltaqError
from ..language.latex_printer import Typography
from ..mechanics.requests import changed_scene, inside
from ..vocabulary import OptionalPart
from .catalog import language_of
from .expression_writer import ExpressionWriter
from .letters import letters_of
from .marks import by_coordinate, in_class
from .narrator import Narrator
from .notation import Notation
from .outcome import missing
from .result_answer import written
from .roots import Roots
from .symbols import QuantitySymbols

Document = dict[str, object]


LARGE = 40  # extent of a scene from which on the equations of motion come before the steps that lead to them


class TimeIsUp(DeltaqError):
    """The last document that was told lacks what the time was not enough for."""


def derive_request(document: Mapping[str, object]) -> Document:
    """Derives what the request names, all but its id. Raises InputError for what cannot be read.

    `document`: the fields of a DerivationRequest.
    """
    told = _read(document)
    with inside("/scene"):
        told.tell_equations()
        told.tell_reactions()
        return told.whole()


def derive_parts(
    document: Mapping[str, object], allowance: Allowance = UNBOUNDED
) -> Generator[Document, None, Document]:
    """Yields the equations of motion with the chapters that lead to them; returns what `derive_request` does.

    Of a large scene the results alone come first. Where the time that is allowed is not enough, the document without
    what is missing is yielded, and TimeIsUp raised: it is not the answer to the request.
    """
    told = _read(document)
    told.system.effort.allowance = allowance
    with inside("/scene"):
        if told.is_large:
            yield from told.results()
        told.tell_equations()
        told.tell_reactions()
        yield told.equations()
        whole = told.whole()
        if "time" in told.system.effort.left_out.values():
            yield whole
            raise TimeIsUp
        return whole


def narrated(system: System, derivation: Derivation, language: str) -> Document:
    """The answer of a derivation that has been made."""
    told = _Told(system, derivation.formulation, language, iter(derivation.chapters))
    told.tell_equations()
    return told.whole()


def _read(document: Mapping[str, object]) -> _Told:
    asked = read(DerivationRequest, document)
    system = System(changed_scene(asked))
    steps = chapters(system, asked.formulation, canonical=asked.canonical)
    return _Told(system, asked.formulation, language_of(asked.lang), steps, releases_of(system, asked.release))


def releases_of(system: System, names: Sequence[str]) -> tuple[Release, ...]:
    """What a request wants released, each once. Raises UnknownNameError at the place of what nothing holds."""
    return tuple(Release.of(system, name, f"/release/{i}") for i, name in enumerate(dict.fromkeys(names)))


def chapters_of_reactions(releases: Sequence[Release], formulation: str, language: str) -> list[dict[str, Any]]:
    """What holds each of them, in one chapter, each in its wider scene's symbols; no chapter where there are none."""
    derived = ((each, Derivation(formulation, (reactions(each),))) for each in releases)
    told: list[dict[str, Any]] = [
        chapter for each, found in derived for chapter in narrator_of(each.wider, language).chapters(found)
    ]
    return [{**told[0], "steps": [step for chapter in told for step in chapter["steps"]]}] if told else []


@dataclass
class _Told:
    """A derivation that is told in two parts: first what leads to the equations, then the last chapter."""

    system: System
    formulation: str
    language: str
    steps: Iterator[Chapter]
    releases: tuple[Release, ...] = ()
    derived: tuple[Chapter, ...] = ()
    chapters: list[Document] = field(default_factory=list)
    roots: Roots = field(default_factory=Roots)

    def __post_init__(self) -> None:
        self.narrator = narrator_of(self.system, self.language)

    def tell_equations(self) -> None:
        """Tells the chapters that lead to the equations of motion."""
        self._tell(tuple(islice(self.steps, chapters_of_equations(self.formulation))))

    def tell_reactions(self) -> None:
        """Tells what holds the released lengths and coordinates."""
        self.chapters += chapters_of_reactions(self.releases, self.formulation, self.language)

    @property
    def is_large(self) -> bool:
        """Whether telling the steps may take longer than there is time."""
        return extent(self.system) >= LARGE

    def results(self) -> Iterator[Document]:
        """The results up to the equations of motion, then these as steps; other chapters say what is missing."""
        found = self._document(equations_of(self.system), self._missing)
        parts: tuple[OptionalPart, ...] = ("steps", "model")
        found["left_out"] = [*(missing(part, "time", self.language) for part in parts), *self._missing]
        for derived in (untold, equations_alone):
            yield {**found, "chapters": self.narrator.told(derived(self.system, self.formulation))[0]}

    def equations(self) -> Document:
        """These chapters and their results; those of the last one are empty."""
        return self._document(equations_of(self.system), [missing("model", "later", self.language), *self._missing])

    def whole(self) -> Document:
        """The last chapter behind what has been told, and all results."""
        self._tell(tuple(self.steps))
        found = equations_of(self.system) if "model" in self.system.effort.left_out else result_of(self.system)
        return self._document(found, self._missing)

    @property
    def _missing(self) -> list[Document]:
        """The parts that have been left out so far, and why."""
        return [missing(part, why, self.language) for part, why in self.system.effort.left_out.items()]

    def _tell(self, chapters: tuple[Chapter, ...]) -> None:
        told, self.roots = self.narrator.told(chapters, self.roots)
        self.derived += chapters
        self.chapters += told

    def _document(self, found: Result, left_out: list[Document]) -> Document:
        scene, found = self.system.scene, replace(found, reactions=self.releases)
        typography = Typography(scene.names, decimals=scene.writes_decimals, order=self.system.symbols.order)
        origins = result_origins(Derivation(self.formulation, self.derived), self.system, found.terms)
        return {
            "scene": scene.id,
            "formulation": self.formulation,
            "chapters": list(self.chapters),
            "result": written(found, origins, ExpressionWriter(typography, self.narrator.speech)),
            "left_out": left_out,
        }


def notation_of(system: System, language: str) -> Notation:
    """How a scene's quantities are written in a derivation, with the classes of the page."""
    typography = Typography(
        system.scene.names,
        by_coordinate(system.scene, in_class),
        decimals=system.scene.writes_decimals,
        order=system.symbols.order,
    )
    names = {symbol.name: symbol.typeset for symbol in system.scene.names.symbols if symbol.kind == "coordinate"}
    return Notation(typography, QuantitySymbols(system.scene, language, names, in_class), system.h)


def narrator_of(system: System, language: str) -> Narrator:
    """Who tells the derivation of a scene, in letters that the scene has not taken."""
    notation = notation_of(system, language)
    small = {"h": notation.value(system.h), r"\omega": notation.value(system.omega)}
    own = {letter: latex.replace("{", "{{").replace("}", "}}") for letter, latex in small.items()}
    return Narrator(language, notation, {**letters_of(system.scene.names), **own})
