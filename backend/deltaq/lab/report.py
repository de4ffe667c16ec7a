"""What an experiment says while it runs."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

Document = dict[str, object]


@dataclass(frozen=True)
class Report:
    """How far an experiment is, and what it has found so far, as plain data; the last report has everything."""

    done: int
    total: int
    result: Document


def appended(result: Document, key: str, *items: object) -> Document:
    """The result with more at the end of one of its lists."""
    before = result[key]
    return result | {key: [*(before if isinstance(before, list) else []), *items]}


def significant(number: float, digits: int = 4) -> float:
    """A number for people: a few significant digits."""
    return float(f"{number:.{digits - 1}e}")


def rounded(numbers: Iterable[float], digits: int = 6) -> list[float]:
    """The numbers, each with so many significant digits."""
    return [significant(float(number), digits) for number in numbers]


def machine() -> Document:
    """What the times were measured on."""
    return {"processor": _processor(), "cores": os.cpu_count() or 1}


def measured(repetitions: int) -> Document:
    """When and under which circumstances times are measured, as of now.

    `date` is ISO 8601 in UTC; `load` how many programs wanted to run, on average over the last minute and for each
    processor, None where the system does not tell; `repetitions` how often a run is measured at most.
    """
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "load": _load(),
        "repetitions": repetitions,
        "processors": os.cpu_count() or 1,
    }


def _load() -> float | None:
    try:
        return significant(os.getloadavg()[0] / (os.cpu_count() or 1), 2)
    except (AttributeError, OSError):  # not everywhere
        return None


def _processor() -> str:
    """The name that Linux gives it, else that of its architecture."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.machine()
