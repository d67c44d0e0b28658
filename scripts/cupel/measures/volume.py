"""Volume of the primary material against its first snapshot.

    volume_change           sum V f / (sum V f at the first snapshot) - 1: the elements' own volumes
    enclosed_volume_change  the same for the volume that the surface density = 1/2 encloses (all regions together)

Particles keep the first by construction, nearly; only the second sees them clump or drift apart. The second is coarser:
the kernel takes 3 s^2/R^2 (1.3 % at 20 spacings a diameter) from a ball and less from what spreads out of it.
"""

from __future__ import annotations

import numpy as np

from .fields import Resampled, active_axes, mirrored, subdivided
from .registry import Reading, measure_of_snapshot
from .snapshot import Snapshot
from .surface import SURFACE_DENSITY, cross_section


def element_volume(snapshot: Snapshot) -> float:
    """Sum of volume times fraction, m^3 (in 2-D of what the file calls volume)."""
    return float((snapshot.elements.volume * snapshot.elements.fraction).sum())


def enclosed_volume(snapshot: Snapshot) -> float:
    """Volume (m^3; m^2 in 2-D) inside the surface of the primary material."""
    case, spacing = snapshot.case, float(snapshot.case["spacing"])
    axes = active_axes(case["dimensions"])
    own = snapshot.elements.position[snapshot.elements.fraction > 0.5][:, axes]
    if len(own) == 0:
        return 0.0
    lower = np.maximum(own.min(axis=0) - 3.0 * spacing, [case["domain"]["lower"][axis] for axis in axes])
    upper = np.minimum(own.max(axis=0) + 3.0 * spacing, [case["domain"]["upper"][axis] for axis in axes])
    elements = subdivided(mirrored(snapshot.elements, case), spacing, case["dimensions"])
    resampled = Resampled(elements, case, lower, upper)
    section = cross_section(resampled, resampled.density >= SURFACE_DENSITY)
    return float(np.trapz(section, dx=resampled.grid_spacing))


def _change(snapshot: Snapshot, amount) -> Reading:
    start = snapshot.first.once(amount)
    if start <= 0.0:
        return Reading(None, note="the first snapshot has no primary material")
    return Reading(snapshot.once(amount) / start - 1.0)


def _nothing_lost(case: dict) -> float:
    return 0.0


@measure_of_snapshot("volume_change", unit="1", exact=_nothing_lost)
def volume_change(snapshot: Snapshot) -> Reading:
    return _change(snapshot, element_volume)


@measure_of_snapshot("enclosed_volume_change", unit="1", exact=_nothing_lost)
def enclosed_volume_change(snapshot: Snapshot) -> Reading:
    return _change(snapshot, enclosed_volume)
