"""How far accelerations move with M and f, where M is tiny, huge or has no inverse in some states."""

from __future__ import annotations

import numpy as np
import pytest

from deltaq.model.layout import Layout
from deltaq.simulation.sensitivity import sensitivities

TWO = Layout(("x", "y"), (), (), (), (), 2, is_powered=False)
SINGULAR = [0.0, 0.0, 0.0, 3.0, 4.0]


@pytest.mark.parametrize(
    "beside", [[], [SINGULAR], [[np.nan] * 5]], ids=["alone", "no inverse beside", "none known beside"]
)
@pytest.mark.parametrize("mass", [1e-200, 1e-9, 1.0, 1e9, 1e200])
def test_what_a_state_depends_on_has_nothing_to_do_with_another(mass: float, beside: list[list[float]]) -> None:
    """q̈ = f/m of each coordinate: ∂q̈/∂f = 1/m, ∂q̈ₓ/∂mₓₓ = fₓ/m² and so on."""
    table = np.array([[mass, 0.0, mass, 3.0 * mass, 4.0 * mass], *beside])
    found, of_constraints = sensitivities(TWO, table, np.ones((len(table), 2)), 0)
    np.testing.assert_allclose(found[0] * mass, [3.0, 7.0, 4.0, 1.0, 1.0], rtol=1e-14)
    assert np.isinf(found[1:, 3:]).all()
    assert of_constraints.shape == (len(table), 0)
