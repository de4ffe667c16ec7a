"""Maps on a real Dask cluster of two workers, one of which is lost: where the extra `cluster` is installed."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from deltaq.lab.engine import SCHEDULER, engine
from deltaq.lab.monodromy import Axis, Plane, surveyed
from deltaq.mechanics.library import load_scene
from deltaq.simulation.service import problem_of

needs_dask = pytest.mark.skipif(find_spec("distributed") is None, reason="needs the extra cluster")


def test_without_a_scheduler_the_processors_of_this_machine_do_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(SCHEDULER, raising=False)
    with engine() as executor:
        assert isinstance(executor, ThreadPoolExecutor)


def start(stack: ExitStack, program: str, *options: str) -> subprocess.Popen[bytes]:
    """A process of the cluster, which is killed at the end."""
    command = [sys.executable, "-m", f"distributed.cli.dask_{program}", "--no-dashboard", *options]
    process = stack.enter_context(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
    stack.callback(process.kill)
    return process


@pytest.fixture
def cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[subprocess.Popen[bytes]]]:
    """The workers of a cluster that the environment names."""
    file = tmp_path / "scheduler.json"
    with ExitStack() as stack:
        start(stack, "scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(file))
        while not file.exists() or not file.read_text():
            time.sleep(0.05)
        address = json.loads(file.read_text())["address"]
        monkeypatch.setenv(SCHEDULER, address)
        options = (address, "--nthreads", "1", "--no-nanny", "--local-directory", str(tmp_path))
        yield [start(stack, "worker", *options) for _ in range(2)]


def kapitza() -> Plane:
    """Where Kapitza's pendulum stands; 900 points."""
    problem, frequencies = problem_of(load_scene("kapitza"), 1.0), np.linspace(20.0, 120.0, 30)
    periods = np.broadcast_to(2.0 * np.pi / frequencies, (30, 30))
    amplitudes = tuple(map(float, np.linspace(0.01, 0.1, 30)))
    return Plane(problem, Axis("omega", tuple(map(float, frequencies))), Axis("y0", amplitudes), periods)


@needs_dask
@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_map_on_a_cluster_is_the_same(cluster: list[subprocess.Popen[bytes]], monkeypatch: pytest.MonkeyPatch) -> None:
    found = kapitza().map()
    monkeypatch.delenv(SCHEDULER)
    here = kapitza().map()
    assert np.array_equal(found.growth, here.growth, equal_nan=True)
    assert np.array_equal(found.states, here.states, equal_nan=True)


@needs_dask
@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_nothing_is_missing_when_a_worker_is_lost_in_the_middle(cluster: list[subprocess.Popen[bytes]]) -> None:
    plane, cancelled = kapitza(), np.zeros(1, dtype=np.int64)
    parts = [plane._part(slice(first, first + 10)) for first in range(0, 900, 10)]
    work = partial(surveyed, plane.problem, plane.problem.state[:2], cancelled)
    with engine() as executor:
        results = executor.map(work, parts)
        first = next(results)
        cluster[0].kill()
        found = [first, *results]
    assert cluster[1].poll() is None
    expected = [work(part) for part in parts]
    pairs = zip(found, expected, strict=True)
    assert all(np.array_equal(one.matrices, other.matrices) for one, other in pairs)
