"""Cross-section of the fused track: material that was ever above T_m, in the quasi-steady part of the track.

In the last snapshot of `between`, the connected region with peak temperature >= T_m that lies under the beam's path is
cut by planes half a spacing apart, from where the beam was at the begin of `between` to the rear end of the pool that is still
there. In each plane

    width    greatest less least place across the track
    depth    z_plate less the lowest place, at least 0
    height   highest place less z_plate, at least 0
    area     of the section, bead and all (twice that of a half model)

and fused_width, fused_depth, fused_height, fused_area are means over the planes; their uncertainty is the standard deviation over them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .melt_pool import across, hot_region, melting_temperature, molten_pool, plate_surface, resample_hot
from .registry import Reading, measure_of_snapshot
from .snapshot import Snapshot
from .surface import ends, lengths
from .track import Track


@dataclass(frozen=True)
class Sections:
    """Width, depth, height (m), area (m^2) of each plane, each (planes); empty where nothing fused; `note` for the reader."""

    width: np.ndarray
    depth: np.ndarray
    height: np.ndarray
    area: np.ndarray
    note: str = ""


def fused_sections(snapshot: Snapshot) -> Sections:
    """Cross-sections of the fused track in a snapshot; `snapshot.window` is the begin and end of the quasi-steady time."""
    case, elements = snapshot.case, snapshot.elements
    track, threshold, plate = Track.of_case(case), melting_temperature(case), plate_surface(case)
    radius = max(track.spot_radius, case["spacing"])
    begin, end = track.along(snapshot.window[0]), track.along(min(snapshot.window[1], elements.time))

    def reaches(position: np.ndarray) -> np.ndarray:
        return (position[:, 0] >= begin) & (position[:, 0] <= end) & (np.abs(position[:, 1]) <= radius)

    nothing = np.zeros(0)
    found = resample_hot(elements, "peak_temperature", threshold, case, track, reaches)
    if found is None:
        return Sections(nothing, nothing, nothing, nothing)
    resampled, values, _ = found
    region, _ = hot_region(resampled, values, threshold, reaches)
    if not region.any():
        return Sections(nothing, nothing, nothing, nothing)

    note = ""
    tail = snapshot.once(molten_pool).tail if elements.temperature is not None else None
    if tail is not None and tail < end:
        if tail - begin >= 2.0 * case["spacing"]:
            end = tail
        else:
            note = "no part of the quasi-steady track has solidified yet: sections go through the pool"
    along = resampled.coordinates(0)
    planes = (along >= begin - 1e-9 * case["spacing"]) & (along <= end + 1e-9 * case["spacing"])
    planes &= region.any(axis=tuple(range(1, region.ndim)))
    if not planes.any():
        return Sections(nothing, nothing, nothing, nothing, note)
    resampled_ends = {(axis, step): ends(resampled, axis, step, region, values, threshold)[planes]
                      for axis in range(1, region.ndim) for step in (-1, +1)}

    def extreme(axis: int, step: int) -> np.ndarray:
        reduce = np.nanmin if step < 0 else np.nanmax
        return reduce(resampled_ends[axis, step].reshape(np.count_nonzero(planes), -1), axis=1)

    lowest, highest = extreme(region.ndim - 1, -1), extreme(region.ndim - 1, +1)
    width = area = np.zeros(len(lowest))
    if region.ndim == 3:
        left, right = extreme(1, -1), extreme(1, +1)
        width = np.array([across(np.array([0.0, low]), np.array([0.0, high]), case, track)
                          for low, high in zip(left, right)])
        upright = lengths(resampled, region, 2, values, threshold)[planes]
        halves = np.where(width > 1.5 * (right - left), 2.0, 1.0)   # sections that a symmetry plane cuts
        area = np.trapz(upright, dx=resampled.grid_spacing, axis=1) * halves
    return Sections(width, np.maximum(plate - lowest, 0.0), np.maximum(highest - plate, 0.0), area, note)


def _reading(snapshot: Snapshot, values_of) -> Reading:
    sections: Sections = snapshot.once(fused_sections)
    values = values_of(sections)
    if len(values) == 0:
        return Reading(0.0, note="nothing fused in the quasi-steady part of the track")
    spread = float(np.std(values, ddof=1)) if len(values) > 1 else None
    return Reading(float(np.mean(values)), uncertainty=spread, note=sections.note)


@measure_of_snapshot("fused_width", unit="m", needs=("peak_temperature",), summary="last")
def fused_width(snapshot: Snapshot) -> Reading:
    if snapshot.case["dimensions"] == 2:
        return Reading(None, note="a two-dimensional scene has no width across the track")
    return _reading(snapshot, lambda sections: sections.width)


@measure_of_snapshot("fused_area", unit="m^2", needs=("peak_temperature",), summary="last")
def fused_area(snapshot: Snapshot) -> Reading:
    if snapshot.case["dimensions"] == 2:
        return Reading(None, note="a two-dimensional scene has no section across the track")
    return _reading(snapshot, lambda sections: sections.area)


@measure_of_snapshot("fused_depth", unit="m", needs=("peak_temperature",), summary="last")
def fused_depth(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda sections: sections.depth)


@measure_of_snapshot("fused_height", unit="m", needs=("peak_temperature",), summary="last")
def fused_height(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda sections: sections.height)
