"""Settings of the service: one environment variable DELTAQ_<NAME> for each field, read once at start."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields
from importlib.util import find_spec
from typing import Any

from .admissible import (
    Check,
    above_zero,
    address,
    each,
    folder,
    folder_there,
    is_calling,
    is_framing,
    is_host,
    is_proxy,
    one_of,
    within,
)
from .errors import DeltaqError

MEBIBYTE = 2**20
PREFIX = "DELTAQ_"
DAY = 86400
LARGEST = 2**44  # bytes of anything
EXTRAS = {
    "redis": ("redis", "redis"),
    "scheduler": ("distributed", "cluster"),
}  # the package a setting needs, its extra
_WRITTEN = {
    "int": re.compile(r"[+-]?[0-9]{1,18}"),
    "float": re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)(e[+-]?[0-9]{1,3})?|nan|[+-]?inf(inity)?", re.IGNORECASE),
}
LOG_LEVELS = ("debug", "info", "warning", "error")


class SettingsError(DeltaqError):
    """An environment variable does not hold what its setting needs."""


def setting(default: float | str | tuple[str, ...], meaning: str, check: Check) -> Any:
    """A field with its meaning, which the help shows, and what its value has to be."""
    return field(default=default, metadata={"meaning": meaning, "check": check})


SECONDS, SIZE, COUNT = above_zero(DAY), within(0, LARGEST), within(1, 1_000_000)
ORIGINS = "origins such as https://example.org"


@dataclass(frozen=True)
class Settings:
    """How the service is run. Times are in seconds, sizes in bytes, lists are separated by commas."""

    workers: int = field(
        default_factory=lambda: max(2, os.cpu_count() or 2),
        metadata={"meaning": "worker processes; else one for each processor", "check": within(1, 1024)},
    )
    queue_length: int = setting(1024, "jobs that may wait before others are refused", COUNT)
    queue_patience: float = setting(15.0, "seconds after which a job that waits is refused", SECONDS)
    start_timeout: float = setting(60.0, "seconds within which a worker must be up", SECONDS)
    derivation_deadline: float = setting(
        5.0, "seconds of a processor for a derivation; by the clock twice that", SECONDS
    )
    simulation_deadline: float = setting(
        20.0, "seconds of a processor for a simulation; by the clock twice that", SECONDS
    )
    experiment_deadline: float = setting(180.0, "seconds for an experiment", SECONDS)
    experiment_workers: int = setting(
        1, "experiments at a time; they measure times, so they want a quiet machine", within(1, 1024)
    )
    experiment_queue: int = setting(128, "experiments that may wait; one client gets half of the places", COUNT)
    experiment_patience: float = setting(1800.0, "seconds after which an experiment that waits is refused", SECONDS)
    worker_memory: int = setting(
        2048 * MEBIBYTE, "bytes of address space of a worker", within(1024 * MEBIBYTE, LARGEST, "the libraries need it")
    )
    jobs_per_worker: int = setting(1000, "jobs after which a worker is replaced", COUNT)
    cache_size: int = setting(128 * MEBIBYTE, "bytes of answers kept in memory", SIZE)
    cache_folder: str = setting("", "folder of answers that outlive the service; else they are in memory only", folder)
    cache_folder_size: int = setting(1024 * MEBIBYTE, "bytes of answers kept in that folder", SIZE)
    redis: str = setting(
        "", "address of a Redis that replicas share, such as redis://host:6379/0", address("redis", "rediss", "unix")
    )
    scheduler: str = setting(
        "",
        "address of a Dask that works out maps, such as tcp://host:8786",
        address("tcp", "tls", "ws", "wss", "ucx", "inproc"),
    )  # read by deltaq.lab
    client_share: float = setting(
        0.5, "part of the processors that one client gets for long; 0: all; on loopback too", within(0, 1)
    )
    client_credit: float = setting(120.0, "seconds of processor time that one client gets beyond that", within(0, DAY))
    largest_body: int = setting(MEBIBYTE, "bytes of a request's body", within(1024, 1024 * MEBIBYTE))
    body_timeout: float = setting(10.0, "seconds within which a body must be complete", SECONDS)
    head_timeout: float = setting(10.0, "seconds within which the head of a request must be complete", SECONDS)
    reading_timeout: float = setting(10.0, "seconds within which a client must have read some of its answer", SECONDS)
    drain_timeout: int = setting(8, "seconds that requests under way get when the service ends", SECONDS)
    trusted_proxies: tuple[str, ...] = setting(
        ("127.0.0.1", "::1"),
        "proxies whose X-Forwarded-For is believed",
        each(is_proxy, "addresses or networks of proxies such as 10.0.0.5"),
    )
    allowed_hosts: tuple[str, ...] = setting(
        (),
        "names under which it answers; else all, on loopback its own",
        each(is_host, "names without a port such as deltaq.example.org"),
    )
    frame_ancestors: tuple[str, ...] = setting(
        (), "origins whose pages may show it in a frame, such as a course's", each(is_framing, ORIGINS)
    )
    cors_origins: tuple[str, ...] = setting(
        (), "origins whose pages may call the API; * for all", each(is_calling, ORIGINS)
    )
    log_level: str = setting(
        "warning", f"what is logged: {', '.join(LOG_LEVELS)} (info: each request)", one_of(*LOG_LEVELS)
    )
    static: str = setting("", "folder of the page's files", folder_there)

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] | None = None) -> Settings:
        """The defaults, changed by the variables that are set."""
        given = os.environ if environment is None else environment
        variables = {variable_of(f): f for f in fields(cls)}
        if unknown := [name for name in given if name.startswith(PREFIX) and name not in variables]:
            raise SettingsError(f"unknown settings: {', '.join(sorted(unknown))}; known are {', '.join(variables)}")
        return cls(**{f.name: _read(name, str(f.type), given[name]) for name, f in variables.items() if name in given})

    def __post_init__(self) -> None:
        for f in fields(self):
            if wrong := f.metadata["check"](getattr(self, f.name)):
                raise SettingsError(f"{variable_of(f)} {wrong}")

    def missing_package(self) -> str:
        """A sentence on the first setting that needs a package which is not installed; "" where all are."""
        for name, (package, extra) in EXTRAS.items():
            if getattr(self, name) and find_spec(package) is None:
                return f"{PREFIX}{name.upper()} needs the package {package}: pip install 'deltaq[{extra}]'"
        return ""


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
    if kind in _WRITTEN and not _WRITTEN[kind].fullmatch(text.strip()):
        raise SettingsError(f"{variable} must be a {'whole ' if kind == 'int' else ''}number, not {text!r}")
    readers: dict[str, Callable[[str], Any]] = {"int": int, "float": float, "str": str, "tuple[str, ...]": _parts}
    return readers[kind](text)
