"""Settings of the service: one environment variable DELTAQ_<NAME> for each field, read once at start."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any

MEBIBYTE = 2**20
PREFIX = "DELTAQ_"


class SettingsError(Exception):
    """An environment variable does not hold what its setting needs."""


@dataclass(frozen=True)
class Settings:
    """How the service is run. Times are in seconds, sizes in bytes."""

    workers: int = field(default_factory=lambda: max(2, os.cpu_count() or 2))
    queue_length: int = 1024
    queue_patience: float = 15.0
    start_timeout: float = 60.0
    derivation_deadline: float = 10.0
    simulation_deadline: float = 20.0
    worker_memory: int = 2048 * MEBIBYTE
    jobs_per_worker: int = 1000
    cache_size: int = 128 * MEBIBYTE
    largest_body: int = MEBIBYTE
    body_timeout: float = 10.0
    model_cache: str = ""  # folder of compiled models; read by deltaq.model.store
    static: str = ""

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] | None = None) -> Settings:
        """The defaults, changed by the variables that are set."""
        given = os.environ if environment is None else environment
        variables = {PREFIX + f.name.upper(): f for f in fields(cls)}
        if unknown := [name for name in given if name.startswith(PREFIX) and name not in variables]:
            raise SettingsError(f"unknown settings: {', '.join(sorted(unknown))}; known are {', '.join(variables)}")
        return cls(**{f.name: _read(name, str(f.type), given[name]) for name, f in variables.items() if name in given})

    def __post_init__(self) -> None:
        for name in ("workers", "queue_length", "jobs_per_worker"):
            if getattr(self, name) < 1:
                raise SettingsError(f"{PREFIX}{name.upper()} must be at least 1")
        if self.worker_memory < 1024 * MEBIBYTE:
            raise SettingsError(f"{PREFIX}WORKER_MEMORY must be at least {1024 * MEBIBYTE}: the libraries need it")


def _read(variable: str, kind: str, text: str) -> Any:
    readers: dict[str, Callable[[str], Any]] = {"int": int, "float": float, "str": str}
    try:
        return readers[kind](text)
    except ValueError as error:
        raise SettingsError(f"{variable} must be a number, not {text!r}") from error
