"""Random valid scenes: derived with every step verified, equations as SymPy's, equilibria at rest, a motion, and tasks.

Thousands of them: `python -m tests.derivation.random_scenes 2000 1`.
"""

from __future__ import annotations

import pytest
from tests.derivation.random_scenes import faults, random_scene

# Four in which something was wrong: a factor that vanishes where two angles are equal, a drag that has no slope at
# rest, a spring of constant length, and an entry that is zero only once it is multiplied out.
MET = (76, 117, 127, 155)


@pytest.mark.parametrize("seed", [*MET, *range(1000, 1008)])
def test_a_random_scene_is_sound(seed: int) -> None:
    assert faults(random_scene(seed)) == []
