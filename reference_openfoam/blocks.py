"""A grid divided among the ranks of a parallel run: blocks of whole columns along z, as the laser source needs.

A scene in the plane is divided along x and z. Axes with periodic sides are left whole.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from .grid import Grid
from .resolved_case import ResolvedCase

FEWEST_CELLS = 1000             # of a rank: with less, ranks wait for each other more than they compute


@dataclass(frozen=True)
class Block(Grid):
    """The part of a grid that one rank has: cells from index `first` (i, j, k) on; `neighbours` are (side, rank)."""

    rank: int
    first: tuple[int, int, int]
    neighbours: tuple[tuple[str, int], ...]

    def is_outer(self, side: str) -> bool:
        return side not in {name for name, _ in self.neighbours}

    @property
    def place(self) -> tuple[slice, slice, slice]:
        """Where the block's cells lie in an array (nz, ny, nx, ...) over the whole grid."""
        return tuple(slice(start, start + count) for start, count in zip(self.first[::-1], self.shape[::-1]))

    def part(self, values: np.ndarray, whole: Grid) -> np.ndarray:
        """The block's cells (n, ...) of values (N, ...) on the whole grid."""
        return values.reshape(whole.shape[::-1] + values.shape[1:])[self.place].reshape((-1,) + values.shape[1:])


def block_counts(case: ResolvedCase, grid: Grid, ranks: int) -> tuple[int, int, int]:
    """Blocks along x, y, z for at most `ranks` ranks: as many as there is work and room for, with the smallest cuts."""
    ranks = max(1, min(ranks, grid.cell_count//FEWEST_CELLS))
    nx, ny, nz = grid.shape
    other = 2 if case.is_planar else 1
    free = [case.boundaries["xyz"[axis] + "_min"]["kind"] != "periodic" for axis in (0, other)]
    for wanted in range(ranks, 1, -1):
        choices = []
        for along in (count for count in range(1, wanted + 1) if wanted % count == 0):
            counts = (along, wanted//along)
            if all(count == 1 or (may and count <= grid.shape[axis]//2) for count, may, axis in zip(counts, free, (0, other))):
                cut = (counts[0] - 1)*ny*nz + (counts[1] - 1)*nx*(ny if case.is_planar else nz)
                choices.append((cut, counts))
        if choices:
            along, across = min(choices)[1]
            return (along, 1, across) if case.is_planar else (along, across, 1)
    return (1, 1, 1)


def divide(grid: Grid, counts: tuple[int, int, int]) -> list[Block]:
    """The blocks of a grid, in the order of ranks (x fastest)."""
    cuts = [np.rint(np.linspace(0, cells, count + 1)).astype(int) for cells, count in zip(grid.shape, counts)]
    blocks = []
    for index in product(*(range(count) for count in counts[::-1])):
        index = index[::-1]
        neighbours = []
        for axis, name in enumerate("xyz"):
            stride = int(np.prod(counts[:axis]))
            if index[axis] > 0:
                neighbours.append((name + "_min", len(blocks) - stride))
            if index[axis] < counts[axis] - 1:
                neighbours.append((name + "_max", len(blocks) + stride))
        lines = [line[cut[i]:cut[i + 1] + 1] for line, cut, i in zip((grid.x, grid.y, grid.z), cuts, index)]
        blocks.append(Block(*lines, grid.planar, len(blocks), tuple(int(cut[i]) for cut, i in zip(cuts, index)), tuple(neighbours)))
    return blocks
