"""Faults are made where the code says something, each in an otherwise sound module; every part has its files."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
from tests.mutants.entries import Entries, Recorder, function_around, in_turn
from tests.mutants.faults import mutants_of, sample
from tests.mutants.replacing import Functions
from tests.mutants.running import Record

SOUND = '''"""Says 3 nowhere."""
from __future__ import annotations
__all__ = ["law"]
def law(a: int = 1, *, b: list[int] | None = None) -> int:
    if a > 2 and not b:
        return a - 1
    return sum(x for x in b or [] if x)
'''
CALLERS = """
from pathlib import Path
from tests.mutants.entries import telling
names = {{}}
exec(telling(Path("{module}")), names)
def test_enters(): assert names["law"](3) == 2
def test_does_not(): assert True
"""
KEPT = """
from functools import cache
class Law:
    @staticmethod
    def twice(x): return 2 * x
@cache
def remembered(x): return x + 5
TABLE = {1: lambda x: x + 7, 2: lambda x: x}
"""
EXPECTED = {
    ("1", "2"),
    ("1", "0"),
    ("a > 2", "a >= 2"),
    ("a > 2", "a <= 2"),
    ("a > 2 and (not b)", "a > 2 or not b"),
    ("a > 2 and (not b)", "a > 2"),
    ("not b", "b"),
    ("if a > 2 and (not b):", "if False:"),
    ("a - 1", "a + 1"),
    ("a - 1", "a"),
    ("return a - 1", "return None"),
    ("b or []", "b and []"),
}


@pytest.fixture
def module(tmp_path: Path) -> Path:
    file = tmp_path / "law.py"
    file.write_text(SOUND, encoding="utf-8")
    return file


def test_faults_of_a_function(module: Path) -> None:
    found = [(mutant.before, mutant.after) for mutant in mutants_of(module)]
    assert set(found) >= EXPECTED
    assert not any("__all__" in before or before == "None" for before, _ in found)


@pytest.mark.parametrize(
    ("text", "behaviour"),
    [
        ("Law = Callable[[int], int]", False),
        ("Row = tuple[int, ...]", False),
        ("Law: TypeAlias = Mapping[str, Literal[1, 2]]", False),
        ("T = TypeVar('T', bound=int)", False),
        ("P = ParamSpec('P')", False),
        ("__all__ = ['law', *others[1:]]", False),
        ("if TYPE_CHECKING:\n    laws = 3", False),
        ("if typing.TYPE_CHECKING:\n    laws = 3", False),
        ("def law() -> None:\n    'Says 3.'\n    return None", False),
        ("law = laws[3]", True),
        ("law = laws['first']", True),
        ("law = tuple(laws)", True),
        ("if CHECKING:\n    laws = 3", True),
        ("def law() -> int:\n    return one", True),
    ],
)
def test_what_has_no_behaviour_has_no_faults(text: str, behaviour: bool, tmp_path: Path) -> None:
    file = tmp_path / "text.py"
    file.write_text(text, encoding="utf-8")
    assert any(mutants_of(file)) is behaviour


def test_each_mutant_runs_and_has_one_fault(module: Path) -> None:
    answers = set()
    for mutant in mutants_of(module):
        names: dict[str, object] = {}
        exec(mutant.code, names)
        law = names.get("law")
        answers.add(law(3) if callable(law) else None)
    assert answers >= {2, 4, 3, None, 0}


def test_a_sample_is_the_same_for_the_same_seed(module: Path) -> None:
    some = [[str(mutant) for mutant in sample([module], 5, seed)[0]] for seed in (1, 1, 2)]
    assert some[0] == some[1] != some[2]


def test_every_part_has_its_modules_and_tests(root: Path) -> None:
    parts = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["deltaq"]["mutants"]
    page = json.loads((root / "frontend" / "stryker.json").read_text(encoding="utf-8"))
    files = [file for part in parts.values() for file in (*part["modules"], *part["tests"])]
    files += [*page["mutate"], *re.findall(r"\S+\.test\.js", page["commandRunner"]["command"])]
    assert [file for file in files if not list(root.glob(file.removeprefix("./")))] == []


def test_a_fault_is_shown_to_the_tests_that_enter_its_function_the_quickest_first(module: Path) -> None:
    start = function_around(module, 6)
    assert start == (str(module), 4)
    assert function_around(module, 3) is None
    other = (str(module), 9)
    one = Entries("one.py", {"a": {start}, "b": {other}, "c": set()}, {"a": 2.0, "b": 1.0, "c": 0.1})
    two = Entries("two.py", {"d": {start}, "e": {start}}, {"d": 1.0, "e": 3.0})
    three = Entries("three.py", {"f": {other}}, {"f": 0.2})
    assert in_turn(start, (one, two, three)) == ["d", "a", "e", "b", "c"]
    assert in_turn(other, (one, two, three)) == ["f", "b", "a", "c"]
    assert in_turn(None, (one, two, three)) == ["f", "b", "d", "a", "e", "c"]


def test_a_fault_in_what_runs_when_modules_are_read_is_shown_to_all_tests(module: Path) -> None:
    """A decorator's function, say: no test enters it, and whatever it has made may be wrong."""
    mutant = next(one for one in mutants_of(module) if one.line == 6)
    start, other = function_around(module, 6), (str(module), 9)
    assert start is not None
    entries = [Entries("one.py", {"a": {other}, "b": {start}, "c": set()}, {"a": 2.0, "b": 3.0, "c": 0.1})]
    assert Record(entries, frozenset({other})).tests_for(mutant) == ["b", "a", "c"]
    entries = [Entries("one.py", {"a": {other}, "c": set()}, {"a": 2.0, "c": 0.1})]
    assert Record(entries, frozenset({other})).tests_for(mutant) == []
    assert Record(entries, frozenset({start})).tests_for(mutant) == ["a", "c"]


def test_what_a_test_enters_is_recorded(module: Path) -> None:
    tests = module.with_name("test_law.py")
    tests.write_text(CALLERS.format(module=str(module)), encoding="utf-8")
    recorder = Recorder()
    options = ["-n0", "-q", "-p", "no:cacheprovider", "--rootdir", str(module.parent), "-c", os.devnull]
    assert pytest.main([*options, str(tests)], plugins=[recorder]) == pytest.ExitCode.OK
    entered = {test.partition("::")[2]: starts for test, starts in recorder.entries.starts.items()}
    assert entered == {"test_enters": {(str(module), 4)}, "test_does_not": set()}
    assert recorder.entries.seconds.keys() == recorder.entries.starts.keys()


def test_a_broken_function_takes_the_place_of_the_sound_one(tmp_path: Path) -> None:
    """Wherever it is kept: in a class, below a decorator, in a table."""
    module = tmp_path / "laws.py"
    module.write_text(KEPT, encoding="utf-8")
    names: dict[str, Any] = {}
    exec(compile(KEPT, str(module), "exec", dont_inherit=True), names)
    functions = Functions([module])
    broken = {(mutant.before, mutant.after): mutant.code for mutant in mutants_of(module)}
    sound = [names["Law"]().twice(3), names["remembered"](3), names["TABLE"][1](3)]
    assert sound == [6, 8, 10]
    for before, after, answers in (
        ("2 * x", "2 / x", [2 / 3, 8, 10]), ("x + 5", "x - 5", [6, -2, 10]), ("7", "8", [6, 8, 11])
    ):  # fmt: skip
        assert functions.put(module, broken[before, after])
        names["remembered"].cache_clear()
        assert [names["Law"]().twice(3), names["remembered"](3), names["TABLE"][1](3)] == answers


def test_a_function_that_is_gone_cannot_be_replaced(tmp_path: Path) -> None:
    module = tmp_path / "laws.py"
    module.write_text(KEPT, encoding="utf-8")
    names: dict[str, Any] = {}
    exec(compile(KEPT, str(module), "exec", dont_inherit=True), names)
    functions = Functions([module])
    assert not functions.put(module, compile("TABLE = {}", str(module), "exec"))
    assert not functions.put(module, compile(KEPT, str(module), "exec", dont_inherit=True))  # nothing is broken


RUN = """
from pathlib import Path
from tests.mutants.__main__ import Part, parser, tried
language = Path("backend/deltaq/language").resolve()
part = Part((language / "choices.py", language / "tokens.py"), ("tests/language/test_choices.py",))
tried(part, parser().parse_args(["choices", "--sample", "4", "--seed", "364", "--processes", "2"]))
"""


def test_faults_are_noticed(root: Path) -> None:
    """Each in a process of its own: one in a function, two outside, and one in what none of these tests enters."""
    run = subprocess.run([sys.executable, "-c", RUN], cwd=root, check=True, capture_output=True, text=True)
    assert [re.sub(r":\d+$| of \d+; .*", "", line) for line in run.stdout.split("\n") if line] == [
        "[3] backend/deltaq/language/tokens.py",
        "  - return [*tokens, Token('close', ']', Span(span.offset + span.length - 1, 1))]",
        "  + return None",
        "choices: 3 of 4 noticed (75%)",
    ]


def test_a_sample_is_of_all_faults(module: Path) -> None:
    every = [str(mutant) for mutant in mutants_of(module)]
    drawn, number = sample([module], len(every) - 1, 3)
    assert number == len(every)
    assert len({str(mutant) for mutant in drawn} & set(every)) == len(set(every)) - 1
