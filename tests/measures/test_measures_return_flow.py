"""The return flow: exact velocities have no error, wrong ones have the error that they were given."""

from dataclasses import replace

import numpy as np
import pytest
from cupel.exact import return_flow as exact
from cupel.measures import MeasureError, Snapshot
from cupel.measures.registry import find_measure
from cupel.measures.return_flow import layer_of, local_depth, middle_profile
from tests.measures.exact_elements import cells, lattice, particles, scene

H, LENGTH, DX = 1e-3, 9e-3, 1e-4
STRESS = -1e-4 * 2000.0      # d(sigma)/dT dT/dx
SPEED = 0.2 * H / (4.0 * 0.05)


def layer_case(dimensions=2, **more):
    upper = [LENGTH, 0.0 if dimensions == 2 else 1e-3, 1.5e-3]
    liquid = {"density": 1000.0, "viscosity": 0.05, "surface_tension_slope": -1e-4}
    body = {"shape": "box", "material": "liquid", "state": "liquid", "lower": [0, 0, 0], "upper": [LENGTH, upper[1], H]}
    return scene(DX, dimensions, [0, 0, 0], upper, materials={"liquid": liquid}, bodies=[body],
                 physics=["flow", "marangoni"],
                 initial={"temperature": 300.0, "temperature_gradient": [2000.0, 0.0, 0.0]}) | more


def flowing(form, dimensions=2, change=lambda u, eta: u, slope=0.0):
    """The exact flow for the depth H + slope (x - LENGTH/2) that there is at each place."""
    case = layer_case(dimensions)
    upper = case["domain"]["upper"]
    if form == "cells":
        made = cells(lambda p: p[:, 2] <= depth_at(p[:, 0], slope), [0, 0, 0], upper, DX, dimensions)
    else:
        points = lattice([0, 0, 0], [LENGTH, upper[1], H], DX, dimensions)
        if form == "jittered":
            points += DX * np.random.default_rng(2).uniform(-0.2, 0.2, points.shape) * [1, 0, 1]
        points[:, 2] *= depth_at(points[:, 0], slope) / H
        made = particles(points, DX, dimensions)
        made = replace(made, volume=made.volume * depth_at(points[:, 0], slope) / H)
    depth = depth_at(made.position[:, 0], slope)
    eta = made.position[:, 2] / depth
    velocity = np.zeros((made.count, 3))
    velocity[:, 0] = np.where(made.fraction > 0.5, change(exact.velocity(eta, STRESS, depth, 0.05), eta), 3.0)
    return Snapshot(replace(made, velocity=velocity), case)


def depth_at(x, slope):
    return H + slope * (x - 0.5 * LENGTH)


def value(name, snapshot):
    return find_measure(name).read(snapshot).value


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("form", ["lattice", "jittered", "cells"])
def test_exact_flow_has_no_error(form, dimensions):
    snapshot = flowing(form, dimensions)
    # the depth is that of the liquid found, in a jittered lattice 0.7 % off in places
    assert value("profile_error", snapshot) == pytest.approx(0.0, abs=5e-3 if form == "jittered" else 1e-12)
    assert value("surface_speed", snapshot) == pytest.approx(SPEED, rel=8e-3 if form == "jittered" else 1e-9)
    assert value("zero_crossing", snapshot) == pytest.approx(2.0 / 3.0, abs=0.005)   # straight between layers


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("form", ["lattice", "jittered", "cells"])
def test_a_surface_that_the_stress_has_tilted_is_no_error(form, dimensions):
    # 0.024 in the canonical layer: against a level surface 3 eta^2 dH/H, 1.6 % of U over the middle third
    snapshot, slope = flowing(form, dimensions, slope=0.024), 0.024
    depth, found = local_depth(snapshot.elements, snapshot.case, layer_of(snapshot.case))
    assert depth == pytest.approx(H, rel=2e-3) and found == pytest.approx(slope, abs=4e-3 if form == "jittered" else 5e-4)
    assert value("profile_error", snapshot) == pytest.approx(0.0, abs=5e-3 if form == "jittered" else 1e-3)
    profile = middle_profile(snapshot)
    level = exact.velocity(snapshot.elements.position[:, 2] / H, STRESS, H, 0.05)
    third = (np.abs(snapshot.elements.position[:, 0] - 0.5 * LENGTH) < LENGTH / 6) & (snapshot.elements.fraction > 0.5)
    away = (snapshot.elements.velocity[:, 0] - level)[third] / SPEED
    assert np.sqrt(np.mean(away**2)) > 0.02 and len(profile.eta) == third.sum()


@pytest.mark.parametrize("form", ["lattice", "cells"])
def test_flow_that_is_too_fast_everywhere_has_the_error_of_the_excess(form):
    # rms of 3 eta^2 - 2 eta over the depth is sqrt(2/15)
    assert value("profile_error", flowing(form, change=lambda u, eta: 1.1 * u)) == pytest.approx(
        0.1 * np.sqrt(2.0 / 15.0), rel=0.02)


def test_uniform_drift_is_its_own_error_and_a_net_flux():
    reading = find_measure("profile_error").read(flowing("lattice", change=lambda u, eta: u + 0.05 * SPEED))
    assert reading.value == pytest.approx(0.05, rel=1e-6)
    assert reading.beside["net_flux_share"] == pytest.approx(0.05, abs=0.003)


def test_waves_drop_out_of_the_mean_profile_and_lasting_errors_do_not():
    measure, readings = find_measure("mean_profile_error"), []
    for phase in (0.0, np.pi):
        wave = 0.1 * SPEED * np.cos(phase)
        snapshot = flowing("jittered", change=lambda u, eta: 1.1 * u + wave)
        assert value("profile_error", snapshot) == pytest.approx(np.hypot(0.1, 0.1 * np.sqrt(2.0 / 15.0)), rel=0.03)
        readings.append(measure.read(snapshot))
    # 0.0365, and in a jittered lattice of ten layers 1e-3 for the depth found
    assert measure.combine(readings).value == pytest.approx(0.1 * np.sqrt(2.0 / 15.0), abs=1.5e-3)


def test_flow_the_wrong_way_is_wrong():
    snapshot = flowing("lattice", change=lambda u, eta: -u)
    assert value("profile_error", snapshot) == pytest.approx(2.0 * np.sqrt(2.0 / 15.0), rel=0.02)
    assert value("surface_speed", snapshot) == pytest.approx(-SPEED, rel=1e-9)
    assert value("zero_crossing", snapshot) is None


def test_ends_of_the_layer_do_not_count():
    snapshot = flowing("lattice")
    elements = snapshot.elements
    ends = (elements.position[:, 0] < 2.9e-3) | (elements.position[:, 0] > 6.1e-3)
    disturbed = replace(elements, velocity=np.where(ends[:, None], 7.0, elements.velocity))
    assert value("profile_error", Snapshot(disturbed, snapshot.case)) == pytest.approx(0.0, abs=1e-12)


def test_stress_comes_from_the_walls_where_heat_is_solved_for():
    case = layer_case(physics=["flow", "marangoni", "heat"])
    case["domain"]["boundaries"]["x_min"]["temperature"] = 300.0
    case["domain"]["boundaries"]["x_max"]["temperature"] = 309.0
    assert layer_of(case).stress == pytest.approx(-1e-4 * 1000.0)
    assert layer_of(layer_case()).stress == pytest.approx(STRESS)


def test_layer_without_stress_is_refused():
    case = layer_case(initial={"temperature": 300.0, "temperature_gradient": [0.0, 0.0, 0.0]})
    with pytest.raises(MeasureError, match="no thermocapillary stress"):
        layer_of(case)
