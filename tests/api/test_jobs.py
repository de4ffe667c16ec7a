"""What the routes hand to workers."""

from __future__ import annotations

import pytest

from deltaq.api import kernels
from deltaq.api.workers.job import Job
from deltaq.api.workers.runner import function_of
from deltaq.packages import modules_of

JOBS = [
    pytest.param(job, id=f"{module.__name__.rpartition('.')[2]}-{name}")
    for module in (*modules_of("deltaq.api.routes"), kernels)
    for name, job in vars(module).items()
    if isinstance(job, Job)
]


@pytest.mark.parametrize("job", JOBS)
def test_job_names_a_function_that_takes_one_document(job: Job) -> None:
    function = function_of(job.target)
    assert function.__code__.co_argcount == 1
