"""The content of a handout: a scene with its values, and its derivation told in one language."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

from ..derivation.effort import UNBOUNDED, Allowance
from ..derivation.engine import LAST, chapters, check_formulation, equations_alone, extent
from ..derivation.released import Release
from ..derivation.step import Derivation
from ..derivation.system import System
from ..language.latex_printer import Typography
from ..language.latex_printer import latex as latex_text
from ..mechanics.requests import inside
from ..mechanics.scene import Scene
from ..mechanics.user_text import UserText, in_language
from ..narration.catalog import text, with_decimal_mark
from ..narration.derive import LARGE, chapters_of_reactions, narrator_of, releases_of
from ..narration.prose import CatalogText, words


@dataclass(frozen=True)
class Value:
    """A given number: what it belongs to in LaTeX, its plain name, the value and its unit."""

    latex: str
    name: str
    value: float
    unit: str
    language: str

    @property
    def equation(self) -> str:
        """LaTeX of symbol = number."""
        mantissa, _, exponent = f"{self.value:.12g}".partition("e")
        number = with_decimal_mark(self.language, mantissa)
        return f"{self.latex} = {number}" + (f" \\cdot 10^{{{int(exponent)}}}" if exponent else "")


@dataclass(frozen=True)
class Line:
    """A step or substep, numbered as in the lecture; `depth` is 0 for a step, 1 for its substeps, and so on."""

    number: str
    depth: int
    title: CatalogText
    text: CatalogText
    latex: str


@dataclass(frozen=True)
class Part:
    """A chapter."""

    title: CatalogText
    lines: tuple[Line, ...]


@dataclass(frozen=True)
class Handout:
    """A derivation to be written down: what the scene's author wrote, and sentences with formulas."""

    language: str
    title: UserText
    summary: UserText
    coordinates: tuple[Value, ...]
    parameters: tuple[Value, ...]
    parts: tuple[Part, ...]
    is_cut: bool = False  # whether the time was not enough for all of it

    def say(self, key: str) -> CatalogText:
        """A sentence of the handout itself."""
        return text(self.language, f"handout.{key}")


def handout_of(
    scene: Scene,
    language: str,
    formulation: str,
    *,
    substeps: bool = True,
    release: Sequence[str] = (),
    allowance: Allowance = UNBOUNDED,
) -> Handout:
    """The handout of a scene. Raises UnknownNameError for an unknown formulation, and for what cannot be released."""
    parts = handouts(scene, language, formulation, substeps=substeps, release=release, allowance=allowance)
    return tuple(parts)[-1]


def handouts(
    scene: Scene,
    language: str,
    formulation: str,
    *,
    substeps: bool = True,
    release: Sequence[str] = (),
    allowance: Allowance = UNBOUNDED,
) -> Iterator[Handout]:
    """The same; of a large scene before it one that has the equations of motion alone, if a time is allowed."""
    check_formulation(formulation)
    system = System(scene)
    system.effort.allowance = allowance
    releases = releases_of(system, release)
    with inside("/scene"):
        if extent(system) >= LARGE and allowance.seconds < math.inf:
            alone = Derivation(formulation, equations_alone(system, formulation))
            told = written_down(system, alone, language, substeps=substeps, releases=releases, is_cut=True)
            yield told
        derivation = Derivation(formulation, tuple(chapters(system, formulation)))
    is_cut = "time" in system.effort.left_out.values()
    yield written_down(system, derivation, language, substeps=substeps, releases=releases, is_cut=is_cut)


def written_down(
    system: System,
    derivation: Derivation,
    language: str,
    *,
    substeps: bool = True,
    releases: Sequence[Release] = (),
    is_cut: bool = False,
) -> Handout:
    """The handout of a derivation that has been made, and what is missing in it for want of time.

    What holds the `releases` stands before the last chapter.
    """
    scene = system.scene
    told = narrator_of(system, language).chapters(derivation)
    if is_cut and not any(chapter.id == LAST and chapter.steps for chapter in derivation.chapters):
        told.append(_without_model(language))
    told[-1:-1] = chapters_of_reactions(releases, derivation.formulation, language)
    return Handout(
        language,
        in_language(scene.title, language),
        in_language(scene.summary, language),
        tuple(_initial_values(system, language)),
        tuple(Value(_latex(scene, p.name), p.name, p.value, _unit(p.unit), language) for p in scene.parameters),
        tuple(_part(language, str(i), chapter, substeps=substeps) for i, chapter in enumerate(told, 1)),
        is_cut,
    )


def _without_model(language: str) -> dict[str, object]:
    """The last chapter where the time was not enough for it."""
    told = {"title": text(language, "rules.steps.left-out.title"), "text": text(language, "rules.left-out.time")}
    step = {**told, "latex": "", "substeps": ()}
    return {"id": "model", "title": text(language, "rules.chapters.model"), "steps": (step,)}


def _latex(scene: Scene, name: str) -> str:
    return next((symbol.typeset for symbol in scene.names.symbols if symbol.name == name), name)


def _initial_values(system: System, language: str) -> Iterator[Value]:
    """q(0) and q̇(0) of every free coordinate."""
    scene = system.scene
    typography = Typography(scene.names, decimals=scene.writes_decimals)
    for coordinate in scene.free:
        latex = _latex(scene, coordinate.name)
        unit = _unit(coordinate.unit)
        yield Value(f"{latex}(0)", coordinate.name, coordinate.value, unit, language)
        rate = latex_text(system.rate(coordinate.name), typography)
        yield Value(f"{rate}(0)", f"dot({coordinate.name})", coordinate.rate, f"{unit or 1}/s", language)


def _unit(unit: str) -> str:
    return "" if unit == "1" else UserText(unit).line


def _part(language: str, number: str, chapter: Mapping[str, object], *, substeps: bool) -> Part:
    steps = cast("Sequence[Mapping[str, object]]", chapter["steps"])
    lines = (line for i, step in enumerate(steps, 1) for line in _lines(language, step, f"{number}.{i}", 0))
    return Part(words(chapter["title"]), tuple(line for line in lines if substeps or line.depth == 0))


def _lines(language: str, step: Mapping[str, object], number: str, depth: int) -> Iterator[Line]:
    yield Line(
        number, depth, words(step["title"]), words(step["text"]), with_decimal_mark(language, str(step["latex"]))
    )
    below = cast("Sequence[Mapping[str, object]]", step["substeps"])
    for i, substep in enumerate(below, 1):
        yield from _lines(language, substep, f"{number}.{i}", depth + 1)
