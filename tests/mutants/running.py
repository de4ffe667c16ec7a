"""Tests in processes of their own: what they enter, and whether one of them notices a fault.

All tests of a part are read once. From there each fault has a process that puts the broken function in the place of the
sound one and runs the tests that can notice. That is the same as to begin anew, unless the function has run while
modules and tests were read: such faults, and those outside functions, are read by a process that begins anew.
"""

from __future__ import annotations

import contextlib
import gc
import math
import os
import pickle
import resource
import signal
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import accumulate
from pathlib import Path
from typing import Any, NoReturn

import pytest

from .entries import Entries, Recorder, Start, file_of, function_around, in_turn, telling
from .faults import Mutant
from .replacing import Functions, replace

OPTIONS = (
    *("-n0", "--every-case", "-q"),
    *("--capture", "sys"),
    *("-p", "no:cacheprovider"),
    *("--timeout", "0", "-o", "faulthandler_timeout=0"),  # each test has a limit of its own, by the same timer
    *("-W", "ignore::pytest.PytestAssertRewriteWarning"),
)
MEMORY = 8 << 30
LEAST = 10.0  # seconds of a processor that a test may always take
PATIENCE = 5.0  # how often as long as the sound code beyond that
WAITING = 10.0  # times as long until somebody who waits for nothing gives up
SURVIVES, NOTICED, ANEW, BROKEN = range(4)

Work = Callable[[pytest.Session], None]


@dataclass(frozen=True)
class Record:
    """What the tests enter, and what has been entered when they were read."""

    entries: Sequence[Entries]
    before: frozenset[Start]
    most: float = math.inf  # seconds that all tests of a mutant may take together, the quickest first

    def tests_for(self, mutant: Mutant) -> list[str]:
        """The tests that can notice a fault, in the order in which they are to be asked.

        What has run when the tests were read may matter to tests that do not enter it.
        """
        start = function_around(mutant.module, mutant.line)
        tests = in_turn(start, self.entries)
        if start in self.before:
            tests += [test for test in in_turn(None, self.entries) if test not in tests]
        took = {test: seconds for one in self.entries for test, seconds in one.seconds.items()}
        totals = accumulate(took[test] for test in tests)
        return [test for test, total in zip(tests, totals, strict=True) if total <= self.most]

    def is_fresh(self, mutant: Mutant) -> bool:
        """Whether the broken code has not run before the tests begin."""
        start = function_around(mutant.module, mutant.line)
        return start is not None and start not in self.before

    def seconds(self, test: str) -> float:
        """How long a test may take: what its file keeps for all tests may be made in any of them."""
        return LEAST + PATIENCE * sum(sum(one.seconds.values()) for one in self.entries if one.file == file_of(test))


def recorded(files: Sequence[str], modules: Sequence[Path], width: int = 1, most: float = math.inf) -> Record:
    """Runs all tests of the sound modules, each file in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        before = Path(folder, "before")
        answers = {file: Path(folder, str(number)) for number, file in enumerate(files)}

        def run(session: pytest.Session, recorder: Recorder, file: str) -> int:
            failed = _run(session, [item.nodeid for item in session.items if file_of(item.nodeid) == file])
            answers[file].write_bytes(pickle.dumps(recorder.entries))
            return NOTICED if failed else SURVIVES

        def work(session: pytest.Session, recorder: Recorder) -> None:
            before.write_bytes(pickle.dumps(frozenset(recorder.now)))
            for file, code in _at_once({file: partial(run, session, recorder, file) for file in files}, width):
                if code != SURVIVES:
                    answers[file].unlink(missing_ok=True)

        def begin() -> int:
            replace({str(module): telling(module) for module in modules})
            recorder = Recorder()
            return _read(files, partial(work, recorder=recorder), recorder)

        list(_at_once({"all": begin}, 1))
        failing = [file for file, answer in answers.items() if not answer.exists()]
        if failing:
            raise SystemExit(f"Without any fault, not all tests pass in {', '.join(failing)}")
        return Record([_unpickled(answer) for answer in answers.values()], _unpickled(before), most)


def verdicts(
    mutants: Mapping[int, Mutant], record: Record, modules: Sequence[Path], width: int
) -> Iterator[tuple[int, bool]]:
    """The number of each mutant and whether a test noticed it, in the order in which that becomes known."""
    fresh = {number: mutant for number, mutant in mutants.items() if record.is_fresh(mutant)}
    anew = {number: mutant for number, mutant in mutants.items() if number not in fresh}
    for number, code in _from_one_reading(fresh, record, modules, width):
        if code == ANEW:
            anew[number] = fresh[number]
        else:
            yield number, code == NOTICED
    jobs = {number: partial(_begun_anew, mutant, record) for number, mutant in anew.items()}
    yield from ((number, code == NOTICED) for number, code in _at_once(jobs, width))


def _from_one_reading(
    mutants: Mapping[int, Mutant], record: Record, modules: Sequence[Path], width: int
) -> Iterator[tuple[int, int]]:
    reading, writing = os.pipe()

    def job(session: pytest.Session, functions: Functions, mutant: Mutant) -> int:
        if not functions.put(mutant.module, mutant.code):
            return ANEW
        return _asked(session, record.tests_for(mutant), record)

    def work(session: pytest.Session) -> None:
        functions = Functions(modules)
        gc.freeze()
        jobs = {number: partial(job, session, functions, mutant) for number, mutant in mutants.items()}
        for number, code in _at_once(jobs, width):
            os.write(writing, f"{number} {code}\n".encode())

    def begin() -> NoReturn:
        os.close(reading)
        os._exit(_read([one.file for one in record.entries], work))

    child = os.fork()
    if child == 0:
        begin()
    os.close(writing)
    with os.fdopen(reading) as lines:
        for line in lines:
            number, code = map(int, line.split())
            yield number, code
    os.waitpid(child, 0)


def _begun_anew(mutant: Mutant, record: Record) -> int:
    """Reads the broken module in the place of the sound one; tests that cannot even be read have noticed."""
    tests = record.tests_for(mutant)
    if not tests:
        return SURVIVES
    found: list[int] = []
    replace({str(mutant.module): mutant.code})
    _read(sorted({file_of(test) for test in tests}), lambda session: found.append(_asked(session, tests, record)))
    return found[0] if found else NOTICED


def _asked(session: pytest.Session, tests: Sequence[str], record: Record) -> int:
    return NOTICED if _run(session, tests, record.seconds) else SURVIVES


def _run(session: pytest.Session, tests: Sequence[str], seconds: Callable[[str], float] | None = None) -> bool:
    """Runs tests in this order until one fails; whether one did. One that takes too long ends the process."""
    known = {item.nodeid: item for item in session.items}
    items = [known[test] for test in tests]
    for item, following in zip(items, [*items[1:], None], strict=False):
        if seconds:
            signal.setitimer(signal.ITIMER_PROF, seconds(item.nodeid))
            signal.setitimer(signal.ITIMER_REAL, WAITING * seconds(item.nodeid))
        item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
        if session.testsfailed:
            return True
    return False


class _Loop:
    """A plugin of pytest: what is done with the tests when they have been read."""

    def __init__(self, work: Work) -> None:
        self._work = work

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        if session.testsfailed:
            raise session.Interrupted("Not all tests can be read.")
        self._work(session)
        return True


def _read(files: Sequence[str], work: Work, *plugins: Any) -> int:
    _hush()
    return int(pytest.main([*OPTIONS, *files], plugins=[_Loop(work), *plugins]))


def _hush() -> None:
    """No output, and no more memory than is fair."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)


def _at_once(jobs: Mapping[Any, Callable[[], int]], width: int) -> Iterator[tuple[Any, int]]:
    """Does jobs in processes of their own, so many at a time: their names and answers; who is killed has noticed."""
    waiting = iter(jobs.items())
    running: dict[int, Any] = {}
    while True:
        for name, job in waiting:
            running[_begun(job)] = name
            if len(running) == width:
                break
        if not running:
            return
        child, status = os.waitpid(-1, 0)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child, signal.SIGKILL)  # what it has started itself
        yield running.pop(child), os.waitstatus_to_exitcode(status) if os.WIFEXITED(status) else NOTICED


def _begun(job: Callable[[], int]) -> int:
    child = os.fork()
    if child == 0:
        code = BROKEN
        try:
            os.setpgid(0, 0)
            code = job()
        finally:
            os._exit(code)  # whatever happened: what is above belongs to the process that has forked
    return child


def _unpickled(file: Path) -> Any:
    return pickle.loads(file.read_bytes())
