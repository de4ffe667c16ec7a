"""What the value of a setting may be: a check says in half a sentence what is needed instead, "" of what is sound."""

from __future__ import annotations

import re
from collections.abc import Callable
from ipaddress import ip_address, ip_network
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

Check = Callable[[Any], str]

_NAME = re.compile(r"([a-z0-9_]([a-z0-9_-]{0,61}[a-z0-9_])?\.)*[a-z0-9_]([a-z0-9_-]{0,61}[a-z0-9_])?\.?", re.IGNORECASE)
_ORIGIN = re.compile(r"https?://(?P<host>[^/:@?#\s;,'\"\[\]]+|\[[0-9a-fA-F:.]+\])(:(?P<port>[0-9]{1,5}))?")


def within(least: float, most: float, why: str = "") -> Check:
    """A number in a range; NaN is in none."""

    def check(value: float) -> str:
        if value >= least:
            return "" if value <= most else f"must be at most {most}, not {value}"
        return f"must be at least {least}{why and ': ' + why}"

    return check


def above_zero(most: float) -> Check:
    """A positive number; NaN is none."""

    def check(value: float) -> str:
        if value > 0:
            return "" if value <= most else f"must be at most {most}, not {value}"
        return "must be above 0"

    return check


def one_of(*names: str) -> Check:
    """One of these words."""
    return lambda value: "" if value in names else f"must be one of {', '.join(names)}, not {value!r}"


def each(check: Callable[[str], bool], needed: str) -> Check:
    """A list whose members are all what is needed."""
    return lambda values: next((f"needs {needed}, not {one!r}" for one in values if not check(one)), "")


def address(*schemes: str) -> Check:
    """An address with one of these schemes; none at all is sound."""

    def check(value: str) -> str:
        return "" if not value or _is_address(value, schemes) else f"needs an address such as {schemes[0]}://host:6379"

    return check


def folder(value: str) -> str:
    """A folder, or the name of one that can be made where there is none yet."""
    place = Path(value).expanduser()
    return "" if not value or place.is_dir() or not _is_there(place) else f"must be a folder, and {value!r} is none"


def folder_there(value: str) -> str:
    """A folder that is there."""
    return "" if not value or Path(value).is_dir() else f"must be a folder that is there, not {value!r}"


def is_host(name: str) -> bool:
    """A name or an address without a port; `*.` before a name stands for any below it."""
    try:
        return bool(ip_address(name))
    except ValueError:
        return len(name) <= 255 and bool(_NAME.fullmatch(name.removeprefix("*.")))


def is_origin(text: str) -> bool:
    """Scheme, host and perhaps a port."""
    found = _ORIGIN.fullmatch(text)
    if not found or not 1 <= int(found["port"] or 1) <= 65535:
        return False
    return is_host(found["host"].strip("[]"))


def is_framing(text: str) -> bool:
    """An origin whose host may begin with `*.`, or * for every one."""
    return text == "*" or is_origin(text)


def is_calling(text: str) -> bool:
    """An origin as browsers tell it, or * for every one."""
    return text == "*" or (is_origin(text) and "*" not in text)


def is_proxy(text: str) -> bool:
    """The address of a proxy, or a network that is not the whole world, without bits beyond its mask."""
    try:
        return ip_network(text).prefixlen > 0
    except ValueError:
        return False


def _is_address(text: str, schemes: tuple[str, ...]) -> bool:
    try:
        parts = urlsplit(text)
        place = parts.path if parts.scheme == "unix" else parts.hostname and parts.port != 0
    except ValueError:  # a port that is none, brackets that do not match
        return False
    return parts.scheme in schemes and bool(place) and not re.search(r"\s", text)


def _is_there(place: Path) -> bool:
    try:
        place.lstat()
    except FileNotFoundError:
        return False
    except OSError:  # below a file, or a name too long
        return True
    return True
