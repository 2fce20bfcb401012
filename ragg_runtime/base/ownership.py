"""Does a file belong to its user?"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterator


def belongs_to_user(status: os.stat_result) -> bool:
    """Whether only this user (or the administrator) can have written what has this status."""
    return not list(_doubts(status))


def _doubts(status: os.stat_result) -> Iterator[str]:
    if sys.platform == "win32":  # owners and modes mean something else there
        return
    if status.st_uid not in (os.geteuid(), 0):
        yield f"belongs to another user (uid {status.st_uid})"
    if status.st_mode & stat.S_IWOTH:
        yield "can be written by everybody"
    elif status.st_mode & stat.S_IWGRP and not _is_private(status.st_gid):
        yield "can be written by a group of users"


def _is_private(gid: int) -> bool:
    """Whether a group is the user's own: many systems give each user one, and files of its members."""
    if sys.platform == "win32":
        return True
    import grp
    import pwd

    try:
        user, group = pwd.getpwuid(os.geteuid()), grp.getgrgid(gid)
    except KeyError:
        return gid == os.getegid() == os.geteuid()
    return gid == user.pw_gid and not [m for m in group.gr_mem if m != user.pw_name]
