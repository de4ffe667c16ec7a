"""Faults are made where the code says something, each in an otherwise sound module; every part has its files."""

from __future__ import annotations

import json
import os
import re
import tomllib
from pathlib import Path

import pytest
from tests.mutants.entries import Entries, Recorder, function_around
from tests.mutants.faults import mutants_of, sample

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


def test_a_fault_is_shown_to_the_tests_that_enter_its_function(module: Path) -> None:
    start = function_around(module, 6)
    assert start == (str(module), 4)
    assert function_around(module, 3) is None
    entries = Entries("test_law.py", 3, {"test_a": {start}, "test_b": {(str(module), 9)}})
    assert entries.tests_of(start) == ["test_a"]
    assert entries.tests_of(None) == ["test_a", "test_b"]


def test_what_a_test_enters_is_recorded(module: Path) -> None:
    tests = module.with_name("test_law.py")
    tests.write_text(CALLERS.format(module=str(module)), encoding="utf-8")
    recorder = Recorder()
    options = ["-n0", "-q", "-p", "no:cacheprovider", "--rootdir", str(module.parent), "-c", os.devnull]
    assert pytest.main([*options, str(tests)], plugins=[recorder]) == pytest.ExitCode.OK
    assert recorder.entries.tests_of((str(module), 4)) == [f"{recorder.entries.file}::test_enters"]
    assert recorder.entries.number == 2


def test_a_sample_is_of_all_faults(module: Path) -> None:
    every = [str(mutant) for mutant in mutants_of(module)]
    drawn, number = sample([module], len(every) - 1, 3)
    assert number == len(every)
    assert len({str(mutant) for mutant in drawn} & set(every)) == len(set(every)) - 1
