"""Resampling: surfaces are where they are, linear fields stay linear, whatever the elements."""

from dataclasses import replace

import numpy as np
import pytest
from cupel.measures import Elements
from cupel.measures.contact_angle import fit_sphere
from cupel.measures.fields import Resampled, mirrored, subdivided
from cupel.measures.surface import SURFACE_DENSITY, box, cross_section, interface, largest_region
from tests.measures.exact_elements import cells, lattice, particles, scene
from cupel.exact.spherical_cap import Cap

LOWER, UPPER = np.array([-6.0, -6.0, 0.0]), np.array([6.0, 6.0, 12.0])


def resample(elements, case, lower=(-3.0, -3.0, 0.0), upper=(3.0, 3.0, 11.0)):
    axes = [0, 1, 2] if case["dimensions"] == 3 else [0, 2]
    made = subdivided(mirrored(elements, case), case["spacing"], case["dimensions"])
    return Resampled(made, case, np.array(lower)[axes], np.array(upper)[axes])


def surface_height(resampled):
    top = resampled.density >= SURFACE_DENSITY
    return box(resampled, top)[1][-1]


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("shift", [0.0, 0.13, 0.25, 0.4])
def test_flat_face_of_lattice_particles_is_half_a_spacing_beyond_the_last(dimensions, shift):
    case = scene(1.0, dimensions, LOWER + [0, 0, shift], UPPER + [0, 0, shift])
    points = lattice(case["domain"]["lower"], [6.0, 6.0, 7.0 + shift], 1.0, dimensions)
    points[:, 0] += 0.31   # the lattice need not be the grid's
    case["domain"]["lower"][2] -= 0.17   # and neither need the face
    height = surface_height(resample(particles(points, 1.0, dimensions), case))
    assert height == pytest.approx(7.0 + shift, abs=0.05)


@pytest.mark.parametrize("height", [6.0, 6.1, 6.25, 6.5, 6.77])
@pytest.mark.parametrize("dimensions", [2, 3])
def test_flat_face_of_volume_fractions_is_where_they_put_it(dimensions, height):
    case = scene(1.0, dimensions, LOWER, UPPER)
    made = cells(lambda p: p[:, 2] <= height, LOWER, UPPER, 1.0, dimensions, finer=2)
    exact = np.clip(height - (made.position[:, 2] - 0.5), 0.0, 1.0)
    assert surface_height(resample(replace(made, fraction=exact), case)) == pytest.approx(height, abs=0.05)


def test_face_between_two_phases_of_particles_is_midway():
    case = scene(1.0, 3, LOWER, UPPER)
    points = lattice(LOWER, UPPER, 1.0)
    made = particles(points, 1.0, fraction=(points[:, 2] < 7.0).astype(float))
    assert surface_height(resample(made, case)) == pytest.approx(7.0, abs=0.05)


def test_volumes_that_are_too_small_everywhere_do_not_move_a_face_between_phases():
    case = scene(1.0, 3, LOWER, UPPER)
    points = lattice(LOWER, UPPER, 1.0)
    made = particles(points, 1.0, fraction=(points[:, 2] < 7.0).astype(float))
    made = replace(made, volume=0.9 * made.volume)
    assert surface_height(resample(made, case)) == pytest.approx(7.0, abs=0.05)


def test_material_at_a_wall_is_full_there_and_half_without_the_wall():
    case = scene(1.0, 3, LOWER, UPPER)
    made = particles(lattice(LOWER, [6.0, 6.0, 7.0], 1.0), 1.0)
    assert resample(made, case).density[4, 4, 0] == pytest.approx(1.0, abs=1e-9)
    case["domain"]["boundaries"]["z_min"] = {"kind": "open"}
    assert resample(made, case).density[4, 4, 0] == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize("form", ["lattice", "jittered", "cells"])
def test_linear_field_is_exact_up_to_the_surface(form):
    case = scene(1.0, 3, LOWER, UPPER)
    if form == "cells":
        made = cells(lambda p: p[:, 2] <= 7.0, LOWER, UPPER, 1.0)
    else:
        points = lattice(LOWER, [6.0, 6.0, 7.0], 1.0)
        if form == "jittered":
            points += np.random.default_rng(3).uniform(-0.2, 0.2, points.shape)
        made = particles(points, 1.0)
    slope = np.array([30.0, -20.0, 50.0])
    case["domain"]["boundaries"] = {}   # images at a wall would make the field even there
    made = replace(made, temperature=np.where(made.fraction > 0.5, 1000.0 + made.position @ slope, -1e6))
    resampled = resample(made, case, lower=(-3.0, -3.0, 3.0), upper=(3.0, 3.0, 8.0))
    values = resampled.values(made.temperature)
    nodes = np.stack(np.meshgrid(*[resampled.coordinates(k) for k in range(3)], indexing="ij"), axis=-1)
    metal = resampled.density >= 0.5
    assert metal.any()
    # the gradient's regularisation takes a fortieth of it, over the spacing from centroid to surface
    assert np.abs(values - 1000.0 - nodes @ slope)[metal].max() < 0.025 * np.linalg.norm(slope)


def test_sphere_between_nodes_has_its_area_and_its_volume():
    case = scene(1.0, 3, [-12.0] * 3, [12.0] * 3)
    cap = Cap(8.3, np.pi)
    made = cells(lambda p: np.linalg.norm(p - [0.2, 0.1, -0.3], axis=1) < cap.radius, [-12.0] * 3, [12.0] * 3, 1.0)
    resampled = resample(made, case, [-11.0] * 3, [11.0] * 3)
    inside, share = largest_region(resampled.density >= 0.5)
    assert share == 1.0
    smoothed = Cap(cap.radius - resampled.surface_variance / cap.radius, np.pi)
    assert cross_section(resampled, inside).sum() * 0.5 == pytest.approx(smoothed.content, rel=0.003)
    surface = interface(resampled, inside)
    area_per_weight = 0.25   # each line stands for (dx/2)^2
    assert surface.weights.sum() * area_per_weight == pytest.approx(4.0 * np.pi * smoothed.radius**2, rel=0.03)
    distance = np.linalg.norm(surface.points - [0.2, 0.1, -0.3], axis=1)
    assert np.abs(distance + resampled.surface_variance / cap.radius - cap.radius).max() < 0.06


def test_coarse_cells_are_cut_and_leave_no_gaps():
    case = scene(1.0, 3, LOWER, UPPER)
    coarse = cells(lambda p: p[:, 2] <= 6.0, LOWER, UPPER, 3.0)
    made = subdivided(coarse, 1.0, 3)
    assert made.count == 27 * coarse.count
    assert made.volume.sum() == pytest.approx(coarse.volume.sum())
    assert surface_height(resample(coarse, case)) == pytest.approx(6.0, abs=0.05)


def test_two_dimensional_volumes_are_areas_whatever_thickness_the_file_has():
    position = lattice([0, 0, 0], [0.2, 0, 0.2], 0.01, 2)
    area = np.full(len(position), 1e-4)
    for volume, extent in ((area, None), (area * 0.01, None), (area * 0.2, np.tile([0.01, 0.2, 0.01], (len(position), 1)))):
        made = Elements(position, volume, np.ones(len(position)), extent=extent)
        assert made.content(2, 0.01) == pytest.approx(area)


@pytest.mark.parametrize("radius", [5.0, 8.0, 15.0])
def test_ball_of_particles_that_follow_its_surface_is_found_within_a_hundredth_of_a_spacing(radius):
    position, volume = [], []
    turn = np.random.default_rng(0)
    for outer in np.arange(radius, 0.0, -1.0):   # shells one spacing thick, points spread evenly on each
        content = 4.0 / 3.0 * np.pi * (outer**3 - max(outer - 1.0, 0.0)**3)
        count = max(round(content), 1)
        z = 1.0 - 2.0 * (np.arange(count) + 0.5) / count
        azimuth = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
        direction = np.stack([np.sqrt(1.0 - z**2) * np.cos(azimuth), np.sqrt(1.0 - z**2) * np.sin(azimuth), z], axis=1)
        position.append((outer - 0.5) * direction @ np.linalg.qr(turn.normal(size=(3, 3)))[0])
        volume.append(np.full(count, content / count))
    volume = np.concatenate(volume)
    reach = radius + 4.0
    case = scene(1.0, 3, [-reach] * 3, [reach] * 3)
    resampled = resample(Elements(np.concatenate(position), volume, np.ones(len(volume))), case, [1 - reach] * 3, [reach - 1] * 3)
    surface = interface(resampled, largest_region(resampled.density >= SURFACE_DENSITY)[0])
    center, found, residual = fit_sphere(surface.points, surface.weights)
    assert found + resampled.surface_variance / found == pytest.approx(radius, abs=0.01)
    assert residual < 0.03 and np.abs(center).max() < 0.01
