"""What nobody else can have written: files and folders that are this user's or root's, and no one else's to write.

A group that has no other member is no one else: many systems give each user one (umask 002). What others may have
written is not believed; that is said once for each place.
Source: OpenSSH, auth_secure_path and Debian's user-group-modes, for the keys of a user.
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
    """Somebody else may have written it."""


def require_trusted(place: Path | str) -> None:
    """Raises NotOursError if others may have written a file or folder, FileNotFoundError if it is not there."""
    require_trusted_state(os.lstat(place), str(place))


def require_trusted_state(state: os.stat_result, place: str) -> None:
    """The same of what is open, or has been looked at."""
    if not is_trusted(state):
        _warn(place)
        raise UntrustedFileError(f"others may have written {place}")


def is_trusted(state: os.stat_result) -> bool:
    """Whether it is this user's or root's, a file or folder, and for nobody else to write."""
    writable = bool(state.st_mode & stat.S_IWOTH) or (
        bool(state.st_mode & stat.S_IWGRP) and not _is_private(state.st_gid, state.st_uid)
    )
    known = stat.S_ISREG(state.st_mode) or stat.S_ISDIR(state.st_mode)
    return known and state.st_uid in {0, os.geteuid()} and not writable


@lru_cache(maxsize=64)
def _is_private(group: int, user: int) -> bool:
    """Whether a group is the user's alone: it has his name, and no other members."""
    try:
        found, owner = grp.getgrgid(group), pwd.getpwuid(user)
    except KeyError:
        return False
    return found.gr_name == owner.pw_name and set(found.gr_mem) <= {owner.pw_name}


@lru_cache(maxsize=256)
def _warn(place: str) -> None:
    """Said once: it is no failure, but what is kept there is made anew."""
    LOGGER.warning("others may have written %s: it is not used", place)
