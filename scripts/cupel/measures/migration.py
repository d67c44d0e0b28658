"""Migration of a drop in a gradient of temperature.

    drop_velocity     m/s, mean velocity of the drop's elements, sum V f u/sum V f, along the gradient: positive toward the hot side;
                      reference: the unbounded limit in creeping flow (approach it by making the box larger)
    start_up_error    greatest |U - exact|/U_unbounded over the snapshots of `between`, the exact velocity being that of a disc that starts at
                      rest in an unbounded liquid (creeping flow): the limit itself is approached as 1/t only; reference 0
    migration_error   greatest |U/U_r - table|/plateau over the snapshots of `between` between t/t_r = 0.102 and 1.9, the times that
                      Ma and Bothe's table covers; reference 0
    migration_error_sharp_interface   the same for the curve by finite elements that fit the drop, over its own greatest value

Beside the velocity stands how far the drop's centroid has come since the first snapshot; beside an error, the velocity and that of the
curve.
"""

from __future__ import annotations

import numpy as np

from ..exact import thermocapillary_drop as exact
from ..exact import thermocapillary_start_up as start_up
from .drop import drop_of, drop_state
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up, primary_material

SAME_GROUP = 0.02   # relative difference within which a case is the one of the table


def gradient_of(case: dict) -> np.ndarray:
    """Gradient of temperature (3) K/m: the initial one, or that between two walls that face each other.

    Errors: MeasureError if there is none.
    """
    gradient = np.array((case.get("initial") or {}).get("temperature_gradient") or [0.0, 0.0, 0.0], float)
    domain = case["domain"]
    for axis, name in enumerate("xyz"):
        walls = [(domain["boundaries"].get(f"{name}_{side}") or {}).get("temperature") for side in ("min", "max")]
        if not gradient.any() and None not in walls and walls[0] != walls[1]:
            gradient[axis] = (walls[1] - walls[0]) / (domain["upper"][axis] - domain["lower"][axis])
    if not gradient.any():
        raise MeasureError("resolved case: no gradient of temperature that could move a drop")
    return gradient


def _pair(case: dict) -> tuple[dict, dict]:
    """Properties of the drop and of what surrounds it."""
    needed = ("density", "viscosity", "conductivity", "specific_heat")
    around = look_up(case, "materials", look_up(case, "surrounding", "material"))
    for key in needed:
        look_up(around, key)
    return primary_material(case, *needed, "surface_tension_slope", "surface_tension"), around


def _unbounded(case: dict) -> float:
    drop, (own, around) = drop_of(case), _pair(case)
    return exact.migration_velocity(own["surface_tension_slope"], float(np.linalg.norm(gradient_of(case))), drop.radius,
                                    own["conductivity"], around["conductivity"], own["viscosity"], around["viscosity"],
                                    drop.dimensions)


def _velocity(snapshot: Snapshot) -> float:
    """Velocity of the drop along the gradient, m/s."""
    state, gradient = snapshot.once(drop_state), gradient_of(snapshot.case)
    mean = (state.weight[:, None] * state.elements.velocity).sum(axis=0) / state.weight.sum()
    return float(mean @ gradient / np.linalg.norm(gradient))


@measure_of_snapshot("drop_velocity", unit="m/s", needs=("velocity",), exact=_unbounded)
def drop_velocity(snapshot: Snapshot) -> Reading:
    gradient = gradient_of(snapshot.case)
    way = snapshot.once(drop_state).center - snapshot.first.once(drop_state).center
    return Reading(snapshot.once(_velocity), beside={"way_m": float(way @ gradient / np.linalg.norm(gradient))})


def _start_up(snapshot: Snapshot) -> float:
    """Exact velocity (m/s) of the case's disc at the snapshot's time."""
    drop = drop_of(snapshot.case)
    if drop.dimensions != 2:
        raise MeasureError("resolved case: the exact start of a migration is that of a 2-D drop")
    own, around = (start_up.Fluid(*(of[key] for key in ("density", "viscosity", "conductivity", "specific_heat")))
                   for of in _pair(snapshot.case))
    slope = primary_material(snapshot.case, "surface_tension_slope")["surface_tension_slope"]
    return float(start_up.velocity(np.array([snapshot.elements.time]), slope, float(np.linalg.norm(gradient_of(snapshot.case))),
                                   drop.radius, own, around)[0])


@measure_of_snapshot("start_up_error", unit="1", needs=("velocity",), exact=lambda case: 0.0,
                     combine=lambda readings: Reading(max(reading.value for reading in readings)))
def start_up_error(snapshot: Snapshot) -> Reading:
    found, expected = snapshot.once(_velocity), _start_up(snapshot)
    return Reading(abs(found - expected) / abs(_unbounded(snapshot.case)),
                   beside={"velocity_m_per_s": found, "exact_velocity_m_per_s": expected})


def ma_bothe_units(case: dict) -> tuple[float, float]:
    """U_r (m/s) and t_r (s) of Ma and Bothe's drop. Errors: MeasureError that names the group in which the case is another one."""
    drop, (own, around) = drop_of(case), _pair(case)
    if drop.dimensions != 2:
        raise MeasureError("resolved case: the table of Ma and Bothe is for a 2-D drop")
    speed = abs(own["surface_tension_slope"]) * float(np.linalg.norm(gradient_of(case))) * drop.radius / around["viscosity"]
    lower, upper = (np.array(case["domain"][corner], float) for corner in ("lower", "upper"))
    width = float(upper[0] - lower[0])
    for side, plane in (("x_min", lower[0]), ("x_max", upper[0])):
        if (case["domain"]["boundaries"].get(side) or {}).get("kind") == "symmetry" and abs(drop.center[0] - plane) < 1e-6 * drop.radius:
            width *= 2.0
    inertia = around["density"] * speed * drop.radius
    groups = {
        "Reynolds number": inertia / around["viscosity"],
        "Marangoni number": inertia * around["specific_heat"] / around["conductivity"],
        "capillary number": around["viscosity"] * speed / own["surface_tension"],
        "density ratio": own["density"] / around["density"], "viscosity ratio": own["viscosity"] / around["viscosity"],
        "conductivity ratio": own["conductivity"] / around["conductivity"],
        "heat capacity ratio": own["specific_heat"] / around["specific_heat"],
        "box width over radius": width / drop.radius, "box height over radius": float(upper[2] - lower[2]) / drop.radius,
    }
    for name, value in groups.items():
        if abs(value / exact.MA_BOTHE_GROUPS[name] - 1.0) > SAME_GROUP:
            raise MeasureError(f"resolved case: {name} is {value:.4g}, the table of Ma and Bothe is for {exact.MA_BOTHE_GROUPS[name]:g}")
    return speed, drop.radius / speed


def _greatest(readings: list[Reading]) -> Reading:
    known = [reading.value for reading in readings if reading.value is not None]
    if len(known) < 8:
        return Reading(None, note=f"only {len(known)} snapshots of the window lie between t/t_r = 0.102 and 1.9; the curve needs 8")
    return Reading(max(known))


@measure_of_snapshot("migration_error", unit="1", needs=("velocity",), exact=lambda case: 0.0, combine=_greatest)
def migration_error(snapshot: Snapshot) -> Reading:
    return _distance(snapshot, exact.ma_bothe, exact.MA_BOTHE_PLATEAU)


@measure_of_snapshot("migration_error_sharp_interface", unit="1", needs=("velocity",), exact=lambda case: 0.0, combine=_greatest)
def migration_error_sharp_interface(snapshot: Snapshot) -> Reading:
    return _distance(snapshot, exact.fitted, max(exact.FITTED_SPEED))


def _distance(snapshot: Snapshot, curve, greatest: float) -> Reading:
    """How far the drop's U/U_r is from a curve at the snapshot's t/t_r, over `greatest`; none where the table ends."""
    speed, time = ma_bothe_units(snapshot.case)
    relative, moment = snapshot.once(_velocity) / speed, snapshot.elements.time / time
    known = bool(np.isfinite(exact.ma_bothe(moment)))
    beside = {"velocity_over_U_r": relative, "time_over_t_r": moment, "curve": float(curve(moment)) if known else None}
    return Reading(abs(relative - beside["curve"]) / greatest if known else None, beside=beside)
