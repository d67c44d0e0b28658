"""The drop between two plates by finite elements: its limits, and the table that is kept of it."""

from __future__ import annotations

import numpy as np
import pytest

from cupel.exact import thermocapillary_drop
from cupel.exact.drop_between_plates import Groups, Resolution, velocity_curve


def test_in_a_large_box_without_inertia_the_drop_is_as_fast_as_in_unbounded_liquid():
    creeping = Groups(reynolds=1e-9, marangoni=1e-9, half_box=16.0)
    _, speed = velocity_curve(creeping, Resolution(16, 5, 18, grading=0.92), step=1.0, end=1.0, moves=False)
    exact = thermocapillary_drop.migration_velocity(-1.0, 1.0, 1.0, 0.5, 1.0, 0.5, 1.0, dimensions=2)
    assert speed[-1] == pytest.approx(exact, rel=0.01)          # the box of 32 radii takes 0.5 % off


def test_the_kept_curve_is_what_a_coarse_mesh_comes_close_to():
    time, speed = velocity_curve(resolution=Resolution(16, 5, 7), step=0.02, end=1.9)
    kept = thermocapillary_drop.fitted(time)
    late = (time > 0.15) & (time < 1.895)                       # the start is of first order in the step
    assert np.abs(speed - kept)[late].max() < 0.002*kept[late].max()
    assert np.isnan(thermocapillary_drop.fitted(np.array([0.05, 2.0]))).all()
