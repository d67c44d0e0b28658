"""Width, depth and length of the melt pool and height of its bead (physics.md, section 5; NIST's rule).

The pool is the connected region of primary material (density >= 1/2) with T >= T_m that the beam stands on; hot powder
grains that are apart from it do not count. Around it goes a box aligned with the track and with the original plate
surface z = z_plate (top of the solid boxes of the case, 0 if there is none):

    melt_pool_width    greatest less least place across the track
    melt_pool_length   greatest less least place along the track
    melt_pool_depth    z_plate less the lowest place, at least 0
    bead_height        highest place less z_plate, at least 0 (reported apart, not part of the depth)

Sides of the box lie between nodes of the grid, where T by linear interpolation along a grid line falls to T_m, or
where the material ends. No melt: all are 0. A pool cut by a symmetry plane along the track counts with its image.

Which region: of those that come within one spot radius of the beam's axis the one of greatest volume; where there is
none (beam off, or ahead of its melt), the greatest of all.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import generate_binary_structure, label

from ..exact.moving_gaussian_source import MovingGaussianSource
from .elements import Elements
from .fields import REACH, Resampled, active_axes, mirrored, subdivided
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up, primary_material
from .surface import SURFACE_DENSITY, box, regions
from .track import Track

MARGIN = 2.0    # spacings of grid around the hot elements
BLOCK = 2.0     # spacings: blocks by which hot elements are sorted into clusters


@dataclass(frozen=True)
class Pool:
    """Sizes of a molten region, m; all 0 where nothing is molten; `others` counts molten regions apart from it."""

    width: float = 0.0
    depth: float = 0.0
    length: float = 0.0
    height: float = 0.0
    others: int = 0
    tail: float | None = None    # place along the track of the rear end


def plate_surface(case: dict) -> float:
    """Height (m) of the original plate surface: the top of the case's highest solid box, 0 if it has none."""
    tops = [body["upper"][2] for body in case.get("bodies", [])
            if body.get("shape") == "box" and body.get("state") == "solid"]
    return float(max(tops)) if tops else 0.0


def melting_temperature(case: dict) -> float:
    """T_m (K) of the primary material. Errors: MeasureError if it has none."""
    return float(primary_material(case, "melting_temperature")["melting_temperature"])


def hot_cluster(elements: Elements, data: np.ndarray, threshold: float, case: dict,
                reaches) -> tuple[np.ndarray, np.ndarray, int] | None:
    """Lower and upper corner (3) of the wanted cluster of hot elements, and how many other clusters there are.

    Elements of at least half primary material with data >= threshold are sorted into blocks of two spacings; clusters
    are blocks that touch, so whatever is connected on the grid is in one cluster. `reaches` maps positions (n, 3) to
    those that the wanted cluster should have; the largest cluster with one, else the largest, is taken. None: nothing is hot.
    """
    hot = (data >= threshold) & (elements.fraction >= 0.5)
    if not hot.any():
        return None
    axes, size = active_axes(case["dimensions"]), BLOCK * case["spacing"]
    position = elements.position[hot]
    block = np.floor((position[:, axes] - position[:, axes].min(axis=0)) / size).astype(int)
    filled = np.zeros(block.max(axis=0) + 1, dtype=bool)
    filled[tuple(block.T)] = True
    numbers, count = label(filled, structure=generate_binary_structure(len(axes), len(axes)))
    cluster = numbers[tuple(block.T)]
    chosen = _preferred(np.bincount(cluster, elements.volume[hot], count + 1)[1:],
                        np.bincount(cluster, reaches(position), count + 1)[1:] > 0)
    own = position[cluster == chosen]
    return own.min(axis=0), own.max(axis=0), count - 1


def hot_region(resampled: Resampled, values: np.ndarray, threshold: float, reaches) -> tuple[np.ndarray, int]:
    """Mask of the wanted connected region of material with values >= threshold, and how many others there are."""
    with np.errstate(invalid="ignore"):
        molten = (resampled.density >= SURFACE_DENSITY) & (values >= threshold)
    numbers, sizes = regions(molten)
    if len(sizes) == 0:
        return molten, 0
    nodes = np.argwhere(molten)
    place = np.zeros((len(nodes), 3))
    place[:, resampled.axes] = resampled.origin + nodes * resampled.grid_spacing
    reached = np.bincount(numbers[molten], reaches(place), len(sizes) + 1)[1:] > 0
    chosen = _preferred(sizes, reached)
    others = np.count_nonzero(np.delete(sizes, chosen - 1) >= 2**values.ndim)   # nodes in one element; less is no region
    return numbers == chosen, int(others)


def _preferred(sizes: np.ndarray, reached: np.ndarray) -> int:
    """Number (from 1) of the largest region among those reached, or among all if none is."""
    return 1 + int(np.argmax(np.where(reached, sizes, 0.0) if reached.any() else sizes))


def resample_hot(elements: Elements, data_name: str, threshold: float, case: dict, track: Track, reaches):
    """Grid around the wanted hot cluster in the track's frame: (Resampled, values on its nodes, other clusters), or None."""
    framed, spacing = track.frame(elements), case["spacing"]
    found = hot_cluster(framed, getattr(elements, data_name), threshold, case, reaches)
    if found is None:
        return None
    lower, upper, others = found
    axes = list(active_axes(case["dimensions"]))
    lower, upper = lower[axes] - MARGIN * spacing, upper[axes] + MARGIN * spacing
    domain_lower, domain_upper = track.limits(case)
    lower, upper = np.maximum(lower, domain_lower[axes]), np.minimum(upper, domain_upper[axes])
    reach = (REACH + 1.0) * spacing + (0.0 if framed.extent is None else 0.5 * framed.extent[:, axes])
    place = framed.position[:, axes]
    part = elements.take(((place >= lower - reach) & (place <= upper + reach)).all(axis=1))
    part = track.frame(mirrored(subdivided(part, spacing, case["dimensions"]), case))
    anchor = np.array([0.0, 0.0, plate_surface(case)])[axes]
    resampled = Resampled(part, case, lower, upper, anchor)
    return resampled, resampled.values(getattr(part, data_name)), others


def molten_pool(snapshot: Snapshot) -> Pool:
    """The melt pool of a snapshot."""
    case, elements = snapshot.case, snapshot.elements
    track, threshold, plate = Track.of_case(case), melting_temperature(case), plate_surface(case)
    beam = track.along(elements.time)
    radius = max(track.spot_radius, case["spacing"])

    def reaches(position: np.ndarray) -> np.ndarray:
        return (position[:, 0] - beam)**2 + position[:, 1]**2 <= radius**2

    found = resample_hot(elements, "temperature", threshold, case, track, reaches)
    if found is None:
        return Pool()
    resampled, values, others = found
    region, apart = hot_region(resampled, values, threshold, reaches)
    if not region.any():
        return Pool(others=others)
    lower, upper = box(resampled, region, values, threshold)
    width = across(lower, upper, case, track) if case["dimensions"] == 3 else 0.0
    return Pool(width, max(plate - float(lower[-1]), 0.0), float(upper[0] - lower[0]),
                max(float(upper[-1]) - plate, 0.0), others + apart, float(lower[0]))


def across(lower: np.ndarray, upper: np.ndarray, case: dict, track: Track) -> float:
    """Width (m) of a box in the track's frame; doubled about a symmetry plane along the track that it touches."""
    low, high = float(lower[1]), float(upper[1])
    for side, corner in (("y_min", "lower"), ("y_max", "upper")):
        boundary = case["domain"]["boundaries"].get(side) or {}
        plane = track.across_of(case["domain"][corner][1])
        if boundary.get("kind") != "symmetry" or plane is None:
            continue
        if min(abs(low - plane), abs(high - plane)) < case["spacing"] or low < plane < high:
            inner = corner == "lower"   # the material lies on the greater y of a lower plane
            far = high if inner == (track.direction[0] > 0.0) else low
            return 2.0 * abs(far - plane)
    return high - low


def _reading(snapshot: Snapshot, value_of) -> Reading:
    pool: Pool = snapshot.once(molten_pool)
    note = f"{pool.others} molten regions apart from the pool left out" if pool.others else ""
    return Reading(value_of(pool), note=note)


def exact_pool(case: dict) -> tuple[float, float, float]:
    """Width, depth, length (m) of the moving Gaussian source, where that is what the case computes.

    Errors: MeasureError if the case has more physics than heat and a laser, or a plate of changing properties.
    """
    if not set(case["physics"]) <= {"heat", "laser"}:
        raise MeasureError("resolved case: an exact melt pool is known only with physics heat and laser alone; "
                           "name another reference")
    material, laser = primary_material(case, "density", "specific_heat", "conductivity"), case["laser"]
    for key in ("density", "specific_heat", "conductivity"):
        if material.get(f"{key}_solid", material[key]) != material[key]:
            raise MeasureError(f"resolved case: an exact melt pool needs {key}_solid equal to {key}")
    source = MovingGaussianSource(laser["power"] * laser["absorptivity"], laser["speed"], laser["spot_radius"],
                                  material["density"], material["specific_heat"], material["conductivity"],
                                  look_up(case, "initial", "temperature"))
    return source.pool(melting_temperature(case))


@measure_of_snapshot("melt_pool_width", unit="m", needs=("temperature",), exact=lambda case: exact_pool(case)[0])
def melt_pool_width(snapshot: Snapshot) -> Reading:
    if snapshot.case["dimensions"] == 2:
        return Reading(None, note="a two-dimensional scene has no width across the track")
    return _reading(snapshot, lambda pool: pool.width)


@measure_of_snapshot("melt_pool_depth", unit="m", needs=("temperature",), exact=lambda case: exact_pool(case)[1])
def melt_pool_depth(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda pool: pool.depth)


@measure_of_snapshot("melt_pool_length", unit="m", needs=("temperature",), exact=lambda case: exact_pool(case)[2])
def melt_pool_length(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda pool: pool.length)


@measure_of_snapshot("bead_height", unit="m", needs=("temperature",))
def bead_height(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda pool: pool.height)
