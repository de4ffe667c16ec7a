"""Which tests and cases a run takes, and the order in which the workers get the files, so that none has a long one at
the end.

Long tests take turns, so that a run of all ends in time however many there are: which ones it takes is told by the
commit. `python -m tests.order report.xml` writes into `durations.json` what `pytest --junit-xml=report.xml` measured.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from math import fsum
from pathlib import Path
from xml.etree import ElementTree as ET
from zlib import crc32

import pytest
from xdist.scheduler import LoadFileScheduling

ROOT = Path(__file__).parents[1]
DURATIONS = Path(__file__).with_name("durations.json")
SHARING = re.compile(r"^from tests(\.derived import | import derived)", re.MULTILINE)
SHARED = "tests of shared derivations"
LONG = 3.0  # seconds: a test that takes as long has its own name in the record, and its turn
FOR_KERNELS = "seconds for the kernels"  # of a test in a report: it was waiting, others were not
NAMED = 1.0  # seconds: a file whose other tests take less is not worth naming
# Seconds of long tests in one run, of four workers on two cores; those marked `always` come on top.
BUDGET = 220.0
# Whatever stands here moves scenes by compiled kernels, or has a service do so.
MOVING = (
    "tests/api/",
    "tests/deploy/",
    "tests/e2e/",
    "tests/frontend/test_drawn.py",
    "tests/homework/test_classes.py",
    "tests/lab/",
    "tests/simulation/",
    "tests/test_cli.py",
    "tests/test_contributing.py",
)


def left_out(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Of tests marked `one_in(n)`, which try one law on very many scenes, all cases but one of each n that follow.

    Which one varies, so that it is not always the first language of two. Different files begin at different cases, so
    that each is met by some; tests of one file share what they make of a scene, and begin alike. One case is always
    taken, so also one that is named alone.
    """
    cases: defaultdict[str, list[pytest.Item]] = defaultdict(list)
    for item in items:
        cases[item.nodeid.partition("[")[0]].append(item)
    left = []
    for test, all_of in cases.items():
        share = all_of[0].get_closest_marker("one_in")
        if share:
            n = min(share.args[0], len(all_of))
            start = crc32(test.partition("::")[0].encode())
            left += [case for number, case in enumerate(all_of) if (_digit_sum(number, n) + start) % n]
    return left


@dataclass(frozen=True)
class Record:
    """Seconds that tests took when they were measured last, with all their cases: the long ones by name without
    parameters, the others of each file together.
    """

    long: Mapping[str, float]
    others: Mapping[str, float]

    def by_file(self, tests: Collection[str]) -> dict[str, float]:
        """Seconds of each file in a run that takes these of its tests; a file that is not named is a short one."""
        parts = defaultdict(list, {file: [time] for file, time in self.others.items()})
        for test in tests:
            parts[file_of(test)].append(self.long.get(test, 0.0))
        return {file: fsum(seconds) for file, seconds in parts.items()}  # the same in whatever order they come


def file_of(test: str) -> str:
    return test.partition("::")[0]


def in_turn(long: Mapping[str, float], seconds: float, place: float) -> set[str]:
    """The long tests of one run: in a circle of all of them those that begin in so many seconds from a place of it on.

    The place is a share of the circle, so that every test is taken by the same share of all runs, whatever it takes,
    and all are where the seconds are enough. In the circle tests are mixed, always in the same way.
    """
    whole = fsum(long.values())
    begin, found = -place * whole, set()
    for test in sorted(long, key=lambda test: crc32(test.encode())):
        if begin % whole < seconds:
            found.add(test)
        begin += long[test]
    return found


def place_of_the_commit(root: Path) -> float:
    """Between 0 and 1, as good as drawn by lot for each commit; 0 without one."""
    command = ["git", "rev-parse", "HEAD"]
    told = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False).stdout
    return crc32(told.strip().encode()) / 2**32 if told else 0.0


def _digit_sum(number: int, base: int) -> int:
    return number % base + _digit_sum(number // base, base) if number else 0


def needs_kernels(file: str) -> bool:
    return file.startswith(MOVING)


@cache
def reads_shared_derivations(file: str) -> bool:
    """Whether tests of a file read the derivations that `tests/derived.py` makes once for each process."""
    return bool(SHARING.search((ROOT / file).read_text(encoding="utf-8")))


class ByFile(LoadFileScheduling):
    """Each worker gets whole files, and one of them all those that share what is derived."""

    def _split_scope(self, nodeid: str) -> str:
        file: str = super()._split_scope(nodeid)
        return SHARED if reads_shared_derivations(file) else file


def in_order(files: Iterable[str], seconds: Mapping[str, float]) -> list[str]:
    """One file that has the kernels compiled; what can do without them meanwhile; the rest: each the longest first."""

    def place(file: str) -> tuple[bool, float, str]:
        return needs_kernels(file), -seconds.get(file, 0.0), file

    without, moving = [], []
    for file in sorted(files, key=place):
        (moving if needs_kernels(file) else without).append(file)
    return [*moving[-1:], *without, *moving[:-1]]


def recorded() -> Record:
    return Record(**json.loads(DURATIONS.read_text(encoding="utf-8")))


def measured(report: Path, before: Record, exists: Collection[str]) -> Record:
    """What a report of pytest tells, the longest first. Of long tests that had no turn in it, as before; of files it
    does not name, nothing.
    """
    seconds: Counter[str] = Counter()
    for case in ET.parse(report).iter("testcase"):
        file = f"{case.attrib['classname'].replace('.', '/')}.py"
        told = {each.attrib["name"]: each.attrib["value"] for each in case.iter("property")}
        own = float(case.attrib["time"]) - float(told.get(FOR_KERNELS, 0.0))
        seconds[f"{file}::{case.attrib['name'].partition('[')[0]}"] += own
    long = {test: time for test, time in before.long.items() if test not in seconds and test in exists}
    long |= {test: time for test, time in seconds.items() if time >= LONG}
    others: Counter[str] = Counter()
    for test, time in seconds.items():
        others[file_of(test)] += time if test not in long else 0.0
    return Record(_rounded(long, LONG), _rounded(others, NAMED))


def _rounded(seconds: Mapping[str, float], least: float) -> dict[str, float]:
    return {name: round(time, 1) for name, time in Counter(seconds).most_common() if time >= least}


def all_tests(root: Path) -> set[str]:
    """The functions named `test_…` in the files named so, by file and name."""
    found = set()
    for file in (root / "tests").rglob("test_*.py"):
        names = re.findall(r"^(?:async )?def (test_\w+)", file.read_text(encoding="utf-8"), re.MULTILINE)
        found |= {f"{file.relative_to(root)}::{name}" for name in names}
    return found


if __name__ == "__main__":
    now = measured(Path(sys.argv[1]), recorded(), all_tests(ROOT))
    content = json.dumps({"long": now.long, "others": now.others}, indent=1)
    DURATIONS.write_text(content + "\n", encoding="utf-8")
