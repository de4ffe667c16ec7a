"""What all tests share: the checkout, the kernels, and the order in which workers get the files."""

from __future__ import annotations

import fcntl
import os
import subprocess
import sys
from collections.abc import Generator, Iterator
from importlib import import_module
from pathlib import Path
from time import perf_counter

import pytest
from tests.bundling import bundle_of, made
from tests.order import (
    BUDGET,
    FOR_KERNELS,
    ByFile,
    Record,
    file_of,
    in_order,
    in_turn,
    left_out,
    needs_kernels,
    place_of_the_commit,
    recorded,
)
from tests.serving import PATIENT, shared
from xdist.remote import Producer
from xdist.scheduler import LoadFileScheduling
from xdist.workermanage import WorkerController

from deltaq.api.workers.kernels import are_compiled

ROOT = Path(__file__).parents[1]
WAITED = pytest.StashKey[float]()  # seconds for the kernels, of the test that was set up first
OMITTED = pytest.StashKey[dict[str, int]]()  # how many tests and cases a run leaves out


@pytest.fixture(scope="session")
def root() -> Path:
    """The folder of the checkout."""
    return ROOT


@pytest.fixture(scope="session")
def kernels(request: pytest.FixtureRequest) -> None:
    """All kernels are compiled, by one process for all workers of the run and for the services that they start."""
    start = perf_counter()
    if not are_compiled():
        subprocess.run([sys.executable, "-m", "deltaq.cli", "compile"], check=True, stdout=subprocess.DEVNULL)
    import_module("deltaq.simulation.kernels.machine")  # or short motions would be interpreted: see `Interpretation`
    request.config.stash[WAITED] = perf_counter() - start


@pytest.fixture(scope="session")
def of_the_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that all workers of this run share."""
    own = tmp_path_factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


@pytest.fixture(scope="session")
def server(root: Path, of_the_run: Path, kernels: None) -> Iterator[str]:
    """The address of the service that all tests of this run share, with the page as packages have it.

    From its sources if there is no esbuild. Answers are kept: each is computed once. Tests that burden a service, end
    it or look at how it is doing have one of their own.
    """
    with shared(of_the_run / "server", static=made(root) or "", **common(of_the_run)) as address:
        yield address


@pytest.fixture(scope="session")
def source_server(of_the_run: Path, kernels: None) -> Iterator[str]:
    """The address of another one, with the page from its sources, as who works on it sees it."""
    with shared(of_the_run / "source_server", static="", **common(of_the_run)) as address:
        yield address


def common(folder: Path) -> dict[str, object]:
    """The settings of services that are shared; all their clients are one, which may have all of the processors."""
    return {"workers": 2, "client_share": 0, "cache_folder": folder / "answers", **PATIENT}


def pytest_xdist_auto_num_workers() -> int:
    """Two more than there are cores: some always wait, for a browser, a service or a deadline."""
    return (os.cpu_count() or 1) + 2


def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> LoadFileScheduling:
    return ByFile(config, log)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--every-case", action="store_true", help="also cases and long tests that others stand for")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """One worker imports all tests before the others begin, who find on disk what it has compiled.

    In a fresh clone each would compile all of the sources and tests, since all come to each file at the same time.
    """
    with Path(__file__).open("rb") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            fcntl.flock(lock, fcntl.LOCK_SH)  # together, once the first has done
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item: pytest.Item) -> Iterator[None]:
    """Waiting for the kernels is no time of the test that does so; the report tells it apart."""
    result = yield
    waited = item.config.stash.get(WAITED, 0.0)
    if waited:
        item.user_properties.append((FOR_KERNELS, waited))
        item.config.stash[WAITED] = 0.0
    return result


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Of all tests those whose turn it is, cases and files in the order of `tests/order.py`; those that need the
    kernels wait for them.
    """
    record, tests = recorded(), {item: item.nodeid.partition("[")[0] for item in items}
    if not config.getoption("--every-case"):
        waiting = other_turns(tests, record) if takes_turns(config) else set()
        omitted = {*left_out(items), *(item for item in items if tests[item] in waiting)}
        config.hook.pytest_deselected(items=list(omitted))
        items[:] = [item for item in items if item not in omitted]
        told = config.workeroutput if hasattr(config, "workeroutput") else config.stash.setdefault(OMITTED, {})
        told |= {"cases": len(omitted), "tests": len(waiting)}
    files = {file_of(tests[item]) for item in items}
    seconds = record.by_file({tests[item] for item in items})
    place = {file: index for index, file in enumerate(in_order(files, seconds))}
    items.sort(key=lambda item: place[file_of(tests[item])])
    for item in items:
        if needs_kernels(file_of(tests[item])) and isinstance(item, pytest.Function):
            item.fixturenames.insert(0, "kernels")


def other_turns(tests: dict[pytest.Item, str], record: Record) -> set[str]:
    """The long tests whose turn comes with other commits."""
    always = {test for item, test in tests.items() if item.get_closest_marker("always")}
    long = {test: record.long[test] for test in {*tests.values()} - always if test in record.long}
    return long.keys() - in_turn(long, BUDGET, place_of_the_commit(ROOT))


def takes_turns(config: pytest.Config) -> bool:
    """Whether all tests are asked for: what is named, by a file or a word, runs."""
    if hasattr(config, "workerinput"):
        return bool(config.workerinput["takes_turns"])
    named = config.args_source is not pytest.Config.ArgsSource.TESTPATHS
    return not (named or config.option.keyword or config.option.markexpr)


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: WorkerController) -> None:
    node.workerinput["takes_turns"] = takes_turns(node.config)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: WorkerController, error: object) -> None:
    node.config.stash.setdefault(OMITTED, {}).update(getattr(node, "workeroutput", None) or {})


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    omitted = config.stash.get(OMITTED, {})
    if omitted.get("cases"):
        terminalreporter.write_line(
            f"LEFT OUT: {omitted['cases']} cases, with those of {omitted['tests']} long tests whose turn comes with "
            "other commits; --every-case takes all"
        )


@pytest.fixture(scope="session")
def bundle(root: Path) -> Path:
    """The folder of the page as packages have it."""
    return bundle_of(root)
