"""What all tests share: the checkout, the kernels, and the order in which workers get the files."""

from __future__ import annotations

import fcntl
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.bundling import bundle_of
from tests.order import ByFile, durations, in_order, left_out, needs_kernels
from xdist.remote import Producer
from xdist.scheduler import LoadFileScheduling

from deltaq.api.workers.kernels import are_compiled, folder

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="session")
def root() -> Path:
    """The folder of the checkout."""
    return ROOT


@pytest.fixture(scope="session")
def kernels() -> None:
    """All kernels are compiled, by one process for all workers of the run and for the services that they start."""
    folder().mkdir(parents=True, exist_ok=True)
    with (folder() / "compiling.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not are_compiled():
            subprocess.run([sys.executable, "-m", "deltaq.cli", "compile"], check=True, stdout=subprocess.DEVNULL)


def pytest_xdist_auto_num_workers() -> int:
    """Two more than there are cores: some always wait, for a browser, a service or a deadline."""
    return (os.cpu_count() or 1) + 2


def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> LoadFileScheduling:
    return ByFile(config, log)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--every-case", action="store_true", help="also the cases that tests marked one_in(n) leave out")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Cases and files in the order of `tests/order.py`; those that need the kernels wait for them."""
    if not config.getoption("--every-case") and (left := left_out(items)):
        config.hook.pytest_deselected(items=left)
        items[:] = [item for item in items if item not in set(left)]
    of = {item: item.nodeid.partition("::")[0] for item in items}
    place = {file: index for index, file in enumerate(in_order(set(of.values()), durations()))}
    items.sort(key=lambda item: place[of[item]])
    for item in items:
        if needs_kernels(of[item]) and isinstance(item, pytest.Function):
            item.fixturenames.insert(0, "kernels")


@pytest.fixture(scope="session")
def bundle(root: Path) -> Path:
    """The folder of the page as packages have it."""
    return bundle_of(root)
