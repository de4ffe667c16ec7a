"""Random valid scenes: derived with every step verified, equations as SymPy's, equilibria at rest, a motion, and tasks.

Thousands of them: `python -m tests.derivation.random_scenes 2000 1`.
"""

from __future__ import annotations

import pytest
from tests.derivation.random_scenes import faults, random_scene, wrong_tasks

# Those in which something was wrong: a factor that vanishes where two angles are equal, a drag that has no slope at
# rest, a spring of constant length, an entry that is zero only once it is multiplied out, a position at 1e-80, two
# equal frequencies.
MET = (76, 117, 127, 155, 332, 9100647)


@pytest.mark.one_in(6)
@pytest.mark.parametrize("seed", MET)
def test_the_tasks_of_a_scene_that_had_a_fault_have_right_answers(seed: int) -> None:
    assert wrong_tasks(random_scene(seed), seconds=60) == []


@pytest.mark.one_in(3)
@pytest.mark.parametrize("seed", [*range(1000, 1003), 9100403])  # the last: friction wins between both ends of a band
def test_a_random_scene_is_sound(seed: int) -> None:
    assert faults(random_scene(seed)) == []
