"""Maps on a real Dask cluster of two workers, one of which is lost: where the extra `cluster` is installed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from deltaq.api.jobs import ensemble
from deltaq.contract.ensemble import EnsembleRequest
from deltaq.lab import engine as engine_module
from deltaq.lab import flips
from deltaq.lab.engine import SCHEDULER, engine
from deltaq.lab.monodromy import Axis, Plane, part_of, surveyed
from deltaq.mechanics.library import load_scene
from deltaq.simulation.service import problem_of

needs_dask = pytest.mark.skipif(find_spec("distributed") is None, reason="needs the extra cluster")


def test_without_a_scheduler_the_processors_of_this_machine_do_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(SCHEDULER, raising=False)
    with engine() as executor:
        assert isinstance(executor, ThreadPoolExecutor)


def test_cluster_that_does_not_answer_is_done_without(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv(SCHEDULER, "tcp://127.0.0.1:9")
    monkeypatch.setattr(engine_module, "CLUSTER_TIMEOUT", 0.2)
    with engine() as executor:
        assert list(executor.map(abs, [-1, 2])) == [1, 2]
    assert [record.message.partition(":")[0] for record in caplog.records if record.name == "deltaq.lab"] == [
        "a map is worked out here, for the cluster does not answer"
    ]


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
    parts = [part_of(plane._table, slice(first, first + 10)) for first in range(0, 900, 10)]
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


@needs_dask
@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_map_of_flips_on_a_cluster_is_the_same(
    cluster: list[subprocess.Popen[bytes]], monkeypatch: pytest.MonkeyPatch
) -> None:
    angles = np.linspace(-3.0, 3.0, 20)
    plane = flips.Plane(problem_of(load_scene("double-pendulum"), 3.0), 0, 1, angles, angles)
    found = list(plane.refined())[-1]
    monkeypatch.delenv(SCHEDULER)
    assert np.array_equal(found, list(plane.refined())[-1])
    assert np.isfinite(found).any()


ENDLESS = """
import numpy as np
from deltaq.lab.flips import Plane
from deltaq.mechanics.library import load_scene
from deltaq.simulation.service import problem_of

angles = np.linspace(0.1, 0.2, 80)
list(Plane(problem_of(load_scene("pendulum"), 1e5), 0, 0, angles, angles).refined())
"""


def state_of(address: str) -> tuple[int, int]:
    """How many tasks the scheduler knows, and on how many threads of the workers it is worked."""
    from distributed import Client

    with Client(address, set_as_default=False) as client:
        tasks = client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks))
        return tasks, sum(client.run(lambda dask_worker: len(dask_worker.active_threads)).values())


def reached(address: str, wanted: Callable[[tuple[int, int]], bool], seconds: float) -> bool:
    end = time.monotonic() + seconds
    while not wanted(state_of(address)) and time.monotonic() < end:
        time.sleep(0.1)
    return wanted(state_of(address))


@needs_dask
@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_cluster_rests_when_the_process_that_asked_is_killed(cluster: list[subprocess.Popen[bytes]]) -> None:
    address = os.environ[SCHEDULER]
    with subprocess.Popen([sys.executable, "-c", ENDLESS]) as asking:
        assert reached(address, lambda state: state[0] > 2 and state[1] == 2, 60.0)
        asking.kill()
    assert reached(address, lambda state: state == (0, 0), 20.0)  # what was under way would take minutes
    assert [worker.poll() for worker in cluster] == [None, None]


@needs_dask
@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_cluster_rests_when_the_map_is_given_up(cluster: list[subprocess.Popen[bytes]]) -> None:
    angles = np.linspace(0.1, 0.2, 80)
    plane = flips.Plane(problem_of(load_scene("pendulum"), 1e5), 0, 0, angles, angles)
    with engine() as executor:
        parts = executor.map(plane._times, [64 * [(0, place)] for place in range(16)])
        assert reached(os.environ[SCHEDULER], lambda state: state[0] > 2 and state[1] == 2, 60.0)
    assert reached(os.environ[SCHEDULER], lambda state: state == (0, 0), 20.0)
    del parts


@needs_dask
@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_ensemble_on_a_cluster_is_the_same(
    cluster: list[subprocess.Popen[bytes]], monkeypatch: pytest.MonkeyPatch
) -> None:
    values = {"from": 0.5, "to": 1.5, "count": 3000}
    asked = {"scene": "pendulum", "t_end": 1.0, "samples": 3, "vary": {"initial.phi.value": values}}
    request = EnsembleRequest.model_validate(asked).model_dump() | {"lang": "en"}
    found = ensemble({"request": request})
    monkeypatch.delenv(SCHEDULER)
    here = ensemble({"request": request})
    assert all(process.poll() is None for process in cluster)
    assert {**found, "wall_time": 0.0} == {**here, "wall_time": 0.0}
