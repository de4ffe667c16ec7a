"""Workers get the files of tests in an order that leaves nobody with a long one at the end."""

from __future__ import annotations

import random
import subprocess
from dataclasses import dataclass
from itertools import accumulate
from math import fsum
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from tests.order import (
    FOR_KERNELS,
    LONG,
    NAMED,
    Record,
    all_tests,
    in_order,
    in_turn,
    left_out,
    measured,
    needs_kernels,
    place_of_the_commit,
    reads_shared_derivations,
    recorded,
)


@pytest.mark.parametrize("seed", range(20))
def test_kernels_are_begun_at_once_and_the_longest_come_first(seed: int) -> None:
    draw = random.Random(seed)
    folders = ("simulation", "language", "lab", "homework", "e2e")
    files = [f"tests/{draw.choice(folders)}/test_{number}.py" for number in range(draw.randint(0, 30))]
    seconds = {file: draw.uniform(0.0, 60.0) for file in draw.sample(files, len(files) // 2)}
    first, *rest = in_order(files, seconds) or [""]
    assert sorted([first, *rest]) == (sorted(files) or [""])
    assert needs_kernels(first) == any(map(needs_kernels, files))
    late = [needs_kernels(file) for file in rest]
    assert late == sorted(late)
    for kind in (False, True):
        lengths = [seconds.get(file, 0.0) for file in rest if needs_kernels(file) is kind]
        assert lengths == sorted(lengths, reverse=True)


def test_a_report_is_summed_by_long_tests_and_the_rest_of_a_file(tmp_path: Path) -> None:
    report = ET.Element("testsuite")
    for file, name, time in (
        ("tests.lab.test_a", "test_long[1]", 0.5 * LONG),
        ("tests.lab.test_a", "test_long[2]", LONG),
        ("tests.lab.test_a", "test_b", 0.9 * LONG),
        ("tests.lab.test_a", "test_was_long", 0.5 * LONG),
        ("tests.test_short", "test_c", 0.9 * NAMED),
    ):
        ET.SubElement(report, "testcase", classname=file, name=name, time=str(time))
    first = ET.SubElement(report, "testcase", classname="tests.test_short", name="test_first", time=str(100.0 * LONG))
    properties = ET.SubElement(first, "properties")
    ET.SubElement(properties, "property", name=FOR_KERNELS, value=str(100.0 * LONG))
    ET.ElementTree(report).write(tmp_path / "report.xml")
    files = "tests/lab/test_a.py", "tests/test_d.py"
    before = Record({f"{files[0]}::test_was_long": 9.0, f"{files[1]}::test_waits": 7.0, "gone.py::test_e": 8.0}, {})
    found = measured(tmp_path / "report.xml", before, {f"{files[1]}::test_waits", f"{files[0]}::test_was_long"})
    assert found.long == {f"{files[1]}::test_waits": 7.0, f"{files[0]}::test_long": 1.5 * LONG}
    assert found.others == pytest.approx({files[0]: 1.4 * LONG})


def test_what_is_known_of_the_tests_has_not_grown_old(root: Path) -> None:
    """A few may have got another name; an order made from the names of others would be none."""
    known, there = recorded(), all_tests(root)
    assert len(there & set(known.long)) >= 0.8 * len(known.long) > 0
    assert len([file for file in known.others if (root / file).is_file()]) >= 0.8 * len(known.others) > 0
    for seconds in (known.long, known.others):
        assert list(seconds.values()) == sorted(seconds.values(), reverse=True)


@pytest.mark.parametrize("seed", range(10))
def test_each_long_test_has_its_turn_as_often_as_any_other_and_a_run_takes_its_time(seed: int) -> None:
    draw = random.Random(seed)
    long = {f"tests/test_a.py::test_{n}": draw.uniform(LONG, 40.0) for n in range(draw.randint(1, 60))}
    whole = sum(long.values())
    seconds = draw.uniform(0.1, 1.0) * whole
    runs = [in_turn(long, seconds, n / 1000) for n in range(1000)]
    for test in long:
        assert sum(test in taken for taken in runs) == pytest.approx(1000 * seconds / whole, abs=2)
    assert all(abs(sum(long[test] for test in taken) - seconds) <= max(long.values()) for taken in runs)
    assert in_turn(long, 1.01 * whole, draw.random()) == set(long)


@pytest.mark.parametrize("seed", range(20))
def test_all_workers_find_the_same_whatever_order_sets_have(seed: int) -> None:
    """They must collect alike to the last test, and a sum of floats depends on the order of its terms."""
    draw = random.Random(seed)
    long = {f"tests/test_{n % 3}.py::test_{n}": round(draw.uniform(LONG, 40.0), 1) for n in range(60)}
    others = {f"tests/test_{n}.py": 0.1 for n in range(3)}
    mixed = draw.sample(sorted(long), len(long))
    again = {test: long[test] for test in mixed}
    assert Record(long, others).by_file([*long]) == Record(again, others).by_file(mixed)
    for place in (begin / fsum(long.values()) for begin in (0.1, *accumulate(long[test] for test in sorted(long)))):
        assert in_turn(long, 90.0, place) == in_turn(again, 90.0, place)


def test_the_turn_is_the_commits(tmp_path: Path) -> None:
    assert place_of_the_commit(tmp_path) == 0.0
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@b"]
    places = []
    subprocess.run([*git, "init", "--quiet"], cwd=tmp_path, check=True)
    for message in "ab":
        subprocess.run([*git, "commit", "--quiet", "--allow-empty", "-m", message], cwd=tmp_path, check=True)
        places += [place_of_the_commit(tmp_path), place_of_the_commit(tmp_path)]
    assert places[0] == places[1] != places[2] == places[3]
    assert all(0.0 < place < 1.0 for place in places)


@pytest.mark.parametrize(
    ("file", "shares"),
    [
        ("tests/narration/test_derive.py", True),
        ("tests/narration/test_shown_forms.py", True),
        ("tests/derivation/test_symmetry.py", False),
    ],
)
def test_files_that_read_shared_derivations_go_to_one_worker(file: str, shares: bool) -> None:
    assert reads_shared_derivations(file) is shares


@dataclass(frozen=True)
class Case:
    """What `left_out` asks of a test's case."""

    nodeid: str
    share: int | None = None

    def get_closest_marker(self, name: str) -> pytest.Mark | None:
        return pytest.mark.one_in(self.share).mark if self.share and name == "one_in" else None


@pytest.mark.parametrize("share", [2, 3, 5])
@pytest.mark.parametrize(
    "test", ["tests/lab/test_a.py::test_b", "tests/lab/test_a.py::test_c", "tests/test_d.py::test_e"]
)
def test_one_of_so_many_cases_is_taken_and_one_that_is_named_alone(test: str, share: int) -> None:
    whole = [Case(f"tests/test_whole.py::test_all[{n}]") for n in range(7)]
    many = [Case(f"{test}[{n}]", share) for n in range(30)]
    left = {case.nodeid for case in left_out([*whole, *many])}  # type: ignore[misc, list-item]
    taken = [n for n, case in enumerate(many) if case.nodeid not in left]
    assert [n // share for n in taken] == list(range(30 // share))
    assert {n % share for n in taken} == set(range(share))
    for few in range(1, share + 1):
        assert len(left_out(many[:few])) == few - 1  # type: ignore[arg-type]
