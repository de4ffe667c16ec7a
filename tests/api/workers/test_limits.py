"""Bounds that the operating system keeps, tried in a process of its own."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

PROBE = """
import ctypes, json, resource, sys
from deltaq.api.workers import limits

def signal_at_death():
    number = ctypes.c_int()
    ctypes.CDLL(None).prctl(2, ctypes.byref(number))  # PR_GET_PDEATHSIG
    return number.value

hard = int(sys.argv[2])
for bound in (resource.RLIMIT_AS, resource.RLIMIT_CPU):
    resource.setrlimit(bound, (resource.RLIM_INFINITY if hard < 0 else hard,) * 2)
sys.platform = sys.argv[1]
limits.die_with_parent()
limits.bound_memory(2**33)
limits.bound_processor_time(1000.0)
soft = [resource.getrlimit(bound)[0] for bound in (resource.RLIMIT_AS, resource.RLIMIT_CPU)]
print(json.dumps([signal_at_death(), *soft]))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="asks the kernel")
@pytest.mark.parametrize(
    ("platform", "hard", "found"),
    [
        pytest.param("linux", -1, [9, 2**33, 1002], id="no bound from outside"),
        pytest.param("linux", 2**32, [9, 2**32, 1002], id="less memory allowed from outside"),
        pytest.param("darwin", -1, [0, 2**33, 1002], id="system that does not kill children"),
    ],
)
def test_bounds(platform: str, hard: int, found: list[int]) -> None:
    command = [sys.executable, "-c", PROBE, platform, str(hard)]
    probe = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(probe.stdout) == found
