"""Interfaces and regions on the resampled grid, finer than its nodes by linear interpolation along grid lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import label, sum_labels

from .fields import Resampled

SURFACE_DENSITY = 0.5 - 1e-6   # one half, less what rounding may take from a node that lies on a face


@dataclass(frozen=True)
class Interface:
    """Points (n, d) m where grid lines cross the surface of a region, and weights (n) that make them count per area.

    A family of parallel lines meets a surface with density |n_axis|, so weights |n_axis| add up to n . n = 1.
    """

    points: np.ndarray
    weights: np.ndarray


def regions(inside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Face-connected regions of a mask: numbers 1.. on the grid (0 outside), and the node count of each."""
    numbers, count = label(inside)
    return numbers, sum_labels(inside, numbers, np.arange(1, count + 1))


def largest_region(inside: np.ndarray) -> tuple[np.ndarray, float]:
    """Mask of the largest face-connected region and its share of all nodes inside (0 where there are none)."""
    numbers, sizes = regions(inside)
    if len(sizes) == 0:
        return np.zeros_like(inside), 0.0
    return numbers == 1 + int(np.argmax(sizes)), float(sizes.max() / sizes.sum())


def crossing_fractions(resampled: Resampled, axis: int, step: int, inside: np.ndarray,
                       values: np.ndarray | None = None, threshold: float = 0.0) -> np.ndarray:
    """Where the region ends between a node inside and its neighbour outside, as a share 0..1 of the grid spacing.

    axis, step: grid axis and direction +1 or -1; nan where the neighbour is inside too, 0 where the grid ends.
    The region is {density >= 1/2 and values >= threshold}; along the line both are linear, the nearer end counts.
    """
    result = np.full(inside.shape, np.nan)
    here, there = [slice(None)] * inside.ndim, [slice(None)] * inside.ndim
    here[axis], there[axis] = (slice(None, -1), slice(1, None)) if step > 0 else (slice(1, None), slice(None, -1))
    here, there = tuple(here), tuple(there)
    leaves = inside[here] & ~inside[there]
    share = np.ones(leaves.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        fall = (resampled.density[here] - SURFACE_DENSITY) / (resampled.density[here] - resampled.density[there])
        share = np.where(resampled.density[there] < SURFACE_DENSITY, np.minimum(share, fall), share)
        if values is not None:
            fall = (values[here] - threshold) / (values[here] - values[there])
            share = np.where(values[there] < threshold, np.minimum(share, fall), share)
    result[here] = np.where(leaves, share, np.nan)
    border = _border(axis, step, inside.ndim)
    result[border] = np.where(inside[border], 0.0, np.nan)
    return result


def _border(axis: int, step: int, dimensions: int) -> tuple:
    """Index of the last nodes of the grid in a direction."""
    return tuple(slice(None) if k != axis else (-1 if step > 0 else 0) for k in range(dimensions))


def ends(resampled: Resampled, axis: int, step: int, inside: np.ndarray,
         values: np.ndarray | None = None, threshold: float = 0.0) -> np.ndarray:
    """Coordinates (m) along `axis` of the region's ends at nodes that have one in direction `step`, nan elsewhere."""
    share = crossing_fractions(resampled, axis, step, inside, values, threshold)
    coordinates = resampled.coordinates(axis).reshape([-1 if k == axis else 1 for k in range(inside.ndim)])
    return coordinates + step * share * resampled.grid_spacing


def box(resampled: Resampled, inside: np.ndarray, values: np.ndarray | None = None,
        threshold: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper corner (d) m of the box around a region that is not empty."""
    corners = []
    for step, extreme in ((-1, np.nanmin), (+1, np.nanmax)):
        corners.append(np.array([extreme(ends(resampled, axis, step, inside, values, threshold))
                                 for axis in range(inside.ndim)]))
    return corners[0], corners[1]


def interface(resampled: Resampled, inside: np.ndarray) -> Interface:
    """All crossings of grid lines with the surface density = 1/2 of a region made by that density."""
    steps = np.stack(np.gradient(resampled.density), axis=-1)
    normal = np.abs(steps) / np.maximum(np.linalg.norm(steps, axis=-1, keepdims=True), 1e-30)
    points, weights = [], []
    for axis in range(inside.ndim):
        for step in (-1, +1):
            share = crossing_fractions(resampled, axis, step, inside)
            share[_border(axis, step, inside.ndim)] = np.nan   # where the grid ends there is no interface
            nodes = np.argwhere(np.isfinite(share))
            place = nodes.astype(float)
            place[:, axis] += step * share[tuple(nodes.T)]
            points.append(resampled.origin + place * resampled.grid_spacing)
            weights.append(normal[tuple(nodes.T)][:, axis])
    return Interface(np.concatenate(points), np.concatenate(weights))


def lengths(resampled: Resampled, inside: np.ndarray, axis: int, values: np.ndarray | None = None,
            threshold: float = 0.0) -> np.ndarray:
    """Length (m) of grid lines along `axis` inside a region; the grid's shape without that axis."""
    line = np.moveaxis(inside, axis, 0)
    total = (line[:-1] & line[1:]).sum(axis=0).astype(float)
    for step in (-1, +1):
        total += np.nansum(crossing_fractions(resampled, axis, step, inside, values, threshold), axis=axis)
    return total * resampled.grid_spacing


def cross_section(resampled: Resampled, inside: np.ndarray) -> np.ndarray:
    """Area (3-D, m^2) or width (2-D, m) of a region at each height, (number of planes).

    Lengths along x are exact to linear interpolation; across, rows count by the trapezoidal rule.
    """
    length = lengths(resampled, inside, 0)
    return length if inside.ndim == 2 else np.trapz(length, dx=resampled.grid_spacing, axis=0)
