"""Classes in LaTeX: how the page knows which colour a symbol has and where a term comes from."""

from __future__ import annotations

import re
from collections.abc import Callable

from ..mechanics.scene import Scene

SYMBOL = re.compile(r"(?:(dot|ddot|delta|d)\()?(\w+)\)?")
MARK = re.compile(r"\\htmlClass\{[^}]*\}")
VARIATION = {"delta": " variation", "d": " differential"}

Wrap = Callable[[str, str], str]


def in_class(css: str, latex: str) -> str:
    r"""\htmlClass of KaTeX around the LaTeX; without a class just the LaTeX."""
    return rf"\htmlClass{{{css}}}{{{latex}}}" if css else latex


def unmarked(_css: str, latex: str) -> str:
    """The LaTeX as it is."""
    return latex


def bare(latex: str) -> str:
    """What the LaTeX says, without its classes, braces and spaces: two texts that read alike are equal."""
    return re.sub(r"[{}\s]", "", MARK.sub("", latex))


def by_coordinate(scene: Scene, wrap: Wrap) -> Wrap:
    """Marks the symbols of a coordinate, q, q̇, q̈ and δq alike, with the coordinate's number: `q-0`, `q-1` …"""
    numbers = {coordinate.name: index for index, coordinate in enumerate(scene.coordinates)}

    def mark(name: str, latex: str) -> str:
        match = SYMBOL.fullmatch(name)
        if match is None or match[2] not in numbers:
            return latex
        return wrap(f"q-{numbers[match[2]]}{VARIATION.get(match[1] or '', '')}", latex)

    return mark
