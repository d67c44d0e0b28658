"""Checkpoints: complete time folders of the OpenFOAM case, found, checked and thinned out."""

from __future__ import annotations

import shutil
from pathlib import Path

from .errors import Refused


def time_folders(case_folder: Path) -> list[tuple[float, Path]]:
    """All time folders with their times [s], earliest first."""
    found = []
    for path in case_folder.iterdir() if case_folder.is_dir() else ():
        try:
            found.append((float(path.name), path))
        except ValueError:
            continue
    return sorted(found)


def complete_folders(case_folder: Path) -> list[tuple[float, Path]]:
    """Time folders that the solver has marked complete."""
    return [(time, path) for time, path in time_folders(case_folder) if (path/"complete").is_file()]


def check(folder: Path) -> None:
    """Refuse a checkpoint whose files are not those that its mark lists.

    Errors: Refused, naming the file.
    """
    for line in (folder/"complete").read_text().splitlines():
        size, _, name = line.partition(" ")
        path = folder/name
        if not path.is_file() or path.stat().st_size != int(size):
            raise Refused(f"{path}: the checkpoint is truncated or damaged; delete {folder} to go on from the one before")


def newest(case_folder: Path) -> tuple[float, Path]:
    """The newest complete checkpoint; half-written ones after it are removed.

    Errors: Refused if there is none or it is damaged.
    """
    complete = complete_folders(case_folder)
    if not complete:
        raise Refused(f"{case_folder}: there is no checkpoint to go on from; run without --resume")
    time, folder = complete[-1]
    check(folder)
    for _, path in time_folders(case_folder):
        if not (path/"complete").is_file():
            shutil.rmtree(path)
    return time, folder


def thin_out(case_folder: Path, keep: int = 2) -> None:
    """Remove complete time folders but the newest `keep`."""
    for _, path in complete_folders(case_folder)[:-keep]:
        shutil.rmtree(path)
