"""Settings of the service: one environment variable DELTAQ_<NAME> for each field, read once at start."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields
from typing import Any

from .errors import DeltaqError

MEBIBYTE = 2**20
PREFIX = "DELTAQ_"
_ORIGIN = re.compile(r"\*|https?://[A-Za-z0-9.*-]+(:\d+)?")
LOG_LEVELS = ("debug", "info", "warning", "error")


class SettingsError(DeltaqError):
    """An environment variable does not hold what its setting needs."""


def setting(default: float | str | tuple[str, ...], meaning: str) -> Any:
    """A field with its meaning, which the help shows."""
    return field(default=default, metadata={"meaning": meaning})


@dataclass(frozen=True)
class Settings:
    """How the service is run. Times are in seconds, sizes in bytes, lists are separated by commas."""

    workers: int = field(
        default_factory=lambda: max(2, os.cpu_count() or 2),
        metadata={"meaning": "worker processes; else one for each processor"},
    )
    queue_length: int = setting(1024, "jobs that may wait before others are refused")
    queue_patience: float = setting(15.0, "seconds after which a job that waits is refused")
    start_timeout: float = setting(60.0, "seconds within which a worker must be up")
    derivation_deadline: float = setting(5.0, "seconds of a processor for a derivation; by the clock twice that")
    simulation_deadline: float = setting(20.0, "seconds of a processor for a simulation; by the clock twice that")
    experiment_deadline: float = setting(180.0, "seconds for an experiment")
    experiment_workers: int = setting(1, "experiments at a time; they measure times, so they want a quiet machine")
    experiment_queue: int = setting(128, "experiments that may wait; one client gets half of the places")
    experiment_patience: float = setting(1800.0, "seconds after which an experiment that waits is refused")
    worker_memory: int = setting(2048 * MEBIBYTE, "bytes of address space of a worker")
    jobs_per_worker: int = setting(1000, "jobs after which a worker is replaced")
    cache_size: int = setting(128 * MEBIBYTE, "bytes of answers kept in memory")
    cache_folder: str = setting("", "folder of answers that outlive the service; else they are in memory only")
    cache_folder_size: int = setting(1024 * MEBIBYTE, "bytes of answers kept in that folder")
    redis: str = setting("", "address of a Redis that replicas share, such as redis://host:6379/0")
    scheduler: str = setting("", "address of a Dask that works out maps, such as tcp://host:8786")  # read by deltaq.lab
    client_share: float = setting(0.5, "part of the processors that one client gets for long; 0: all; on loopback too")
    client_credit: float = setting(120.0, "seconds of processor time that one client gets beyond that")
    largest_body: int = setting(MEBIBYTE, "bytes of a request's body")
    body_timeout: float = setting(10.0, "seconds within which a body must be complete")
    head_timeout: float = setting(10.0, "seconds within which the head of a request must be complete")
    reading_timeout: float = setting(10.0, "seconds within which a client must have read some of its answer")
    drain_timeout: int = setting(8, "seconds that requests under way get when the service ends")
    trusted_proxies: tuple[str, ...] = setting(("127.0.0.1", "::1"), "proxies whose X-Forwarded-For is believed")
    allowed_hosts: tuple[str, ...] = setting((), "names under which it answers; else all, on loopback its own")
    frame_ancestors: tuple[str, ...] = setting((), "origins whose pages may show it in a frame, such as a course's")
    cors_origins: tuple[str, ...] = setting((), "origins whose pages may call the API; * for all")
    log_level: str = setting("warning", f"what is logged: {', '.join(LOG_LEVELS)} (info: each request)")
    model_cache: str = setting("", "folder of compiled models")  # read by deltaq.model.store
    static: str = setting("", "folder of the page's files")

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] | None = None) -> Settings:
        """The defaults, changed by the variables that are set."""
        given = os.environ if environment is None else environment
        variables = {variable_of(f): f for f in fields(cls)}
        if unknown := [name for name in given if name.startswith(PREFIX) and name not in variables]:
            raise SettingsError(f"unknown settings: {', '.join(sorted(unknown))}; known are {', '.join(variables)}")
        return cls(**{f.name: _read(name, str(f.type), given[name]) for name, f in variables.items() if name in given})

    def __post_init__(self) -> None:
        if wrong := next(_mistakes(self), None):
            raise SettingsError(PREFIX + wrong)


def _mistakes(given: Settings) -> Iterator[str]:
    for name in ("workers", "queue_length", "jobs_per_worker", "experiment_workers", "experiment_queue"):
        if getattr(given, name) < 1:
            yield f"{name.upper()} must be at least 1"
    for name in (f.name for f in fields(given) if f.name.endswith(("_deadline", "_timeout", "_patience"))):
        if not getattr(given, name) > 0:
            yield f"{name.upper()} must be above 0"
    if given.worker_memory < 1024 * MEBIBYTE:
        yield f"WORKER_MEMORY must be at least {1024 * MEBIBYTE}: the libraries need it"
    if given.log_level not in LOG_LEVELS:
        yield f"LOG_LEVEL must be one of {', '.join(LOG_LEVELS)}, not {given.log_level!r}"
    for name in ("frame_ancestors", "cors_origins"):
        wrong = [one for one in getattr(given, name) if not _ORIGIN.fullmatch(one)]
        yield from (f"{name.upper()} needs origins such as https://example.org, not {one!r}" for one in wrong)


def described() -> Iterator[str]:
    """One line for each variable: its name, what it means, its default."""
    width = max(len(variable_of(f)) for f in fields(Settings))
    for f in fields(Settings):
        default = "" if f.default in (MISSING, "", ()) else f" [{_written(f.default)}]"
        yield f"{variable_of(f):{width}}  {f.metadata['meaning']}{default}"


def _written(default: Any) -> str:
    return ",".join(default) if isinstance(default, tuple) else str(default)


def variable_of(setting: Field[Any]) -> str:
    """The environment variable of a setting."""
    return PREFIX + setting.name.upper()


def _parts(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _read(variable: str, kind: str, text: str) -> Any:
    readers: dict[str, Callable[[str], Any]] = {"int": int, "float": float, "str": str, "tuple[str, ...]": _parts}
    try:
        return readers[kind](text)
    except ValueError as error:
        raise SettingsError(f"{variable} must be a number, not {text!r}") from error
