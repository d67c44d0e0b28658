"""Drops on a wall: angle, base and height are those of the cap that the elements were made from."""

from dataclasses import replace

import numpy as np
import pytest
from cupel.measures import MeasureError, Snapshot
from cupel.measures.contact_angle import drop_shape, fit_sphere
from cupel.measures.registry import find_measure
from cupel.measures.volume import element_volume, enclosed_volume
from tests.measures.exact_elements import cells, drop, in_cap, lattice, particles, scene

ANGLES = [30, 45, 60, 90, 120, 150]


def shape_of(elements, case):
    return drop_shape(Snapshot(elements, case))


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("form", ["lattice", "jittered", "two_phase", "cells"])
@pytest.mark.parametrize("angle", ANGLES)
def test_angle_is_found_within_one_degree(angle, form, dimensions):
    elements, case, cap = drop(angle, form, 20.0, dimensions)
    shape = shape_of(elements, case)
    assert np.degrees(shape.contact_angle) == pytest.approx(angle, abs=0.2 if form == "cells" else 1.0)


@pytest.mark.parametrize("form", ["jittered", "cells"])
@pytest.mark.parametrize("angle", ANGLES)
def test_base_and_height_from_the_interface_are_those_of_the_cap(angle, form):
    elements, case, cap = drop(angle, form)
    shape = shape_of(elements, case)
    # volume fractions know the surface; cut particles know it to some tenths of a spacing (height 0.3, base 0.2)
    bound = 0.05 if form == "cells" else 0.3
    assert shape.base_radius == pytest.approx(cap.base_radius, abs=bound)
    assert shape.apex_height == pytest.approx(cap.height, abs=bound)


def test_finer_cells_bring_everything_closer():
    errors = []
    for diameter in (8.0, 40.0):
        elements, case, cap = drop(60, "cells", diameter, dimensions=2)
        shape = shape_of(elements, case)
        errors.append(max(abs(shape.base_radius / cap.base_radius - 1.0), abs(shape.apex_height / cap.height - 1.0),
                          abs(np.degrees(shape.contact_angle) / 60 - 1.0)))
    assert errors[1] < 0.3 * errors[0] < 0.3 * 0.02


def test_drop_that_has_drifted_measures_the_same():
    here = shape_of(*drop(60, "cells")[:2])
    elements, case, cap = drop(60, "cells")
    away = replace(elements, position=elements.position + [7.0, -4.0, 0.0])
    for corner in ("lower", "upper"):
        case["domain"][corner] = np.array(case["domain"][corner]) + [7.0, -4.0, 0.0]
    moved = shape_of(away, case)
    assert moved.contact_angle == pytest.approx(here.contact_angle, abs=1e-6)
    assert moved.base_radius == pytest.approx(here.base_radius, rel=1e-6)
    assert np.array(moved.center) - here.center == pytest.approx([7.0, -4.0, 0.0], abs=1e-6)


def test_quarter_drop_between_symmetry_planes_has_the_base_of_the_whole():
    elements, case, cap = drop(60, "cells", center=(0.0, 0.0))
    quarter = elements.take((elements.position[:, 0] > 0) & (elements.position[:, 1] > 0))
    case["domain"]["lower"] = [0.0, 0.0, 0.0]
    case["domain"]["boundaries"] |= {"x_min": {"kind": "symmetry"}, "y_min": {"kind": "symmetry"}}
    shape = shape_of(quarter, case)
    assert np.degrees(shape.contact_angle) == pytest.approx(60, abs=0.3)
    assert shape.base_radius == pytest.approx(cap.base_radius, rel=0.01)


def test_a_wrong_shape_cannot_hide_behind_its_angle():
    # two caps one above the other: a foot of 40 degrees under a crown of 70
    foot, case, cap = drop(40, "cells", 24.0)
    crown = in_cap(drop(70, "cells", 22.0)[2], (0.13, -0.21))
    both = cells(lambda p: in_cap(cap, (0.13, -0.21))(p) | crown(p), case["domain"]["lower"],
                 np.array(case["domain"]["upper"]) + [0, 0, 6.0], 1.0)
    case["domain"]["upper"] = np.array(case["domain"]["upper"]) + [0, 0, 6.0]
    shape = shape_of(both, case)
    assert "base radius" in shape.note and "height" in shape.note and "sphere fit" in shape.note


def test_satellites_do_not_enter_the_fit_and_are_named():
    elements, case, cap = drop(60, "cells", center=(0.0, 0.0))
    far = np.linalg.norm(elements.position - [14.0, 14.0, 2.5], axis=1) < 2.5
    shape = shape_of(replace(elements, fraction=np.where(far, 1.0, elements.fraction)), case)
    assert np.degrees(shape.contact_angle) == pytest.approx(60, abs=0.2)
    assert "apart from the drop" in shape.note


@pytest.mark.parametrize("thickness, why", [(1.0, "not higher"), (4.0, "flat")])
def test_a_flat_film_has_no_angle_and_says_so(thickness, why):
    case = scene(1.0, 3, [-8, -8, 0], [8, 8, 8])
    film = particles(lattice([-8, -8, 0], [8, 8, thickness], 1.0), 1.0)
    reading = find_measure("contact_angle").read(Snapshot(film, case))
    assert reading.value is None and why in reading.note


def test_a_drop_that_floats_has_no_angle_and_says_so():
    case = scene(1.0, 3, [-9, -9, 0], [9, 9, 20])
    ball = cells(lambda p: np.linalg.norm(p - [0, 0, 11.0], axis=1) < 6.0, [-9, -9, 0], [9, 9, 20], 1.0)
    shape = shape_of(ball, case)
    assert shape.contact_angle is None and "floats" in shape.note


def test_no_primary_material_has_no_angle_and_says_so():
    elements, case, _ = drop(60, "cells")
    shape = shape_of(replace(elements, fraction=np.zeros(elements.count)), case)
    assert shape.contact_angle is None and "no primary material" in shape.note


def test_sphere_fit_is_exact_for_points_on_a_sphere_and_refuses_a_plane():
    direction = np.random.default_rng(5).normal(size=(200, 3))
    direction[:, 2] = np.abs(direction[:, 2])
    points = [1.0, 2.0, -3.0] + 4.0 * direction / np.linalg.norm(direction, axis=1, keepdims=True)
    center, radius, residual = fit_sphere(points, np.ones(200))
    assert center == pytest.approx([1.0, 2.0, -3.0], abs=1e-9)
    assert radius == pytest.approx(4.0) and residual < 1e-9
    with pytest.raises(MeasureError, match="flat"):
        fit_sphere(points * [1.0, 1.0, 0.0], np.ones(200))


def test_volume_sums_fractions_and_the_enclosed_volume_sees_clumping():
    elements, case, cap = drop(60, "jittered", noise=0.0)
    before = Snapshot(elements, case)
    assert element_volume(before) == pytest.approx(cap.content, rel=0.02)
    assert enclosed_volume(before) == pytest.approx(cap.content, rel=0.03)
    clumped = replace(elements, position=elements.position * [0.9, 0.9, 1.0])
    after = Snapshot(clumped, case, before)
    assert find_measure("volume_change").read(after).value == pytest.approx(0.0, abs=1e-12)
    # the surface of particles that are too dense lies a little further out than half a spacing
    assert 0.9**2 - 1.0 < find_measure("enclosed_volume_change").read(after).value < -0.12
