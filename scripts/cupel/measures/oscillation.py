"""Oscillation of a drop: frequency, decay and period of the mode that the case disturbs, from the moment of its shape (drop.py).

Every snapshot of `between` counts; a damped oscillation is fitted to them (history.py). The window should begin after the first half
period or so: a drop released from rest is not yet its normal mode.

    oscillation_frequency   rad/s, reference: normal mode of the viscous drop
    oscillation_decay       1/s, the same
    oscillation_period      s, reference: 2 pi/omega without viscosity (Rayleigh; Lamb)

References are those of a drop in an unbounded fluid where the case resolves its surrounding, and in vacuum where it does not.
"""

from __future__ import annotations

import numpy as np

from ..exact import oscillating_drop as exact
from .drop import drop_of, drop_state, shape_amplitude
from .history import GREATEST_RESIDUAL, Oscillation, Sample, arrays, damped_oscillation, too_few
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up


def inviscid_frequency(case: dict) -> float:
    """Angular frequency (rad/s) of the case's drop without viscosity."""
    drop = drop_of(case, "surface_tension", "density")
    return exact.frequency(drop.material["surface_tension"], drop.material["density"], drop.radius, drop.mode, drop.dimensions,
                           _around(case, "density"))


def _around(case: dict, key: str) -> float:
    """A property of the surrounding; 0 where the case does not resolve it."""
    surrounding = case.get("surrounding") or {}
    return float(look_up(case, "materials", surrounding["material"], key)) if surrounding.get("resolved") else 0.0


def normal_mode(case: dict) -> tuple[float, float]:
    """Angular frequency (rad/s) and decay rate (1/s) of the case's drop."""
    drop = drop_of(case, "surface_tension", "density", "viscosity")
    try:
        return exact.viscous_mode(drop.material["surface_tension"], drop.material["density"], drop.radius,
                                  drop.material["viscosity"], drop.mode, drop.dimensions, _around(case, "density"),
                                  _around(case, "viscosity"))
    except ValueError as problem:
        raise MeasureError(f"resolved case: {problem}") from None


def _amplitude(snapshot: Snapshot) -> tuple[Sample, float]:
    """Time and amplitude of the disturbed mode, and the frequency that is looked for."""
    drop = drop_of(snapshot.case)
    value = shape_amplitude(snapshot.once(drop_state), drop.mode, drop.dimensions)
    return Sample(snapshot.elements.time, value), inviscid_frequency(snapshot.case)


def _fitted(readings: list[Reading]) -> tuple[Oscillation | None, str]:
    """The oscillation through the readings of a window, or None, and a note."""
    time, value = arrays([reading.kept[0] for reading in readings])
    expected = readings[0].kept[1]
    why = too_few(time, 2.0 * np.pi / expected)
    if why:
        return None, why
    found = damped_oscillation(time, value, expected)
    note = ""
    if found.residual > GREATEST_RESIDUAL * max(float(np.abs(value - found.offset).max()), 1e-300):
        note = (f"not a damped oscillation: {found.residual:.2g} of the radius is left over "
                f"where the amplitude begins with {found.amplitude:.2g}")
    return found, note


def _combined(value, error):
    def combine(readings: list[Reading]) -> Reading:
        found, note = _fitted(readings)
        return Reading(None, note=note) if found is None else Reading(float(value(found)), float(error(found)), note=note)

    return combine


def _reading(snapshot: Snapshot) -> Reading:
    sample, expected = snapshot.once(_amplitude)
    return Reading(None, beside={"amplitude": sample.value}, kept=(sample, expected))


@measure_of_snapshot("oscillation_frequency", unit="rad/s", exact=lambda case: normal_mode(case)[0],
                     combine=_combined(lambda found: found.frequency, lambda found: found.frequency_error))
def oscillation_frequency(snapshot: Snapshot) -> Reading:
    return _reading(snapshot)


@measure_of_snapshot("oscillation_decay", unit="1/s", exact=lambda case: normal_mode(case)[1],
                     combine=_combined(lambda found: found.decay, lambda found: found.decay_error))
def oscillation_decay(snapshot: Snapshot) -> Reading:
    return _reading(snapshot)


@measure_of_snapshot("oscillation_period", unit="s", exact=lambda case: 2.0 * np.pi / inviscid_frequency(case),
                     combine=_combined(lambda found: 2.0 * np.pi / found.frequency,
                                       lambda found: 2.0 * np.pi / found.frequency**2 * found.frequency_error))
def oscillation_period(snapshot: Snapshot) -> Reading:
    return _reading(snapshot)
