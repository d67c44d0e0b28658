"""Decay of a Taylor-Green vortex.

    decay_rate   1/s, rate at which the kinetic energy sum V f |u|^2/2 decays: slope of its logarithm over the snapshots of `between`;
                 reference 4 nu k^2

Beside it stand the energy and, relative to the greatest exact speed of the moment, the L2 error of the velocity.
"""

from __future__ import annotations

import numpy as np

from ..exact import taylor_green as exact
from .history import Sample, arrays, straight_line
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up, primary_material

FEWEST = 5   # snapshots


def _vortex(case: dict) -> tuple[float, float, float]:
    """Speed m/s, wavelength m and kinematic viscosity m^2/s of the case's vortex."""
    field = look_up(case, "initial", "velocity")
    if field.get("field") != "taylor_green":
        raise MeasureError("resolved case: initial.velocity is no taylor_green field; its decay is not known")
    material = primary_material(case, "viscosity", "density")
    return float(field["speed"]), float(field["wavelength"]), material["viscosity"] / material["density"]


def _exact_rate(case: dict) -> float:
    _, wavelength, viscosity = _vortex(case)
    return exact.energy_decay_rate(viscosity, wavelength)


def _rate(readings: list[Reading]) -> Reading:
    time, energy = arrays([reading.kept for reading in readings])
    if len(time) < FEWEST:
        return Reading(None, note=f"only {len(time)} snapshots in the window, {FEWEST} are needed: make time.output_interval smaller")
    if (energy <= 0.0).any():
        return Reading(None, note="the flow has come to rest: no decay can be read from it")
    line = straight_line(time, np.log(energy))
    return Reading(-line.slope, uncertainty=line.slope_error)


@measure_of_snapshot("decay_rate", unit="1/s", needs=("velocity",), exact=_exact_rate, combine=_rate)
def decay_rate(snapshot: Snapshot) -> Reading:
    elements = snapshot.elements
    speed, wavelength, viscosity = _vortex(snapshot.case)
    weight = elements.volume * elements.fraction
    energy = 0.5 * float(np.average((elements.velocity**2).sum(axis=1), weights=weight))
    expected = exact.velocity(elements.position, elements.time, speed, viscosity, wavelength)
    square = np.average(((elements.velocity - expected)**2).sum(axis=1), weights=weight)
    greatest = speed * np.exp(-0.5 * exact.energy_decay_rate(viscosity, wavelength) * elements.time)
    return Reading(None, kept=Sample(elements.time, energy),
                   beside={"kinetic_energy_J_per_kg": energy, "velocity_L2_error": float(np.sqrt(square) / greatest)})
