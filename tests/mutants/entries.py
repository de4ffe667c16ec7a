"""Which tests enter which functions: only those can notice a fault in one."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType

import pytest

Start = tuple[str, int]  # a function: its file, and the line in which it begins
HOOK = "__entered__"


@dataclass
class Entries:
    """The functions that each test of a file enters."""

    file: str = ""
    number: int = 0
    starts: dict[str, set[Start]] = field(default_factory=dict)

    def tests_of(self, start: Start | None) -> list[str]:
        """The tests that enter a function; all that enter any for what runs in none, when the module is read."""
        return [test for test, starts in self.starts.items() if start is None or start in starts]


class Recorder:
    """A plugin of pytest that writes down what each test enters of what `telling` has compiled."""

    def __init__(self) -> None:
        self.entries = Entries()
        self._now: set[Start] = set()
        setattr(builtins, HOOK, self._enter)

    def _enter(self, path: str, line: int) -> None:
        self._now.add((path, line))

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        self.entries.file = session.items[0].nodeid.partition("::")[0]
        self.entries.number = len(session.items)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self._now = set()
        try:
            return (yield)
        finally:
            if self._now:
                self.entries.starts[item.nodeid] = self._now


def telling(module: Path) -> CodeType:
    """The code of a module whose functions tell a `Recorder` when they are entered."""
    tree = ast.parse(module.read_text(encoding="utf-8"))
    for function in _functions(tree):
        call = ast.parse(f"{HOOK}({str(module)!r}, {function.lineno})").body[0]
        function.body.insert(int(ast.get_docstring(function) is not None), ast.copy_location(call, function))
    return compile(ast.fix_missing_locations(tree), str(module), "exec", dont_inherit=True)


def function_around(module: Path, line: int) -> Start | None:
    """The innermost function that a line of a module stands in."""
    functions = _functions(ast.parse(module.read_text(encoding="utf-8")))
    around = [one.lineno for one in functions if one.lineno <= line <= (one.end_lineno or one.lineno)]
    return (str(module), max(around)) if around else None


def _functions(tree: ast.Module) -> Iterable[ast.FunctionDef]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
