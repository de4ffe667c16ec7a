"""The names in an answer that are no names of the scene: T, V and L of the scene, x and v of its only body, e_x.

A name of the scene is always itself. What the scene knows by another name is taken by its true value, so that
`L = T − V = …` says three things that can be checked; it never counts as an answer by itself.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from ...errors import InputError
from ...language.names import Names, Symbol, is_name
from ...language.parser import parse
from ...language.plain_printer import plain
from ...language.spelling import GREEK, SUBSCRIPTS, key
from ...language.tree import Call, Name, Node, Number, Power, Sum, TimeDerivative, Vector
from ..quantities import quantity_of
from ..solution import Solution
from ..task import Task

_GREEK = "".join(GREEK)
_INDEX = (
    rf"_(?:\{{(?:[^{{}}]|\{{[^{{}}]*\}})*\}}|\\(?:text|mathrm)\s*\{{[^{{}}]*\}}|\\[A-Za-z]+|[A-Za-z0-9]+|[{_GREEK}])"
)
_LOW = "".join(SUBSCRIPTS)
PLAIN_SYMBOL = re.compile(rf"(?<![A-Za-z0-9_])(?:[A-Za-z]+[0-9{_LOW}]*|[{_GREEK}][0-9{_LOW}]*)(?:{_INDEX})?")
LATEX_SYMBOL = re.compile(
    r"(?:\\(?:vec|mathbf|boldsymbol|hat)\s*)?(?:\{\s*)?"
    rf"(?:\\?[A-Za-z]+|[{_GREEK}])(?:\s*\}})?(?:\s*{_INDEX})?"
)
_DECORATION = re.compile(r"\\(?:vec|mathbf|boldsymbol|hat|text|mathrm|left|right)(?![A-Za-z])|[\s{}]")
WHOLE = ("", "ges", "tot", "gesamt", "total", "kin", "pot")
AXES = "xyz"
HAND = "ijk"
LABELS: Mapping[str, str] = {
    **dict.fromkeys(("T", "K", "Ekin"), "kinetic-energy"),
    **dict.fromkeys(("V", "U", "Epot"), "potential-energy"),
    "L": "lagrangian",
    "p": "momentum",
    "Q": "generalized-force",
}


@dataclass(frozen=True)
class Glossary:
    """The scene's names and those that an answer brings along.

    `trees` are what names mean that stand for something else; `true` are the names that stand for what the scene itself
    knows, `axes` the unit vectors in order, `asked` the names of what is asked for.
    """

    names: Names
    trees: Mapping[str, Node]
    true: frozenset[str]
    axes: tuple[str, ...]
    asked: frozenset[str]

    def with_definition(self, name: str, tree: Node, *, moves: bool) -> Glossary:
        """A name that the answer defines: it takes the place of what the scene knows by it."""
        kept = tuple(symbol for symbol in self.names.symbols[:-2] if symbol.name != name)
        names = Names((*kept, Symbol(name, "coordinate" if moves else "parameter")))
        return replace(self, names=names, trees={**self.trees, name: tree}, true=self.true - {name})

    def with_unknown(self, name: str, *, moves: bool) -> Glossary:
        """A name that stands for what is asked: a variation can be taken of what moves."""
        return replace(
            self.with_definition(name, Name(name), moves=moves),
            trees={other: tree for other, tree in self.trees.items() if other != name},
        )


def symbol_in(text: str) -> str:
    """The key of a text that is one symbol, decorated or not; "" if it is none."""
    bare = text.strip()
    pattern = LATEX_SYMBOL if "\\" in bare or "{" in bare else PLAIN_SYMBOL
    if not pattern.fullmatch(bare):
        return ""
    name = key(_DECORATION.sub("", bare))
    return name if is_name(name) else ""


def symbols_in(text: str) -> frozenset[str]:
    """The keys of all symbols that a text may hold, the letters of a run of them included."""
    found = words_in(text)
    return frozenset(found | {letter for word in found if word.isalpha() for letter in word}) - {""}


def glossary_of(task: Task, solution: Solution, text: str) -> Glossary:
    """The names of the scene, and of what else the text speaks."""
    own = solution.scene.names
    words = symbols_in(text)
    unknown = sorted(word for word in words if not own.candidates(word) and word not in ("t", "d"))
    trees = {word: tree for word in unknown if (tree := _tree(task, solution, word)) is not None}
    asked = frozenset(word for word in unknown if _is_asked(task, solution, word))
    axes = _axes(solution, own, words_in(text)) if task.quantity.form == "vector" else ()
    moving = frozenset("vr") | frozenset(AXES)
    added = [Symbol(word, "coordinate" if word[0] in moving else "parameter") for word in trees]
    added += [Symbol(axis, "parameter") for axis in axes]
    try:
        names = Names((*own.symbols[:-2], *added))
    except InputError:
        return Glossary(own, {}, frozenset(), (), asked)
    return Glossary(names, trees, frozenset(trees), axes, asked)


def words_in(text: str) -> set[str]:
    """The keys of the symbols that stand in a text by themselves."""
    return {symbol_in(word) for pattern in (PLAIN_SYMBOL, LATEX_SYMBOL) for word in pattern.findall(text)}


def split_index(word: str) -> tuple[str, str]:
    """T1 → T and 1; Ekin → Ekin."""
    for label in ("Ekin", "Epot"):
        if word.startswith(label):
            return label, word[len(label) :]
    return word[:1], word[1:]


def _is_asked(task: Task, solution: Solution, word: str) -> bool:
    if word in AXES:
        return False
    base, index = split_index(word)
    labels = {key(label) for label in task.quantity.labels} | {
        label for label, kind in LABELS.items() if kind == task.quantity.kind
    }
    whole = index in WHOLE or solution.scene.names.resolve(index) is not None or index.isdigit()
    return base in labels and (whole if task.subject else index in WHOLE)


def _tree(task: Task, solution: Solution, word: str) -> Node | None:
    """What the scene knows by this name; nothing for what is asked, or where it has no short form."""
    if _is_asked(task, solution, word) and task.quantity.form != "equation":
        return None
    try:
        return _known(solution, word)
    except (InputError, ValueError, ZeroDivisionError, NotImplementedError):
        return None


def _known(solution: Solution, word: str) -> Node | None:
    base, index = split_index(word)
    place = _only_place(solution)
    if place is not None and word in (*AXES[: solution.scene.dimension], "r", "v"):
        components = tuple(_parsed(solution, part) for part in solution.position(place))
        if word == "r":
            return Vector(components)
        return _speed(components) if word == "v" else components[AXES.index(word)]
    quantity = quantity_of(LABELS.get(base, ""))
    if quantity is None:
        return None
    subject = _subject(solution, base, index)
    if subject is None or subject not in quantity.subjects(solution):
        return None
    return _parsed(solution, quantity.value(solution, subject)[0])


def _parsed(solution: Solution, value: object) -> Node:
    return parse(plain(value), solution.scene.names).tree


def _speed(components: tuple[Node, ...]) -> Node:
    squares = tuple(Power(TimeDerivative(part), Number(Fraction(2))) for part in components)
    return Call("sqrt", (Sum(squares),))


def _only_place(solution: Solution) -> str | None:
    """The only body of a scene, if it is a particle."""
    bodies = solution.scene.bodies
    return bodies[0].name if len(bodies) == 1 and bodies[0].kind == "particle" else None


def _subject(solution: Solution, base: str, index: str) -> str | None:
    """Of which coordinate p and Q are; "" for the energies."""
    if base not in ("p", "Q"):
        return "" if index in WHOLE else None
    if not index:
        return solution.free[0] if len(solution.free) == 1 else None
    if index.isdigit():
        return solution.free[int(index) - 1] if 0 < int(index) <= len(solution.free) else None
    symbol = solution.scene.names.resolve(index)
    return symbol.name if symbol else None


def _axes(solution: Solution, own: Names, words: set[str]) -> tuple[str, ...]:
    """The names of the unit vectors in use: e_x, e_1, or i, j and k where the scene leaves them free."""
    count = solution.scene.dimension
    families = ([f"e{letter}" for letter in AXES], ["e1", "e2", "e3"], list(HAND))
    for family in families:
        axes = tuple(family[:count])
        if words & set(axes) and not any(own.candidates(axis) for axis in axes):
            return axes
    return ()
