"""A drop at rest: the pressure that surface tension makes, and the currents that a bad curvature drives.

    laplace_pressure            mean p deeper than 3 spacings inside (or inside R/2) less mean p farther than 3 spacings outside,
                                0 outside where the surrounding has no elements (a free surface); reference (d - 1) sigma/R
    spurious_capillary_number   greatest |u| mu/sigma in the drop, and outside too where the case resolves the surrounding; the
                                greatest of the window; reference 0
"""

from __future__ import annotations

import numpy as np

from ..exact import laplace
from .drop import drop_of, drop_state
from .registry import Reading, measure_of_snapshot
from .snapshot import Snapshot

BAND = 3.0   # spacings at the surface that belong to neither side


def _jump(case: dict) -> float:
    drop = drop_of(case, "surface_tension")
    return laplace.laplace_pressure(drop.material["surface_tension"], drop.radius, drop.dimensions)


@measure_of_snapshot("laplace_pressure", unit="Pa", needs=("pressure",), exact=_jump)
def laplace_pressure(snapshot: Snapshot) -> Reading:
    state, band = snapshot.once(drop_state), BAND * snapshot.case["spacing"]
    elements, distance = state.elements, state.distance
    inside = (distance < max(state.radius - band, 0.5 * state.radius)) & (elements.fraction > 0.5)
    outside = (distance > state.radius + band) & (elements.fraction < 0.5)
    if not inside.any():
        return Reading(None, note="no element lies deep enough inside the drop")
    within = float(np.average(elements.pressure[inside], weights=elements.volume[inside]))
    scatter = float(np.std(elements.pressure[inside]))
    without = float(np.average(elements.pressure[outside], weights=elements.volume[outside])) if outside.any() else 0.0
    note = ""
    if not outside.any() and (elements.fraction < 0.5).any():
        note = "the surrounding reaches no farther than 3 spacings from the drop: its pressure is taken as 0"
    return Reading(within - without, uncertainty=scatter / np.sqrt(np.count_nonzero(inside)), note=note,
                   beside={"inside_Pa": within, "outside_Pa": without, "scatter_inside_Pa": scatter})


def _worst(readings: list[Reading]) -> Reading:
    values = [reading.value for reading in readings]
    return Reading(max(values), uncertainty=float(np.std(values, ddof=1)) if len(values) > 1 else None)


@measure_of_snapshot("spurious_capillary_number", unit="1", needs=("velocity",), exact=lambda case: 0.0, combine=_worst)
def spurious_capillary_number(snapshot: Snapshot) -> Reading:
    drop, elements = drop_of(snapshot.case, "viscosity", "surface_tension"), snapshot.elements
    speed = np.linalg.norm(elements.velocity, axis=1)
    own = elements.fraction > 0.5
    scale = drop.material["viscosity"] / drop.material["surface_tension"]
    resolved = (snapshot.case.get("surrounding") or {}).get("resolved")
    value = float(speed.max() if resolved else speed[own].max(initial=0.0))
    return Reading(scale * value, beside={"greatest_speed_m_per_s": value, "rms_speed_m_per_s": _mean_speed(speed[own])})


def _mean_speed(speed: np.ndarray) -> float | None:
    return float(np.sqrt((speed**2).mean())) if len(speed) else None
