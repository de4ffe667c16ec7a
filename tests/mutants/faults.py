"""One small fault in one module: an operator swapped, a condition settled, a part lost, a number off by one.

They are made in the syntax tree. Left out is what never runs or has no effect (annotations, names of types) and what
is no law of the module's own (decorators, texts).
"""

from __future__ import annotations

import ast
import itertools
import random
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import CodeType
from typing import TypeVar

SWAPPED: dict[type[ast.AST], tuple[type[ast.AST], ...]] = {
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div,),
    ast.Div: (ast.Mult,),
    ast.FloorDiv: (ast.Mult,),
    ast.Mod: (ast.Mult,),
    ast.Pow: (ast.Mult,),
    ast.BitAnd: (ast.BitOr,),
    ast.BitOr: (ast.BitAnd,),
    ast.And: (ast.Or,),
    ast.Or: (ast.And,),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
OTHER_FUNCTION = {"any": "all", "all": "any", "min": "max", "max": "min", "sorted": "list", "abs": "float"}
NEVER_RUN = {"annotation", "returns", "decorator_list", "type_params"}
GENERIC = {
    *("Callable", "Iterable", "Iterator", "Literal", "Mapping", "Sequence"),
    *("dict", "frozenset", "list", "set", "tuple", "type"),
}
NEVER = ast.Constant(value=False)
ALWAYS = ast.Constant(value=True)
T = TypeVar("T")


@dataclass(frozen=True)
class Mutant:
    """A module with one fault: where it is, how it read, how it reads now, and the code to run instead."""

    module: Path
    line: int
    before: str
    after: str
    code: CodeType

    def __str__(self) -> str:
        return f"{self.module}:{self.line}\n  - {self.before}\n  + {self.after}"


def mutants_of(module: Path, wanted: Container[int] | None = None) -> Iterator[Mutant]:
    """The faults of a module, in reading order: those with the wanted numbers, from 0, or all."""
    tree = ast.parse(module.read_text(encoding="utf-8"))
    number = itertools.count()
    for line, node, put in list(_places(tree)):
        for fault in _faults(node):
            if wanted is None or next(number) in wanted:
                put(ast.fix_missing_locations(ast.copy_location(fault, node)))
                code = compile(tree, str(module), "exec", dont_inherit=True)
                yield Mutant(module, line, _shown(node), _shown(fault), code)
                put(node)


def sample(modules: Iterable[Path], size: int, seed: int) -> tuple[list[Mutant], int]:
    """So many mutants of the modules, drawn at random (0: all), and how many there are."""
    every = [(module, number) for module in modules for number in range(_size(module))]
    drawn = random.Random(seed).sample(every, size) if 0 < size < len(every) else every
    wanted = {module: {number for of, number in drawn if of == module} for module, _ in drawn}
    made = {
        (module, number): mutant
        for module, numbers in wanted.items()
        for number, mutant in zip(sorted(numbers), mutants_of(module, numbers), strict=True)
    }
    return [made[one] for one in drawn], len(every)


def _size(module: Path) -> int:
    """How many faults a module can have."""
    tree = ast.parse(module.read_text(encoding="utf-8"))
    return sum(1 for _, node, _ in list(_places(tree)) for _ in _faults(node))


class _Put:
    """Puts a node in the place of another."""

    def __init__(self, parent: ast.AST, field: str, index: int | None) -> None:
        self.parent, self.field, self.index = parent, field, index

    def __call__(self, node: ast.AST) -> None:
        if self.index is None:
            setattr(self.parent, self.field, node)
        else:
            getattr(self.parent, self.field)[self.index] = node


def _places(node: ast.AST, line: int = 1) -> Iterator[tuple[int, ast.AST, _Put]]:
    """Every node below with its line, in reading order."""
    for field, value in ast.iter_fields(node):
        if field in NEVER_RUN:
            continue
        children = enumerate(value) if isinstance(value, list) else [(None, value)]
        for index, child in children:
            if isinstance(child, ast.AST) and not _is_no_law(child):
                here = getattr(child, "lineno", line)
                yield here, child, _Put(node, field, index)
                yield from _places(child, here)


def _is_no_law(node: ast.AST) -> bool:
    """A docstring, an import, the names to be imported, an assertion of lengths, or what a type checker alone reads."""
    match node:
        case ast.Expr(ast.Constant()) | ast.Import() | ast.ImportFrom() | ast.keyword(arg="strict"):
            return True
        case ast.Assign([ast.Name("__all__")]) | ast.AnnAssign(annotation=ast.Name("TypeAlias")):
            return True
        case ast.If(ast.Name("TYPE_CHECKING") | ast.Attribute(attr="TYPE_CHECKING")):
            return True
        case ast.Assign([ast.Name()], ast.Call(ast.Name("TypeVar" | "ParamSpec"))):
            return True
        case ast.Assign([ast.Name()], ast.Subscript(ast.Name(name))):
            return name in GENERIC
    return False


def _shown(node: ast.AST) -> str:
    if isinstance(node, ast.match_case):
        return f"case {ast.unparse(node.pattern)}" + (f" if {ast.unparse(node.guard)}" if node.guard else "")
    return ast.unparse(node).splitlines()[0].strip()


def _faults(node: ast.AST) -> Iterator[ast.AST]:  # one case for each kind of node
    match node:
        case ast.BinOp(left, op, right):
            yield from (ast.BinOp(left, other(), right) for other in SWAPPED.get(type(op), ()))
            yield from (left, right)
        case ast.BoolOp(op, values):
            yield from (ast.BoolOp(other(), values) for other in SWAPPED[type(op)])
            yield from (
                ast.BoolOp(op, _without(values, k)) if len(values) > 2 else values[1 - k] for k in range(len(values))
            )
        case ast.Compare(left, ops, others):
            for k, op in enumerate(ops):
                yield from (ast.Compare(left, [*ops[:k], new(), *ops[k + 1 :]], others) for new in SWAPPED[type(op)])
        case ast.UnaryOp(ast.Not() | ast.USub(), operand):
            yield operand
        case ast.Constant(bool() as value):
            yield ast.Constant(not value)
        case ast.Constant(int() as value):
            yield from (ast.Constant(value + 1), ast.Constant(value - 1))
        case ast.Constant(float() as value):
            yield from (ast.Constant(2 * value or 1.0), ast.Constant(-value or -1.0))
        case ast.IfExp(_, body, orelse):
            yield from (body, orelse)
        case ast.If(_, body, orelse):
            yield from (ast.If(NEVER, body, orelse), ast.If(ALWAYS, body, orelse))
        case ast.While(_, body, orelse):
            yield ast.While(NEVER, body, orelse)
        case ast.For(target, _, body, orelse):
            yield ast.For(target, ast.List([], ast.Load()), body, orelse)
        case ast.comprehension(target, source, ifs, is_async) if ifs:
            yield from (ast.comprehension(target, source, _without(ifs, k), is_async) for k in range(len(ifs)))
        case ast.match_case(pattern, guard, body):
            yield ast.match_case(pattern, NEVER, body)
            if guard:
                yield ast.match_case(pattern, None, body)
        case ast.Slice(lower, upper, step) if lower or upper:
            yield from ([ast.Slice(None, upper, step)] if lower else [])
            yield from ([ast.Slice(lower, None, step)] if upper else [])
        case ast.Call(function, given, named):
            if isinstance(function, ast.Name) and function.id in OTHER_FUNCTION:
                yield ast.Call(ast.Name(OTHER_FUNCTION[function.id], ast.Load()), given, named)
            # `strict` only asserts what the lengths are anyway.
            yield from (
                ast.Call(function, given, _without(named, k)) for k, one in enumerate(named) if one.arg != "strict"
            )
        case ast.Return(ast.expr() as value) if not (isinstance(value, ast.Constant) and value.value is None):
            yield ast.Return(ast.Constant(None))
        case ast.Expr() | ast.Assign() | ast.AugAssign() | ast.Raise() | ast.Break() | ast.Continue():
            yield ast.Pass()


def _without(values: list[T], k: int) -> list[T]:
    return [*values[:k], *values[k + 1 :]]
