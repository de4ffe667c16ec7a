"""Workers get the files of tests in an order that leaves nobody with a long one at the end."""

from __future__ import annotations

import random
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from tests.order import SHORT, durations, in_order, left_out, measured, needs_kernels, reads_shared_derivations


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


def test_a_report_is_summed_by_file(tmp_path: Path) -> None:
    report = ET.Element("testsuite")
    for file, time in (("tests.lab.test_a", SHORT), ("tests.test_b", 0.6 * SHORT), ("tests.lab.test_a", 20.0)):
        ET.SubElement(report, "testcase", classname=file, time=str(time))
    ET.ElementTree(report).write(tmp_path / "report.xml")
    assert measured(tmp_path / "report.xml") == {"tests/lab/test_a.py": 23}


def test_what_is_known_of_the_files_has_not_grown_old(root: Path) -> None:
    """A few may have got another name; an order made from the names of others would be none."""
    known = durations()
    there = [file for file in known if (root / file).is_file()]
    assert len(there) >= 0.8 * len(known) > 0
    assert list(known.values()) == sorted(known.values(), reverse=True)


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
