"""The meshes of a run, one after the other, in folders mesh_0000, mesh_0001, ... of which the newest counts.

Most runs have one. With a beam the mesh follows it (moving_mesh.py): a new one is made beside the old from its checkpoint,
renamed when it is whole, and the old one removed. A kill in between leaves one of the two.
"""

from __future__ import annotations

import re
import shutil
import time
from pathlib import Path

import numpy as np

from . import case_writer, moving_mesh, remap
from .case_folder import CaseFolder
from .blocks import block_counts
from .errors import Refused
from .grid import make_grid
from .resolved_case import ResolvedCase
from .volume_fractions import top_of_bodies, volume_fractions


class MeshSequence:
    """Meshes of `case` in `folder`, each divided among at most `ranks` ranks."""

    def __init__(self, case: ResolvedCase, folder: Path, ranks: int):
        self.case, self.folder, self.ranks = case, folder, ranks
        self.moves = moving_mesh.is_wanted(case)

    def check(self) -> None:
        """Errors: Refused for bodies that cannot be read."""
        self.top = top_of_bodies(self.case)

    def first(self) -> CaseFolder:
        """Write the first mesh and the start fields.

        Errors: OSError if the folder cannot be written.
        """
        self.check()
        path = self.folder/"mesh_0000"
        if not self.moves:
            return case_writer.write_case(self.case, path, self.ranks, make_grid(self.case, self.top))
        base = moving_mesh.base_grid(self.case)
        pattern = volume_fractions(self.case, base)
        np.save(self.folder/"start_fraction.npy", pattern)
        window = moving_mesh.place_window(self.case, self.top, 0.0, None)
        grid = moving_mesh.window_grid(base, window)
        overlap = remap.Overlap(base, grid, grid)
        fraction = overlap.gather(overlap.base_volume*pattern.reshape(base.shape[::-1])).ravel()/grid.cell_volumes()
        fraction[np.abs(fraction - 1) < 1e-12] = 1          # the round-off of the sum
        return case_writer.write_case(self.case, path, self.ranks, grid, fraction, window)

    def newest(self) -> CaseFolder:
        """The mesh that a run has come to.

        Errors: Refused if there is none.
        """
        found = sorted(path for path in self.folder.glob("mesh_*") if path.name[5:].isdigit())
        if not found:
            raise Refused(f"{self.folder}: there is no checkpoint to go on from; run without --resume")
        self.check()
        return CaseFolder.load(found[-1])

    def following(self, written: CaseFolder) -> CaseFolder:
        """The mesh for the newest checkpoint of `written`: another one if that checkpoint asks for it, else the same."""
        complete = written.complete_times()
        if not complete:
            return written                                  # the start, before the solver has marked it
        now, name = complete[-1]
        (first, _), *_ = written.parts()
        if not (first/name/"primary_enthalpy").is_file():
            return written
        started, cpu = time.monotonic(), time.process_time()
        base = moving_mesh.base_grid(self.case)
        window = moving_mesh.place_window(self.case, self.top, now, moving_mesh.melt_box(self.case, written, name))
        grid = moving_mesh.window_grid(base, window)
        final = self.folder/f"mesh_{int(written.path.name[5:]) + 1:04d}"
        part = final.with_suffix(".part")
        shutil.rmtree(part, ignore_errors=True)
        target = CaseFolder(part, grid, block_counts(self.case, grid, self.ranks))
        case_writer.write_frame(self.case, target, window)
        pattern = np.load(self.folder/"start_fraction.npy")
        remap.remap(self.case, base, pattern, written, name, target)
        for folder, _ in target.parts():
            _add_cost(folder/name, time.monotonic() - started, time.process_time() - cpu)
        part.rename(final)
        shutil.rmtree(written.path)
        return CaseFolder(final, grid, target.counts)


def _add_cost(folder: Path, wall: float, cpu: float) -> None:
    """Add the seconds that a new mesh took to those of the run, and mark the folder anew."""
    state = folder/"uniform"/"cupelState"
    text = state.read_text()
    for name, seconds in (("wall_seconds", wall), ("cpu_seconds", cpu)):
        text = re.sub(rf"\b{name}\s+([^;]+);", lambda found: f"{name} {float(found.group(1)) + seconds!r};", text)
    state.write_text(text)
    remap.mark_complete(folder)
