"""Problems of an input, in sentences."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from typing import Any

from ..errors import Problem
from .catalog import message

LOGGER = logging.getLogger("deltaq.narration")


def described(problems: Iterable[Problem], language: str) -> list[dict[str, Any]]:
    """Each problem with its place, its code and what it says to the user."""
    return [
        {
            "pointer": problem.pointer,
            "offset": problem.offset,
            "length": problem.length,
            "code": problem.code,
            "severity": problem.severity,
            "message": _message(problem, language),
        }
        for problem in problems
    ]


def _message(problem: Problem, language: str) -> str:
    """The problem in words. A code without a sentence must not turn the client's mistake into ours."""
    try:
        return message(language, problem)
    except KeyError:
        LOGGER.warning("no sentence for %s in %s", problem.code, language)
        return problem.code
