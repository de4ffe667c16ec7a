"""The left sides of an answer: T, 2T, δW, ∂L/∂φ̇ or x₂ name what is asked for, or a multiple of it."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import sympy as sp

from ...language.symbols import Symbols
from .glossary import AXES, LABELS, split_index, symbol_in, words_in
from .layout import Range, Statement
from .reader import Member, Reader, refuse, scalar

DELTA = re.compile(r"\s*(?:\\delta(?![A-Za-z])|δ|delta(?![a-z]{2})_?)\s*")
ARGUMENTS = re.compile(r"\s*(?:\\left\s*)?\(([^()=+*/^]*|[^()=+*/^]*\(t\)[^()=+*/^]*)(?:\\right\s*)?\)\s*$")
_DECORATION = re.compile(r"\\(?:vec|mathbf|boldsymbol|mathrm|text)|[\s{}\\]")
SQUARED = re.compile(r"\s*(?:\^\s*(?:2|\{\s*2\s*\})|\*\*\s*2|²)\s*$")


Factor = tuple[sp.Expr, sp.Expr]


def is_frequency(name: str) -> bool:
    """Whether a symbol is one of ω, ω₀, ω₁, w …"""
    return re.fullmatch(r"(?:omega|w)(?:\d{0,2}|[a-z]{0,3})", name) is not None


def is_label(reader: Reader, place: Range) -> bool:
    """Whether a side is nothing but the name of what is asked for, such as T(φ, φ̇), p_φ or δW, or an unknown name."""
    text = ARGUMENTS.sub("", reader.text(place))
    bare = DELTA.sub("", text, count=1) if DELTA.match(text) else text
    name = symbol_in(bare)
    if not name:
        return False
    stem = re.sub(r"_.*", "", _DECORATION.sub("", bare))
    base = "delta" + stem if bare is not text else stem
    labels = {label.replace("δ", "delta") for label in reader.task.quantity.labels}
    if base in labels or re.sub(r"\d+$", "", base) in labels:
        return True
    return not reader.solution.scene.names.candidates(name) and bare is text


def asked_in(reader: Reader, place: Range) -> str:
    """The name of what is asked for among those of a side; "" if it does not speak of it."""
    labels = {re.sub("^(delta|δ)", "", label) for label in reader.task.quantity.labels}
    own = reader.solution.scene.names
    words = (word for word in words_in(reader.text(place)) if not own.candidates(word))
    found = [word for word in words if word in reader.glossary.asked or word in labels]
    return max(found, key=len, default="")


def factor_of(reader: Reader, place: Range, asked: str) -> tuple[Factor, Member]:
    """a and b of a side a·X + b, where X is what is asked for. Raises ExpressionError where it is no such side."""
    varied = re.match("delta|δ", reader.task.quantity.labels[0]) is not None
    glossary = reader.glossary.with_unknown(asked, moves=varied)
    member = replace(reader, glossary=glossary).member(place)
    symbols = Symbols(glossary.names)
    unknown = symbols.variation(asked) if varied else symbols.name(asked)
    value = scalar(member.value)
    slope, rest = value.diff(unknown), value.subs(unknown, 0)
    if slope == 0 or slope.has(unknown) or not member.explicit:
        raise refuse("answer-left-side", name=asked)
    return (slope, rest), member


def solved(value: Any, factor: Factor) -> Any:
    """X of a·X + b = value."""
    slope, rest = factor
    if slope == 1 and rest == 0:
        return value
    if isinstance(value, sp.MatrixBase):
        if rest != 0:
            raise refuse("answer-not-scalar")
        return value / slope
    return (scalar(value) - rest) / slope


def is_formal(reader: Reader, place: Range) -> bool:
    """`T_1 + T_2`: what is asked for as a sum of parts that are not named any further."""
    terms = [symbol_in(term) for term in reader.text(place).split("+")]
    if not all(terms) or any(reader.glossary.names.candidates(term) for term in terms):
        return False
    labels = {split_index(label)[0] for label, kind in LABELS.items() if kind == reader.task.quantity.kind}
    return all(split_index(term)[0] in labels and split_index(term)[1] for term in terms)


def axis_of(reader: Reader, statement: Statement) -> str:
    """x, y or z where a statement is of that component; of δx where a virtual displacement is asked for."""
    if len(statement.members) < 2:
        return ""
    left = ARGUMENTS.sub("", reader.text(statement.members[0]))
    varied = DELTA.match(left) is not None
    if varied != (reader.task.quantity.kind == "virtual-displacement"):
        return ""
    name = symbol_in(DELTA.sub("", left, count=1))
    letter = re.sub(r"^delta", "", name)[:1]
    return letter if letter in AXES else ""
