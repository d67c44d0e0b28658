"""The folder of an OpenFOAM case on one mesh: its parts (one a rank), its complete times, its fields on the whole grid.

A serial case has its fields in the folder itself, a parallel one in processor0, processor1, ... A time counts as complete
when every part has marked it so.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np

from .blocks import Block, divide
from .errors import Refused
from .foam_files import read_field
from .grid import Grid


class CaseFolder:
    """`path` of the case, its `grid`, and the `counts` of blocks along x, y, z that it is divided into."""

    def __init__(self, path: Path, grid: Grid, counts: tuple[int, int, int]):
        self.path, self.grid, self.counts = path, grid, counts

    @classmethod
    def load(cls, path: Path) -> CaseFolder:
        """The case that `save` described.

        Errors: Refused if there is none.
        """
        try:
            data = json.loads((path/"grid.json").read_text())
            lines = [np.array(data[name]) for name in "xyz"]
            return cls(path, Grid(*lines, data["planar"]), tuple(data["blocks"]))
        except (OSError, ValueError, KeyError):
            raise Refused(f"{path}: is no case of this solver; run without --resume") from None

    def save(self) -> None:
        """Write down grid lines and blocks, so that a run goes on with exactly these."""
        data = {name: getattr(self.grid, name).tolist() for name in "xyz"}
        (self.path/"grid.json").write_text(json.dumps(data | {"planar": self.grid.planar, "blocks": self.counts}))

    @property
    def ranks(self) -> int:
        return int(np.prod(self.counts))

    def parts(self) -> list[tuple[Path, Grid]]:
        """Folder and grid of each rank."""
        if self.ranks == 1:
            return [(self.path, self.grid)]
        return [(self.path/f"processor{block.rank}", block) for block in divide(self.grid, self.counts)]

    def part(self, values: np.ndarray, grid: Grid) -> np.ndarray:
        """What a rank's grid has of cell values (N, ...) on the whole grid."""
        return grid.part(values, self.grid) if isinstance(grid, Block) else values

    def read(self, time: str, name: str) -> np.ndarray:
        """A cell field of a written time on the whole grid: (N,) or (N, 3).

        Errors: Refused if a file is cut short or no field.
        """
        if self.ranks == 1:
            return read_field(self.path/time/name, self.grid.cell_count)
        whole = None
        for folder, block in self.parts():
            values = read_field(folder/time/name, block.cell_count)
            if whole is None:
                whole = np.empty(self.grid.shape[::-1] + values.shape[1:])
            whole[block.place] = values.reshape(block.shape[::-1] + values.shape[1:])
        return whole.reshape((-1,) + whole.shape[3:])

    def complete_times(self) -> list[tuple[float, str]]:
        """Times [s] that all parts have marked complete, with their names, earliest first."""
        marked = [{name for name in _times(folder) if (folder/name/"complete").is_file()} for folder, _ in self.parts()]
        return sorted((float(name), name) for name in set.intersection(*marked))

    def newest(self) -> tuple[float, str]:
        """The newest complete time; half-written ones are removed.

        Errors: Refused if there is none, or it is damaged (naming the file).
        """
        complete = self.complete_times()
        if not complete:
            raise Refused(f"{self.path}: there is no checkpoint to go on from; run without --resume")
        time, name = complete[-1]
        names = {name for _, name in complete}
        for folder, _ in self.parts():
            _check(folder/name)
            for other in set(_times(folder)) - names:
                shutil.rmtree(folder/other)
        return time, name

    def thin_out(self, seen: list[tuple[float, str]], keep: int = 2) -> None:
        """Remove all but the newest `keep` of the complete times that the caller has seen to, earliest first.

        The solver goes on meanwhile: what it has completed since then is not yet converted.
        """
        for _, name in seen[:-keep]:
            for folder, _ in self.parts():
                shutil.rmtree(folder/name)


def mark_complete(folder: Path) -> None:
    """Mark a time folder complete, as the solver does: the size and name of every file."""
    lines = [f"{path.stat().st_size} {path.relative_to(folder)}\n" for path in sorted(folder.rglob("*"))
             if path.is_file() and path.name not in ("complete", "complete.part")]
    (folder/"complete.part").write_text("".join(lines))
    (folder/"complete.part").replace(folder/"complete")


def _times(folder: Path) -> list[str]:
    """Names of the time folders."""
    found = []
    for path in folder.iterdir() if folder.is_dir() else ():
        try:
            float(path.name)
        except ValueError:
            continue
        if path.is_dir():
            found.append(path.name)
    return found


def _check(folder: Path) -> None:
    """Refuse a checkpoint whose files are not those that its mark lists."""
    for line in (folder/"complete").read_text().splitlines():
        size, _, name = line.partition(" ")
        path = folder/name
        if not path.is_file() or path.stat().st_size != int(size):
            raise Refused(f"{path}: the checkpoint is truncated or damaged; delete {folder} to go on from the one before")
