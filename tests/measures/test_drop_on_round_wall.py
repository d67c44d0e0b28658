"""Drops on a cylinder and in a vessel: the exact shape, and the measured one of particles made from it."""

import numpy as np
import pytest

from cupel.exact.drop_on_round_wall import RoundCap, common_area
from cupel.exact.spherical_cap import Cap
from cupel.measures import Elements, Snapshot
from cupel.measures.contact_angle import drop_shape
from cupel.measures.registry import find_measure
from tests.measures.exact_elements import scene

ANGLES = [45, 90, 135]


def test_common_area_of_two_discs():
    assert common_area(1.0, 2.0, 3.1) == 0.0
    assert common_area(1.0, 2.0, 0.5) == pytest.approx(np.pi)
    assert common_area(1.0, 1.0, 1.0) == pytest.approx(2.0 * np.pi / 3.0 - np.sqrt(3.0) / 2.0)


@pytest.mark.parametrize("inside", [False, True])
@pytest.mark.parametrize("angle", ANGLES)
def test_a_wall_of_great_radius_is_a_plane(angle, inside):
    flat = Cap.of_content(1.0, np.radians(angle), 2)
    cap = RoundCap.of_content(1.0, 1e4, np.radians(angle), inside)
    assert cap.base_radius == pytest.approx(flat.base_radius, rel=2e-4)
    assert cap.height == pytest.approx(flat.height, rel=2e-4)


@pytest.mark.parametrize("inside", [False, True])
@pytest.mark.parametrize("angle", ANGLES)
def test_area_is_what_was_asked_and_circles_meet_at_the_angle(angle, inside):
    cap = RoundCap.of_content(0.4, 1.5, np.radians(angle), inside)
    assert cap.content == pytest.approx(0.4, rel=1e-10)
    half = np.arcsin(cap.base_radius / cap.wall_radius)
    contact = cap.wall_radius * np.array([np.sin(half), np.cos(half)])
    to_wall, to_drop = contact / cap.wall_radius, (contact - [0.0, cap.distance]) / cap.radius
    between = np.degrees(np.arccos(to_wall @ to_drop))
    assert between == pytest.approx(180.0 - angle if inside else angle, abs=1e-6)


def test_no_drop_that_bulges_fills_a_vessel():
    with pytest.raises(ValueError, match="that bulges"):
        RoundCap.of_content(2.0, 1.0, np.radians(45), True)


def rings(first, last, spacing):
    """Places (n, 3) and volumes on rings between two radii, each as wide as the spacing."""
    places, volumes = [], []
    for radius in np.arange(first + spacing / 2.0, last, spacing):
        count = round(2.0 * np.pi * radius / spacing)
        angle = 2.0 * np.pi * (np.arange(count) + 0.5) / count
        places.append(np.stack([radius * np.sin(angle), np.zeros(count), radius * np.cos(angle)], axis=1))
        volumes.append(np.full(count, 2.0 * np.pi * radius * spacing / count))
    return np.concatenate(places), np.concatenate(volumes)


def on_wall(angle, inside, rest=False, wall_radius=36.0, radius=12.0, turn=0.7, fineness=0.25):
    """Particles of the drop of half a disc's area on a round wall, spacing 1, its axis turned from the vertical (rad); the case; its
    exact shape. Particles are finer than the spacing, so that they know the surface well. rest: of a vessel, what the drop leaves."""
    cap = RoundCap.of_content(0.5 * np.pi * radius**2, wall_radius, np.radians(angle), inside)
    places, volumes = rings(0.0, wall_radius, fineness) if inside else rings(wall_radius, wall_radius + 30.0, fineness)
    center = cap.distance * np.array([np.sin(turn), 0.0, np.cos(turn)])
    own = (np.linalg.norm(places - center, axis=1) <= cap.radius) != rest
    half = wall_radius + 40.0
    case = scene(1.0, 2, [-half, 0.0, -half], [half, 0.0, half])
    case["domain"]["boundaries"] = {side: {"kind": "open"} for side in case["domain"]["boundaries"]}
    case["domain"]["round_walls"] = {"center": [0.0, 0.0, 0.0], "outer_radius" if inside else "inner_radius": wall_radius}
    return Elements(places[own], volumes[own], np.ones(own.sum())), case, cap


@pytest.mark.parametrize("inside", [False, True])
@pytest.mark.parametrize("angle", ANGLES)
def test_measured_shape_is_that_of_the_particles(angle, inside):
    elements, case, cap = on_wall(angle, inside)
    shape = drop_shape(Snapshot(elements, case))
    assert np.degrees(shape.contact_angle) == pytest.approx(angle, abs=0.5)
    assert shape.base_radius == pytest.approx(cap.base_radius, abs=0.15)
    assert shape.apex_height == pytest.approx(cap.height, abs=0.15)


def test_liquid_around_a_hollow_surface_has_its_angle_too():
    # the vessel without the lens of 120 degrees is liquid of 60 degrees
    elements, case, cap = on_wall(120, True, rest=True)
    shape = drop_shape(Snapshot(elements, case))
    assert np.degrees(shape.contact_angle) == pytest.approx(60.0, abs=0.5)
    assert shape.base_radius == pytest.approx(cap.base_radius, abs=0.15)


def test_exact_values_of_a_case():
    _, case, _ = on_wall(90, False)
    case["materials"]["liquid"]["contact_angle"] = np.radians(60.0)
    case["bodies"] = [{"shape": "sphere", "material": "liquid", "state": "liquid", "center": [0.0, 0.0, 36.0], "radius": 12.0}]
    area = np.pi * 12.0**2 - common_area(12.0, 36.0, 36.0)
    exact = RoundCap.of_content(area, 36.0, np.radians(60.0), False)
    assert find_measure("base_radius").exact(case) == pytest.approx(exact.base_radius)
    assert find_measure("apex_height").exact(case) == pytest.approx(exact.height)
