"""What a case says about its start, as the writer gives it to the solver: shapes, velocities, temperatures, moving walls."""

from __future__ import annotations

import json

import numpy as np
import pytest

from reference_openfoam import case_writer, resolved_case
from reference_openfoam.grid import make_grid
from reference_openfoam.volume_fractions import top_of_bodies, volume_fractions
from tests.reference_openfoam import small_cases

LIQUIDS = {"oil": {"density": 900.0, "viscosity": 0.05, "surface_tension": 0.05}, "water": {"density": 1000.0, "viscosity": 1e-3}}
WATER = {"material": "water", "resolved": True, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0}


def read(folder, **parts):
    path = folder/"resolved.json"
    path.write_text(json.dumps(small_cases.case(**parts)))
    return resolved_case.read(path)


def drop(folder, dimensions, perturbation, spacing=0.1):
    y = 0.0 if dimensions == 2 else 2.0
    sides = small_cases.boundaries()
    body = {"shape": "sphere", "material": "oil", "state": "liquid", "center": [0.0, 0.0, 0.0], "radius": 1.0,
            "perturbation": perturbation}
    return read(folder, dimensions=dimensions, spacing=spacing, physics=["flow", "surface_tension"], materials=LIQUIDS,
                surrounding=WATER, domain={"lower": [-2.0, -y, -2.0], "upper": [2.0, y, 2.0], "boundaries": sides},
                bodies=[body], time={"end": 1.0, "output_interval": 1.0})


@pytest.mark.parametrize("dimensions", [2, 3])
def test_cells_cut_by_a_drop_one_percent_out_of_round_have_their_share_of_it(dimensions, tmp_path):
    case = drop(tmp_path, dimensions, {"mode": 2, "amplitude": 0.01}, spacing=0.1 if dimensions == 2 else 0.2)
    grid = make_grid(case, top_of_bodies(case))
    share = volume_fractions(case, grid)
    cut = np.flatnonzero((share > 0) & (share < 1))[::1 if dimensions == 2 else 7]
    assert len(cut) > 30
    points = 200 if dimensions == 2 else 60
    inside = (np.arange(points) + 0.5)/points - 0.5
    for cell, centre in zip(cut, grid.cell_centres()[cut]):
        offsets = np.meshgrid(inside, [0.0] if dimensions == 2 else inside, inside)
        x, y, z = (part + case.spacing*offset for part, offset in zip(centre, offsets))
        radius = np.sqrt(x**2 + y**2 + z**2)
        cosine = z/radius
        shape = 2*cosine**2 - 1 if dimensions == 2 else 1.5*cosine**2 - 0.5      # cos 2 theta, P_2
        assert share[cell] == pytest.approx((radius < 1 + 0.01*shape).mean(), abs=2e-3)


def test_a_wave_of_a_twentieth_of_a_cell_is_there_in_every_column(tmp_path):
    box = {"shape": "box", "material": "oil", "state": "liquid", "lower": [0.0, 0.0, -1.0], "upper": [1.0, 0.0, 0.0],
           "surface_wave": {"amplitude": 0.0025, "wavelength": 1.0}}
    case = read(tmp_path, dimensions=2, spacing=0.05, physics=["flow", "surface_tension"], materials=LIQUIDS, surrounding=WATER,
                domain={"lower": [0.0, 0.0, -1.0], "upper": [1.0, 0.0, 0.5], "boundaries": small_cases.boundaries()},
                bodies=[box], time={"end": 1.0, "output_interval": 1.0})
    grid = make_grid(case, top_of_bodies(case))
    columns = volume_fractions(case, grid).reshape(grid.shape[2], grid.shape[0])
    heights = (columns*np.diff(grid.z)[:, None]).sum(axis=0) - 1.0
    edges = 2*np.pi*grid.x
    exact = 0.0025*np.diff(np.sin(edges))/np.diff(edges)      # means over the columns
    assert np.abs(heights - exact).max() < 1e-3*0.0025


def test_cells_in_many_pieces_have_the_same_share_of_bodies_that_lie_in_some_of_them(tmp_path, monkeypatch):
    grains = [{"shape": "sphere", "material": "oil", "state": "liquid", "center": [x, 2.0, x], "radius": 0.4} for x in (1.0, 3.0)]
    case = read(tmp_path, dimensions=3, spacing=0.2, physics=["flow", "surface_tension"], materials=LIQUIDS, surrounding=WATER,
                domain={"lower": [0.0, 0.0, 0.0], "upper": [4.0, 4.0, 4.0], "boundaries": small_cases.boundaries()},
                bodies=grains, time={"end": 1.0, "output_interval": 1.0})
    grid = make_grid(case, top_of_bodies(case))
    whole = volume_fractions(case, grid)
    assert (whole*grid.cell_volumes()).sum() == pytest.approx(2*4/3*np.pi*0.4**3, rel=5e-3)
    monkeypatch.setattr("reference_openfoam.volume_fractions.CHUNK", 16)
    assert volume_fractions(case, grid) == pytest.approx(whole, abs=1e-14)


def test_start_velocity_and_moving_wall_are_written(tmp_path):
    sides = small_cases.boundaries(z_max={"kind": "wall", "slip": "no_slip", "velocity": [3.0, 0.0, 0.0], "temperature": None})
    box = {"shape": "box", "material": "oil", "state": "liquid", "lower": [0.0, 0.0, 0.0], "upper": [1.0, 0.0, 1.0]}
    case = read(tmp_path, dimensions=2, spacing=0.25, physics=["flow"], materials=LIQUIDS, bodies=[box],
                domain={"lower": [0.0, 0.0, 0.0], "upper": [1.0, 0.0, 1.0], "boundaries": sides},
                initial={"temperature": 300.0, "temperature_gradient": [0.0, 0.0, 0.0],
                         "velocity": {"field": "taylor_green", "speed": 2.0, "wavelength": 1.0}},
                time={"end": 1.0, "output_interval": 1.0})
    velocity = case_writer.start_velocity(case, np.array([[0.25, 0.0, 0.0], [0.0, 0.0, 0.25], [0.125, 0.0, 0.125]]))
    assert velocity == pytest.approx(np.array([[2.0, 0, 0], [0, 0, -2.0], [1.0, 0, -1.0]]), abs=1e-12)
    case_writer.write_case(case, tmp_path/"case")
    text = (tmp_path/"case"/"0"/"U").read_text()
    assert "List<vector> 16" in text
    assert "uniform (3.0 0.0 0.0)" in text[text.index("z_max"):]
    assert "noSlip" in text[text.index("z_min"):text.index("z_max")]


def test_temperatures_of_hot_spot_and_bodies(tmp_path):
    lower, upper = [0.0, 0.0, 0.0], [1e-3, 0.0, 1e-3]
    boxes = [{"shape": "box", "material": "steel", "state": "solid", "lower": lower, "upper": upper},
             {"shape": "box", "material": "steel", "state": "solid", "lower": lower, "upper": [5e-4, 0.0, 5e-4], "temperature": 900.0}]
    case = read(tmp_path, dimensions=2, spacing=1e-4, physics=["heat"], materials={"steel": small_cases.STEEL}, bodies=boxes,
                domain={"lower": lower, "upper": upper, "boundaries": small_cases.boundaries()},
                initial={"temperature": 300.0, "temperature_gradient": [0.0, 0.0, 1e5],
                         "hot_spot": {"center": [8e-4, 0.0, 0.0], "radius": 1e-4, "rise": 50.0}},
                time={"end": 1.0, "output_interval": 1.0})
    places = np.array([[1e-4, 0.0, 1e-4], [8e-4, 0.0, 6e-4], [7e-4, 0.0, 6e-4]])
    assert case_writer.start_temperature(case, places) == pytest.approx([900.0, 410.0, 360.0 + 50*np.exp(-2)])


def test_a_solid_at_its_melting_point_starts_at_the_lower_end_of_the_narrow_range(tmp_path):
    one_point = small_cases.STEEL | {"solidus": 1723.0, "liquidus": 1723.0}
    lower, upper = [0.0, 0.0, 0.0], [1e-3, 0.0, 1e-3]
    for state, end in (("solid", -0.05), ("liquid", 0.05)):
        box = {"shape": "box", "material": "steel", "state": state, "lower": lower, "upper": upper}
        case = read(tmp_path, dimensions=2, spacing=1e-4, physics=["heat", "melting"], materials={"steel": one_point}, bodies=[box],
                    domain={"lower": lower, "upper": upper, "boundaries": small_cases.boundaries()},
                    initial={"temperature": 1723.0, "temperature_gradient": [0.0, 0.0, 0.0]},
                    time={"end": 1.0, "output_interval": 1.0})
        assert case_writer.start_temperature(case, np.array([[5e-4, 0.0, 5e-4]])) == pytest.approx(1723.0 + end, abs=1e-9)


@pytest.mark.parametrize("dimensions, exact", [(2, np.pi*0.1), (3, 4*np.pi/3)])
def test_a_drop_of_five_cells_a_radius_has_its_volume_and_quiet_columns(dimensions, exact, tmp_path):
    # fractions that are 0.001 of a cell off put the curvature of a drop of five cells a radius 0.5 % off, and shake it
    spacing = 0.2
    case = drop(tmp_path, dimensions, None, spacing)
    grid = make_grid(case, top_of_bodies(case))
    share = volume_fractions(case, grid)
    volumes = grid.cell_volumes()/(1 if dimensions == 3 else spacing/0.1)         # the plane's one cell as thick as 0.1
    assert (share*volumes).sum() == pytest.approx(exact, rel=2e-6)
    points = (np.arange(20000) + 0.5)/20000*spacing                               # of the column from x = 0 on, upper half
    column = share.reshape(grid.shape[2], grid.shape[1], grid.shape[0])[grid.shape[2]//2:, grid.shape[1]//2, grid.shape[0]//2].sum()*spacing
    if dimensions == 2:
        assert column == pytest.approx(np.sqrt(1 - points**2).mean(), rel=1e-5)
