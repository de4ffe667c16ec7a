"""What is public says what it does, and functions of arrays say their shapes.

A docstring may be missing where it could only repeat: on a trivial property, and on a method whose law a base class or
a protocol of the package states already.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

import pytest

PACKAGE = Path(__file__).parents[1] / "backend" / "deltaq"
WITH_ARRAYS = ("simulation/", "model/", "lab/")
PROPERTIES = {"property", "cached_property"}
ARRAY = re.compile(r"\b(Floats|Complexes|Indices|NDArray|ndarray)\b")
SHAPE = re.compile(r"\bshape\s+\(\S")  # as in: shape (samples, n)

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Class:
    """A class of the package: its methods, and the names of its bases."""

    node: ast.ClassDef

    @property
    def name(self) -> str:
        return self.node.name

    @cached_property
    def methods(self) -> dict[str, Function]:
        return {one.name: one for one in self.node.body if isinstance(one, Function)}

    @cached_property
    def members(self) -> frozenset[str]:
        """Methods and fields: a field does what a property of a protocol asks for."""
        stated = (one.target for one in self.node.body if isinstance(one, ast.AnnAssign))
        return frozenset({*self.methods, *map(ast.unparse, stated)})

    @cached_property
    def bases(self) -> frozenset[str]:
        return frozenset(name_of(base) for base in self.node.bases)

    @property
    def is_protocol(self) -> bool:
        return "Protocol" in self.bases


def name_of(node: ast.expr) -> str:
    """`Protocol` of Protocol[T], typing.Protocol and Protocol."""
    return ast.unparse(node).partition("[")[0].rpartition(".")[2]


@dataclass(frozen=True)
class Source:
    """Some Python files, and what stands in them."""

    files: dict[str, ast.Module]
    classes: list[Class] = field(default_factory=list)

    @classmethod
    def read(cls, folder: Path) -> Source:
        files = {str(one.relative_to(folder)): ast.parse(one.read_text("utf-8")) for one in folder.rglob("*.py")}
        nodes = (node for tree in files.values() for node in ast.walk(tree) if isinstance(node, ast.ClassDef))
        return cls(files, list(map(Class, nodes)))

    def public(self, *places: str) -> Iterator[tuple[str, ast.AST, Class | None]]:
        """Modules, classes and functions without a leading underscore, by where they stand; not what functions hide.

        Of files whose paths begin with one of `places`; of all, if none is named.
        """
        for file, tree in sorted(self.files.items()):
            if file.startswith(places or ""):
                yield file, tree, None
                yield from public_below(tree, f"{file}: ", None)

    def states(self, owner: Class, name: str) -> bool:
        """Whether a base class of `owner`, or a protocol all of whose methods it has, documents the method."""
        above = self._bases(owner)
        own = owner.members.union(*(one.members for one in above))
        protocols = [one for one in self.classes if one.is_protocol and one.methods.keys() <= own]
        return any(name in one.methods and is_told(one.methods[name]) for one in (*above, *protocols) if one != owner)

    def _bases(self, owner: Class) -> list[Class]:
        """All classes above, by name: one of several of the same name will do."""
        found: list[Class] = []
        left = set(owner.bases)
        while left:
            new = [one for one in self.classes if one.name in left and one not in found]
            found += new
            left = set().union(*(one.bases for one in new))
        return found


def public_below(
    node: ast.Module | ast.ClassDef, where: str, owner: Class | None
) -> Iterator[tuple[str, ast.AST, Class | None]]:
    for one in node.body:
        if isinstance(one, ast.ClassDef | Function) and not one.name.startswith("_"):
            yield where + one.name, one, owner
            if isinstance(one, ast.ClassDef):
                yield from public_below(one, f"{where}{one.name}.", Class(one))


def is_told(node: ast.AST) -> bool:
    return bool(ast.get_docstring(node))  # type: ignore[arg-type]  # one that can have some


def is_trivial(function: Function) -> bool:
    """A property that returns what stands at hand: names, fields, constants, their length, one comparison or call."""
    is_property = any(name_of(one) in PROPERTIES for one in function.decorator_list)
    statement = function.body[0]
    if not is_property or len(function.body) > 1 or not isinstance(statement, ast.Return):
        return False
    return statement.value is not None and sum(isinstance(n, ast.expr) for n in ast.walk(statement.value)) <= MOST_NODES


MOST_NODES = 9


def is_silent(source: Source, node: ast.AST, owner: Class | None) -> bool:
    """Whether it says nothing though it should."""
    if is_told(node):
        return False
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
        return not is_trivial(node) and not (owner is not None and source.states(owner, node.name))
    return True


def annotations_of(function: Function) -> str:
    every = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
    stated = [one.annotation for one in every] + [function.returns]
    return " ".join(ast.unparse(one) for one in stated if one is not None)


def is_shapeless(node: ast.AST) -> bool:
    """Whether a function of arrays does not say their shapes, or a class not those of all its fields."""
    text = (ast.get_docstring(node) or "") if isinstance(node, ast.ClassDef | Function) else ""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
        return bool(ARRAY.search(annotations_of(node))) and not SHAPE.search(text)
    if not isinstance(node, ast.ClassDef):
        return False
    stated = (one for one in node.body if isinstance(one, ast.AnnAssign) and ARRAY.search(ast.unparse(one.annotation)))
    fields = [ast.unparse(one.target) for one in stated]
    return bool(fields) and not (SHAPE.search(text) and all(re.search(rf"`{name}\b", text) for name in fields))


@pytest.fixture(scope="module")
def source() -> Source:
    return Source.read(PACKAGE)


def test_what_is_public_says_what_it_does(source: Source) -> None:
    assert [where for where, node, owner in source.public() if is_silent(source, node, owner)] == []


def test_functions_of_arrays_say_their_shapes(source: Source) -> None:
    assert [where for where, node, _ in source.public(*WITH_ARRAYS) if is_shapeless(node)] == []


EXAMPLE = '''
"""A module."""

class Law(Protocol):
    """A law."""
    def value(self) -> float:
        """Its value."""
    def told(self) -> str: ...

class Silent:
    def value(self) -> float: ...
    def told(self) -> str: ...

class Alone:
    """It has only half of the protocol."""
    def value(self) -> float: ...

class Child(Alone):
    """A child."""
    @property
    def size(self) -> int:
        return len(self.parts)
    @property
    def work(self) -> float:
        return sum(force * way for force, way in zip(self.forces, self.ways, strict=True))
    def _hidden(self) -> None: ...

class Arrays:
    """`times` has shape (samples,)."""
    times: Floats
    states: Floats

def bare(times: Floats) -> None:
    """The shape is told nowhere; (q, v) is none."""

def shaped(times: Floats) -> NDArray[np.bool_]:
    """Of shape
    (samples,)."""

def scalar(time: float) -> float:
    """No array."""
'''


def test_the_rules_find_what_they_are_for() -> None:
    tree = ast.parse(EXAMPLE)
    classes = [Class(node) for node in tree.body if isinstance(node, ast.ClassDef)]
    source = Source({"lab/x.py": tree}, classes)
    every = list(source.public("lab/"))
    assert list(source.public("la/", "x")) == []
    assert list(source.public()) == every
    silent = [where.removeprefix("lab/x.py: ") for where, node, owner in every if is_silent(source, node, owner)]
    assert silent == ["Law.told", "Silent", "Silent.told", "Alone.value", "Child.work"]
    shapeless = [where.removeprefix("lab/x.py: ") for where, node, _ in every if is_shapeless(node)]
    assert shapeless == ["Arrays", "bare"]
