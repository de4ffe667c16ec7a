"""Classes in LaTeX: how the page knows which colour a symbol has and where a term comes from."""

from __future__ import annotations

import re
from collections.abc import Callable

from ..language.order import split_symbol
from ..mechanics.scene import Scene

MARK = re.compile(r"\\htmlClass\{[^}]*\}|\\(?:left|right)(?![a-z])|\\,|[{}\s]")
ROLES = {4: " differential", 5: " variation", 6: " variation", 7: " variation"}  # by the kind of the symbol

BRACE = re.compile(r"\\htmlClass\{[^}]*\}\{|(?<!\\)[{}]")
MARKED = r"\htmlClass"
COMMAND = re.compile(r"\\[A-Za-z]+$")

Wrap = Callable[[str, str], str]


def in_class(css: str, latex: str) -> str:
    r"""\htmlClass of KaTeX around the LaTeX; without a class just the LaTeX."""
    return rf"\htmlClass{{{css}}}{{{latex}}}" if css else latex


def unmarked(_css: str, latex: str) -> str:
    """The LaTeX as it is."""
    return latex


def bare(latex: str) -> str:
    """What the LaTeX says, without classes, braces, spaces and sizes of brackets; alike texts are equal."""
    return MARK.sub("", latex)


def without_classes(latex: str) -> str:
    """The LaTeX as it is written without marks; a command and the letter that stood in a mark behind it stay apart."""
    if MARKED not in latex:
        return latex
    pieces: list[str] = [""]
    is_mark: list[bool] = []
    position = 0
    for found in BRACE.finditer(latex):
        brace = found[0]
        if brace == "{":
            is_mark.append(False)
        elif brace != "}":
            is_mark.append(True)
            pieces.append(latex[position : found.start()])
            position = found.end()
            before = pieces[-1] or pieces[-2]
            if COMMAND.search(before) and latex[position].isalpha():
                pieces.append(" ")
        elif is_mark.pop():
            pieces.append(latex[position : found.start()])
            position = found.end()
    return "".join([*pieces, latex[position:]])


def by_coordinate(scene: Scene, wrap: Wrap) -> Wrap:
    """Marks the symbols of a coordinate, q, q̇, q̈ and δq alike, with the coordinate's number: `q-0`, `q-1` …"""
    numbers = {coordinate.name: index for index, coordinate in enumerate(scene.coordinates)}

    def mark(name: str, latex: str) -> str:
        kind, base = split_symbol(name)
        return wrap(f"q-{numbers[base]}{ROLES.get(kind, '')}", latex) if base in numbers else latex

    return mark
