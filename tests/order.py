"""Which cases a run takes, and the order in which the workers get the files, so that none has a long one at the end.

`python -m tests.order report.xml` writes `durations.json` anew from what `pytest --junit-xml=report.xml` has measured.
"""

from __future__ import annotations

import json
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from xml.etree import ElementTree as ET
from zlib import crc32

import pytest
from xdist.scheduler import LoadFileScheduling

ROOT = Path(__file__).parents[1]
DURATIONS = Path(__file__).with_name("durations.json")
SHARING = re.compile(r"^from tests(\.derived import | import derived)", re.MULTILINE)
SHARED = "tests of shared derivations"
SHORT = 3.0  # seconds: a file below is not worth naming
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


def durations() -> dict[str, float]:
    """Seconds by file, as measured last; a file that is not named is a short one."""
    found: dict[str, float] = json.loads(DURATIONS.read_text(encoding="utf-8"))
    return found


def measured(report: Path) -> dict[str, float]:
    """Seconds by file in a report of pytest, the longest first."""
    seconds: Counter[str] = Counter()
    for case in ET.parse(report).iter("testcase"):
        seconds[f"{case.attrib['classname'].replace('.', '/')}.py"] += float(case.attrib["time"])
    return {file: round(total) for file, total in seconds.most_common() if total >= SHORT}


if __name__ == "__main__":
    DURATIONS.write_text(json.dumps(measured(Path(sys.argv[1])), indent=1) + "\n", encoding="utf-8")
