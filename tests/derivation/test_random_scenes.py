"""Random valid scenes: derived with every step verified, equations as SymPy's, equilibria at rest, and a motion.

Thousands of them: `python -m tests.derivation.random_scenes 2000 1`.
"""

from __future__ import annotations

import pytest
from tests.derivation.random_scenes import faults, random_scene


@pytest.mark.parametrize("seed", range(1000, 1012))
def test_a_random_scene_is_sound(seed: int) -> None:
    assert faults(random_scene(seed)) == []
