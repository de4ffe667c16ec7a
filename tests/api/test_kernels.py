"""On a machine without compiled kernels simulations wait for them; nobody is turned away meanwhile."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import pytest

from deltaq.api.kernels import Kernels
from deltaq.api.workers.job import Job, Preparing
from deltaq.api.workers.kernels import are_compiled
from deltaq.errors import UnknownNameError
from deltaq.simulation.kernels.marks import declared, mark

from .workers.conftest import MakePool, make_pool

__all__ = ["make_pool"]
COMPILE = Job("tests.api.workers.jobs:compile_family", 30.0)
SLEEP = Job("tests.api.workers.jobs:spin", 2.0)
ALL_BUT_NEWMARK = Job("tests.api.workers.jobs:compile_but_newmark", 30.0)
ECHO = Job("tests.api.workers.jobs:echo", 30.0)


@pytest.fixture(autouse=True)
def _new_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))


async def in_order(**waits: Coroutine[Any, Any, None]) -> list[str]:
    """The names of what is waited for, as it comes."""
    come: list[str] = []

    async def one(name: str, wait: Coroutine[Any, Any, None]) -> None:
        await wait
        come.append(name)

    await asyncio.gather(*(one(name, wait) for name, wait in waits.items()))
    return come


@pytest.mark.anyio
async def test_a_simulation_waits_for_the_kernels_of_its_method_only(make_pool: MakePool) -> None:
    pool, kernels = make_pool(), Kernels(COMPILE, ECHO)
    compiling = asyncio.create_task(kernels.compile(pool, pool, workers=1))
    await asyncio.sleep(0)
    assert kernels.is_compiling("auto")
    come = await in_order(
        experiment=kernels.wait(),
        newmark=kernels.wait("newmark"),
        radau=kernels.wait("radau-5"),
        auto=kernels.wait("auto"),
        rk4=kernels.wait("rk4"),
        ensembles=kernels.wait("ensembles"),
    )
    early, then, late = set(come[:2]), come[2:4], set(come[4:])
    assert (early, then, late) == ({"auto", "rk4"}, ["ensembles", "radau"], {"newmark", "experiment"})
    await compiling
    assert not kernels.is_compiling("newmark")


@pytest.mark.anyio
async def test_what_somebody_waits_for_is_compiled_first(make_pool: MakePool) -> None:
    pool, kernels = make_pool(), Kernels(COMPILE, ECHO)
    compiling = asyncio.create_task(kernels.compile(pool, pool, workers=1))
    await asyncio.sleep(0)  # the first group has been begun
    come = await in_order(
        taylor=kernels.wait("taylor"), ensembles=others(kernels, "ensembles"), implicit=others(kernels, "gauss-4")
    )
    assert come[0] == "taylor"
    await compiling


async def others(kernels: Kernels, method: str) -> None:
    """Until kernels are there that nobody asks for."""
    while kernels.is_compiling(method):
        await asyncio.sleep(0.01)


@pytest.mark.anyio
async def test_a_motion_is_tried_again_as_soon_as_there_is_one_kernel_more(
    make_pool: MakePool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("deltaq.api.kernels.PAUSE", 0.02)
    pool, kernels = make_pool(), Kernels(SLEEP, ECHO)
    compiling = asyncio.create_task(kernels.compile(pool, pool, workers=1))
    await asyncio.sleep(0)
    first, second, *_ = declared()
    waiting = asyncio.create_task(kernels.more("rk4", 0))
    await asyncio.sleep(0.1)
    assert not waiting.done()
    mark(first)
    assert await waiting == 1
    mark(second)
    assert await kernels.more("rk4", 1) == 2
    compiling.cancel()
    with pytest.raises(asyncio.CancelledError):
        await compiling


@pytest.mark.anyio
async def test_what_is_compiled_is_not_waited_for(make_pool: MakePool) -> None:
    pool, later = make_pool(), Kernels(SLEEP, SLEEP)
    mark(*declared())
    await later.compile(pool, pool, workers=2)
    await later.wait()
    assert pool.state.kills == 0  # as a job that spins is


@pytest.mark.anyio
async def test_kernels_that_cannot_be_compiled_stop_nobody(
    make_pool: MakePool, caplog: pytest.LogCaptureFixture
) -> None:
    pool, kernels = make_pool(), Kernels(ALL_BUT_NEWMARK, ECHO)
    await kernels.compile(pool, pool, workers=2)
    await kernels.wait()
    assert not are_compiled()
    assert [record.getMessage() for record in caplog.records if record.name == "deltaq.api"] == [
        "could not compile kernels {'family': 'newmark'}: ZeroDivisionError: division by zero"
    ]


@pytest.mark.anyio
async def test_patience_has_an_end(make_pool: MakePool) -> None:
    pool, kernels = make_pool(), Kernels(SLEEP, ECHO, timeout=0.05)
    compiling = asyncio.create_task(kernels.compile(pool, pool, workers=1))
    await asyncio.sleep(0)
    with pytest.raises(Preparing, match=r"^the numerical kernels are still being compiled$"):
        await kernels.wait("gauss-4")
    with pytest.raises(Preparing):
        await kernels.more("gauss-4", len(list(declared())))
    compiling.cancel()
    with pytest.raises(asyncio.CancelledError):
        await compiling


@pytest.mark.anyio
async def test_who_is_told_how_many_there_are_waits_for_as_long_as_they_are_compiled(make_pool: MakePool) -> None:
    pool, kernels, told = make_pool(), Kernels(SLEEP, ECHO, timeout=0.05), list[tuple[int, int]]()
    compiling = asyncio.create_task(kernels.compile(pool, pool, workers=1))
    await asyncio.sleep(0)
    waiting = asyncio.create_task(kernels.wait("gauss-4", tell=lambda here, all_: told.append((here, all_))))
    await asyncio.sleep(0.3)  # six times the patience of who is not told
    assert not waiting.done()
    assert told[0] == (0, len(list(declared())))
    for task in (waiting, compiling):
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task


@pytest.mark.anyio
async def test_an_unknown_method_is_not_waited_for() -> None:
    with pytest.raises(UnknownNameError) as caught:
        await Kernels().wait("rk5")
    assert caught.value.problems[0].parameters["suggestion"] == "rk4"
