"""How a computation ended, in words for programs; `narration/locales/*/statuses.json` has the sentences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeAlias

from ..vocabulary import RungStatus, Status
from .kernels.motion import (
    CANCELLED,
    EVENT,
    FINE,
    HELD,
    LOCKED,
    MANY_EVENTS,
    NEWTON_FAILED,
    NOT_FINITE,
    SINGULAR,
    STEP_LIMIT,
    STEP_UNDERFLOW,
    STIFF,
    TOO_LARGE,
    UNSETTLED,
)

Number: TypeAlias = str | int | float
# No kernel says so: of runs that go on behind events; of those whose steps are too short to come anywhere; of rods.
NO_DIRECTION, OUT_OF_REACH, SLIDES, CHATTERS, WITHIN_STEPS, NO_LENGTH = (UNSETTLED + k for k in range(1, 7))
DRIVES, HOLDS_LESS = UNSETTLED + 7, UNSETTLED + 8  # of friction
UNDETERMINED = UNSETTLED + 9  # of contacts at once

JUDGED = frozenset({"ok", "event", "stopped", "guide_jumps", "horizon_reached", "tolerance_missed"})


@dataclass(frozen=True)
class Outcome:
    """`status` is the machine word; `code` names the reason and the remedy in the catalogs, with `parameters`."""

    status: RungStatus
    code: str
    parameters: Mapping[str, Number] = field(default_factory=dict)

    @property
    def is_judged(self) -> bool:
        """Whether the runs came to where the motion ends, so that their difference tells how wrong it is there."""
        return self.status in JUDGED


OK = Outcome("ok", "ok")

# What the kernels return: status and code.
_WORDS: Mapping[int, tuple[Status, str]] = MappingProxyType(
    {
        FINE: ("ok", "ok"),
        STEP_LIMIT: ("step_limit", "step_limit"),
        SINGULAR: ("singular_mass_matrix", "singular_mass_matrix"),
        NOT_FINITE: ("diverged", "not_finite"),
        TOO_LARGE: ("diverged", "diverged"),
        STEP_UNDERFLOW: ("diverged", "step_underflow"),
        CANCELLED: ("cancelled", "cancelled"),
        NEWTON_FAILED: ("newton_failed", "newton_failed"),
        STIFF: ("stiff", "stiff"),
        EVENT: ("event", "event"),
        HELD: ("stopped", "stopped"),
        LOCKED: ("singular_constraints", "singular_constraints"),
        MANY_EVENTS: ("step_limit", "many_events"),
        UNSETTLED: ("unresolved", "contacts_at_once"),
        NO_DIRECTION: ("unresolved", "contact_without_direction"),
        UNDETERMINED: ("unresolved", "contacts_in_any_order"),
        OUT_OF_REACH: ("step_limit", "out_of_reach"),
        SLIDES: ("unresolved", "slides_along_kinks"),
        CHATTERS: ("unresolved", "switches_to_and_fro"),
        WITHIN_STEPS: ("step_limit", "switches_within_steps"),
        NO_LENGTH: ("singular_constraints", "length_vanishes"),
        DRIVES: ("unresolved", "friction_negative"),
        HOLDS_LESS: ("unresolved", "static_below_kinetic"),
    }
)


def outcome_of(kernel_outcome: int, parameters: Mapping[str, Number]) -> Outcome:
    """What a kernel reports, with what the sentences about it need to know."""
    status, code = _WORDS[kernel_outcome]
    return Outcome(status, code, dict(parameters))


def codes() -> tuple[str, ...]:
    """All codes that a trajectory may carry."""
    others = (
        "unresolved",
        "step_blind",
        "horizon_reached",
        "tolerance_missed",
        "unstable_step",
        "event_timed",
        "event_doubtful",
        "singular",
    )
    return (*(code for _, code in _WORDS.values()), *others)
