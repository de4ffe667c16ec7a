"""What kernels report, told apart; and which motions can be said how wrong they are."""

from __future__ import annotations

from typing import get_args

import pytest

from deltaq.simulation.kernels import motion
from deltaq.simulation.outcome import (
    DRIVES,
    HOLDS_LESS,
    JUDGED,
    NO_DIRECTION,
    OK,
    OUT_OF_REACH,
    Outcome,
    codes,
    outcome_of,
)
from deltaq.vocabulary import RungStatus

REPORTED = [
    *(motion.FINE, motion.STEP_LIMIT, motion.SINGULAR, motion.NOT_FINITE, motion.TOO_LARGE, motion.STEP_UNDERFLOW),
    *(motion.CANCELLED, motion.NEWTON_FAILED, motion.STIFF, motion.EVENT, motion.HELD, motion.LOCKED),
    *(motion.MANY_EVENTS, motion.UNSETTLED, NO_DIRECTION, OUT_OF_REACH),
    *(DRIVES, HOLDS_LESS),
]


def test_no_two_reports_of_kernels_are_one() -> None:
    assert len({*REPORTED}) == len(REPORTED)
    told = [outcome_of(number, {"t": 1.0}) for number in REPORTED]
    assert len({each.code for each in told}) == len(REPORTED)
    assert {each.code for each in told} < {*codes()}
    assert {each.status for each in told} <= {*get_args(RungStatus)}
    assert all(each.parameters == {"t": 1.0} for each in told)
    assert outcome_of(motion.FINE, {}) == OK


@pytest.mark.parametrize(
    ("status", "judged"),
    [
        ("ok", True),
        ("event", True),
        ("stopped", True),
        ("guide_jumps", True),
        ("horizon_reached", True),
        ("tolerance_missed", True),
        ("diverged", False),
        ("step_limit", False),
        ("stiff", False),
        ("newton_failed", False),
        ("singular_mass_matrix", False),
        ("singular_constraints", False),
        ("singular", False),
        ("unresolved", False),
        ("cancelled", False),
    ],
)
def test_a_motion_is_judged_where_its_runs_came_to_its_end(status: RungStatus, judged: bool) -> None:
    assert Outcome(status, "whatever").is_judged is judged
    assert {*JUDGED} <= {*get_args(RungStatus)}
