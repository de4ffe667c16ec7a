"""Files and folders that nobody but this user and root can have written.

A place is trusted if it is a regular file or a folder, owned by this user or by root, and writable by no one else; and
if every folder that leads to it is, for whoever may write a folder can put something else in place of what it holds. A
folder on the way may also be writable by all if it is sticky, as /tmp is: there only the owner of an entry can replace
it. Folders above the user's home are not examined.
A group without other members is no one else: many systems give each user one (umask 002).
What is not trusted is not used; the log says so once for each place.
Source: OpenSSH, safe_path (StrictModes), and Debian's user-group-modes, for the keys of a user.
"""

from __future__ import annotations

import grp
import logging
import os
import pwd
import stat
from functools import lru_cache
from pathlib import Path

LOGGER = logging.getLogger("deltaq.ownership")


class UntrustedFileError(OSError):
    """Somebody else may have written it, or may put something else in its place."""


def require_trusted(place: Path | str) -> None:
    """Raises UntrustedFileError if others may have written a place or replaced it, FileNotFoundError if it is missing.

    What exists of the way to a missing place is examined all the same. A link is not trusted.
    """
    for folder in _way_to(Path(place)):
        state = folder.stat()
        if not (is_trusted(state) or _is_sticky(state)):
            raise _untrusted(f"{place}, for {folder} is not this user's alone")
    require_trusted_state(os.lstat(place), str(place))


def require_trusted_state(state: os.stat_result, place: str) -> None:
    """Raises UntrustedFileError if others may have written what has this state, of an open file for instance."""
    if not is_trusted(state):
        raise _untrusted(place)


def is_trusted(state: os.stat_result) -> bool:
    """Whether it is a regular file or a folder of this user or root that nobody else may write."""
    writable = bool(state.st_mode & stat.S_IWOTH) or (
        bool(state.st_mode & stat.S_IWGRP) and not _is_private(state.st_gid, state.st_uid)
    )
    known = stat.S_ISREG(state.st_mode) or stat.S_ISDIR(state.st_mode)
    return known and _is_own(state) and not writable


def _is_own(state: os.stat_result) -> bool:
    return state.st_uid in {0, os.geteuid()}


def _is_sticky(state: os.stat_result) -> bool:
    """Whether all may write a folder, but replace in it only what is their own (unlink(2), EPERM)."""
    return stat.S_ISDIR(state.st_mode) and bool(state.st_mode & stat.S_ISVTX) and _is_own(state)


def _way_to(place: Path) -> list[Path]:
    """The folders that lead to a place, from the root down: by its name, and by where links on the way lead.

    Folders above the user's home are left out where the way leads through it.
    """
    named = place.absolute()
    real = named.parent.resolve()
    way = dict.fromkeys((*reversed(named.parents), *reversed(real.parents), real))
    home = _home(os.geteuid())
    above = set(home.parents) if home in way else set()
    return [folder for folder in way if folder not in above]


@lru_cache(maxsize=4)
def _home(user: int) -> Path:
    """The home folder of a user by the password database; the root of the file system for one that is not in it."""
    try:
        return Path(pwd.getpwuid(user).pw_dir or "/").resolve()
    except KeyError:
        return Path("/")


@lru_cache(maxsize=64)
def _is_private(group: int, user: int) -> bool:
    """Whether a group is the user's alone: it has his name, and no other members."""
    try:
        found, owner = grp.getgrgid(group), pwd.getpwuid(user)
    except KeyError:
        return False
    return found.gr_name == owner.pw_name and set(found.gr_mem) <= {owner.pw_name}


def _untrusted(place: str) -> UntrustedFileError:
    _warn(place)
    return UntrustedFileError(f"others may have written {place}")


@lru_cache(maxsize=256)
def _warn(place: str) -> None:
    """Said once: it is no failure, but what is kept there is made anew."""
    LOGGER.warning("others may have written %s: it is not used", place)
