"""The one kind of error that a user sees: a clear line and an exit status."""

from __future__ import annotations

import errno
import os


class CupelError(Exception):
    """Something that the user can act on.

    `str(error)` is one line that says what, where and what to do; `status` is the exit status of the program.
    """

    def __init__(self, message: str, status: int = 1):
        super().__init__(" ".join(message.split()))
        self.status = status


def describe_system_error(error: OSError, path: os.PathLike | str | None = None) -> CupelError:
    """Turns an `OSError` about `path` into one line in plain words."""
    where = os.fspath(path if path is not None else error.filename or "a file")
    words = {
        errno.ENOSPC: "the disk is full",
        errno.EDQUOT: "the disk quota is used up",
        errno.EROFS: "the file system is read-only",
        errno.EACCES: "permission denied",
        errno.EPERM: "permission denied",
        errno.ENOENT: "no such file or folder",
        errno.ENOTDIR: "a part of the path is not a folder",
    }.get(error.errno or 0, error.strerror or str(error))
    return CupelError(f"cannot use {where}: {words}")
