"""Start-up of Poiseuille and Couette flow between the walls z_min and z_max, against the series at each snapshot's time.

    velocity_profile_error   sqrt(sum V |u - u_exact|^2 / sum V) / max |u_exact|, both at the time of the snapshot; the worst snapshot of
                             `between`; reference 0

The flow is driven by gravity along x, by the velocities of the walls, or by both.
"""

from __future__ import annotations

import numpy as np

from ..exact import channel_flow as exact
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, primary_material


def _channel(case: dict) -> dict:
    """Keyword arguments of the exact solution. Errors: MeasureError where nothing drives the flow or a wall is missing."""
    domain = case["domain"]
    walls = [domain["boundaries"].get(name) or {} for name in ("z_min", "z_max")]
    if any(wall.get("kind") != "wall" for wall in walls):
        raise MeasureError("resolved case: channel flow needs walls at z_min and z_max")
    lower, upper = (float((wall.get("velocity") or [0.0])[0]) for wall in walls)
    acceleration = float((case.get("gravity") or [0.0])[0]) if "gravity" in case["physics"] else 0.0
    if acceleration == lower == upper == 0.0:
        raise MeasureError("resolved case: neither gravity along x nor a moving wall drives a flow through the channel")
    material = primary_material(case, "viscosity", "density")
    return {"depth": float(domain["upper"][2] - domain["lower"][2]), "kinematic_viscosity": material["viscosity"] / material["density"],
            "acceleration": acceleration, "lower_speed": lower, "upper_speed": upper}


def _worst(readings: list[Reading]) -> Reading:
    known = [reading.value for reading in readings if reading.value is not None]
    if not known:
        return Reading(None, note="no snapshot of the window in which the exact flow moves")
    return Reading(max(known), uncertainty=float(np.std(known, ddof=1)) if len(known) > 1 else None)


@measure_of_snapshot("velocity_profile_error", unit="1", needs=("velocity",), exact=lambda case: 0.0, combine=_worst)
def velocity_profile_error(snapshot: Snapshot) -> Reading:
    elements, channel = snapshot.elements, _channel(snapshot.case)
    bottom = float(snapshot.case["domain"]["lower"][2])
    expected = np.zeros((elements.count, 3))
    expected[:, 0] = exact.velocity(elements.position[:, 2] - bottom, elements.time, **channel)
    heights = np.linspace(0.0, channel["depth"], 201)
    greatest = float(np.abs(exact.velocity(heights, elements.time, **channel)).max())
    if greatest <= 0.0:
        return Reading(None)
    square = np.average(((elements.velocity - expected)**2).sum(axis=1), weights=elements.volume * elements.fraction)
    across = np.average((elements.velocity[:, 1:]**2).sum(axis=1), weights=elements.volume * elements.fraction)
    return Reading(float(np.sqrt(square) / greatest),
                   beside={"across_share": float(np.sqrt(across) / greatest), "greatest_exact_speed_m_per_s": greatest})
