"""Which tests enter which functions: only those can notice a fault in one."""

from __future__ import annotations

import ast
import builtins
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType

import pytest

Start = tuple[str, int]  # a function: its file, and the line in which it begins
HOOK = "__entered__"


@dataclass
class Entries:
    """The functions that each test of a file enters, and how many seconds of a processor it takes."""

    file: str = ""
    starts: dict[str, set[Start]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)

    def tests_of(self, start: Start | None) -> list[str]:
        """The tests that enter a function; all that enter any for what runs in none, when the module is read."""
        return [test for test, starts in self.starts.items() if starts and (start is None or start in starts)]


class Recorder:
    """A plugin of pytest that writes down what each test enters of what `telling` has compiled."""

    def __init__(self) -> None:
        self.entries = Entries()
        self.now: set[Start] = set()
        setattr(builtins, HOOK, self._enter)

    def _enter(self, path: str, line: int) -> None:
        self.now.add((path, line))

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self.now = set()
        began = time.process_time()
        try:
            return (yield)
        finally:
            self.entries.file = file_of(item.nodeid)
            self.entries.starts[item.nodeid] = self.now
            self.entries.seconds[item.nodeid] = time.process_time() - began


def file_of(test: str) -> str:
    """The file of a test."""
    return test.partition("::")[0]


def in_turn(start: Start | None, entries: Iterable[Entries]) -> list[str]:
    """The tests that enter a function, the quickest first, then all others of their files.

    What a file keeps for all its tests is made in the first, so that those after it seem not to enter anything.
    """
    some = [(one, one.tests_of(start)) for one in entries]
    first = sorted((one.seconds[test], test) for one, tests in some for test in tests)
    entering = {test for _, test in first}
    return [test for _, test in first] + [
        test for one, tests in some if tests for test in one.starts if test not in entering
    ]


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
