"""The writer: resolved case in, OpenFOAM case out. No solver is run here."""

from __future__ import annotations

import json

import numpy as np
import pytest

from reference_openfoam import blocks, case_folder, case_writer, convert, foam_files, grid as grids, mesh_files, resolved_case
from reference_openfoam.errors import Refused
from reference_openfoam.volume_fractions import volume_fractions
from tests.reference_openfoam import small_cases


def read(data, folder):
    path = folder/"resolved.json"
    path.write_text(json.dumps(data))
    return resolved_case.read(path)


def drop(spacing=1.25e-4):
    return small_cases.case(
        spacing=spacing, physics=["flow", "surface_tension", "wetting"],
        materials={"oil": {"density": 900.0, "viscosity": 0.05, "surface_tension": 0.05, "contact_angle": 0.785},
                   "water": {"density": 1000.0, "viscosity": 1e-3}},
        surrounding={"material": "water", "resolved": True, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0},
        domain={"lower": [-2e-3, -2e-3, 0.0], "upper": [2e-3, 2e-3, 3e-3], "boundaries": small_cases.boundaries()},
        bodies=[{"shape": "sphere", "material": "oil", "state": "liquid", "center": [0.0, 0.0, 1.5e-3], "radius": 1e-3}],
        time={"end": 1e-3, "output_interval": 1e-3})


def test_a_sphere_of_sixteen_cells_across_has_its_volume_to_one_in_two_thousand(tmp_path):
    case = read(drop(), tmp_path)
    grid = grids.make_grid(case, 2.5e-3)
    volume = (volume_fractions(case, grid)*grid.cell_volumes()).sum()
    assert volume == pytest.approx(4/3*np.pi*1e-9, rel=5e-4)


def test_a_box_off_the_grid_lines_has_its_exact_volume(tmp_path):
    data = drop()
    data["bodies"] = [{"shape": "box", "material": "oil", "state": "liquid",
                       "lower": [-1e-3, -7.7e-4, 0.0], "upper": [3.3e-4, 1e-3, 4.4e-4]}]
    case = read(data, tmp_path)
    grid = grids.make_grid(case, 1e-3)
    assert (volume_fractions(case, grid)*grid.cell_volumes()).sum() == pytest.approx(1.33e-3*1.77e-3*4.4e-4, rel=1e-12)


def test_a_later_body_of_the_surrounding_clears_an_earlier_one(tmp_path):
    data = drop()
    data["bodies"] = [{"shape": "box", "material": "oil", "state": "liquid", "lower": [-2e-3, -2e-3, 0.0], "upper": [2e-3, 2e-3, 3e-3]},
                      {"shape": "sphere", "material": "water", "state": "liquid", "center": [0.0, 0.0, 1.5e-3], "radius": 1e-3}]
    case = read(data, tmp_path)
    grid = grids.make_grid(case, 3e-3)
    empty = ((1 - volume_fractions(case, grid))*grid.cell_volumes()).sum()
    assert empty == pytest.approx(4/3*np.pi*1e-9, rel=5e-4)


def test_overlapping_spheres_are_counted_once(tmp_path):
    data = drop()
    data["bodies"] *= 2
    case = read(data, tmp_path)
    grid = grids.make_grid(case, 2.5e-3)
    assert (volume_fractions(case, grid)*grid.cell_volumes()).sum() == pytest.approx(4/3*np.pi*1e-9, rel=5e-4)


def test_cells_widen_outside_the_corridor_and_fill_the_length():
    lines = grids.widening_lines(-3.6e-4, 3.6e-4, -1.6e-4, 1.6e-4, 2e-5)
    widths = np.diff(lines)
    assert lines[0] == -3.6e-4 and lines[-1] == pytest.approx(3.6e-4, rel=1e-12)
    inside = (lines[:-1] > -1.61e-4) & (lines[1:] < 1.61e-4)
    assert np.allclose(widths[inside], 2e-5)
    assert np.all(widths > 1.99e-5) and np.max(widths[1:]/widths[:-1]) < 1.4      # no step that would spoil the gradients
    assert len(widths) < 36


def test_a_part_too_short_to_widen_stays_uniform():
    assert np.allclose(np.diff(grids.widening_lines(0.0, 1.0, 0.0, 0.9, 0.05)), 0.05)


def test_every_internal_face_joins_neighbours_in_upper_triangular_order():
    grid = grids.Grid(np.linspace(0, 1, 4), np.linspace(0, 1, 3), np.linspace(0, 1, 5), False)
    faces, owner, neighbour = mesh_files.internal_faces(grid)
    assert len(faces) == 2*2*4 + 3*1*4 + 3*2*3
    assert np.all(owner < neighbour)
    assert np.all(np.diff(owner*1000 + neighbour) > 0)
    # normals by the corner rule point from owner to neighbour
    points, centres = grid.points(), grid.cell_centres()
    a, b, c = (points[faces[:, column]] for column in (0, 1, 2))
    assert np.all(np.einsum("ij,ij->i", np.cross(b - a, c - b), centres[neighbour] - centres[owner]) > 0)


@pytest.mark.parametrize("side", resolved_case.SIDES)
def test_faces_of_each_side_point_outward(side):
    grid = grids.Grid(np.linspace(0, 1, 4), np.linspace(0, 1, 3), np.linspace(0, 1, 5), False)
    faces, points = mesh_files._side_faces(grid, side, grid.side_cells(side)), grid.points()
    a, b, c = (points[faces[:, column]] for column in (0, 1, 2))
    outward = points[faces].mean(axis=1) - grid.cell_centres()[grid.side_cells(side)]
    assert np.all(np.einsum("ij,ij->i", np.cross(b - a, c - b), outward) > 0)


def test_only_the_fields_that_the_physics_need_are_written(tmp_path):
    case_writer.write_case(read(drop(), tmp_path), tmp_path/"foam")
    assert sorted(path.name for path in (tmp_path/"foam"/"0").iterdir()) == ["U", "fraction", "p_rgh"]
    assert "laser" not in (tmp_path/"foam"/"constant"/"cupelProperties").read_text().replace("(laser", "")


def test_a_frozen_temperature_is_linear_up_to_the_walls(tmp_path):
    data = small_cases.case(
        spacing=1e-4, dimensions=2, physics=["flow", "gravity", "marangoni"], gravity=[0.0, 0.0, -9.81],
        materials={"liquid": {"density": 1000.0, "viscosity": 0.01, "surface_tension_slope": -1e-4},
                   "gas": {"density": 1.0, "viscosity": 1e-5}},
        surrounding={"material": "gas", "resolved": False, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0},
        domain={"lower": [0.0, 0.0, 0.0], "upper": [1e-3, 0.0, 5e-4],
                "boundaries": {side: small_cases.WALL for side in ("x_min", "x_max", "z_min", "z_max")}},
        initial={"temperature": 300.0, "temperature_gradient": [1000.0, 0.0, 0.0]},
        bodies=[{"shape": "box", "material": "liquid", "state": "liquid", "lower": [0.0, 0.0, 0.0], "upper": [1e-3, 0.0, 3e-4]}],
        time={"end": 1e-3, "output_interval": 1e-3})
    case_writer.write_case(read(data, tmp_path), tmp_path/"foam")
    text = (tmp_path/"foam"/"0"/"T").read_text()
    values = foam_files.read_field(tmp_path/"foam"/"0"/"T", 50)
    assert np.allclose(values.reshape(5, 10), 300 + 1000*(np.arange(10) + 0.5)*1e-4)
    assert "301.0" in text.split("x_max")[1].split("}")[0]      # 300 K + 1000 K/m over 1 mm, at the wall itself


def test_one_melting_point_gets_a_narrow_range_around_it(tmp_path):
    data = small_cases.grain_on_plate()
    data["materials"]["steel"] |= {"solidus": 1723.0, "liquidus": 1723.0}
    entries = case_writer._primary_entries(read(data, tmp_path))
    assert (entries["solidus"], entries["liquidus"]) == (1722.95, 1723.05)


def test_binary_and_ascii_fields_are_read_alike_and_short_ones_refused(tmp_path):
    values = np.linspace(1.0, 2.0, 7)
    text = b"FoamFile { format %s; }\ninternalField   nonuniform List<scalar> \n7\n("
    (tmp_path/"binary").write_bytes(text % b"binary" + values.tobytes() + b");\n")
    (tmp_path/"ascii").write_bytes(text % b"ascii" + " ".join(map(repr, values.tolist())).encode() + b");\n")
    (tmp_path/"short").write_bytes(text % b"binary" + values.tobytes()[:-9])
    assert np.array_equal(foam_files.read_field(tmp_path/"binary", 7), values)
    assert np.array_equal(foam_files.read_field(tmp_path/"ascii", 7), values)
    with pytest.raises(Refused, match="cut short"):
        foam_files.read_field(tmp_path/"short", 7)


def test_snapshots_are_multiples_of_the_interval_and_the_end(tmp_path):
    case = read(drop() | {"time": {"end": 1.05e-3, "output_interval": 1e-4}}, tmp_path)
    assert [convert.snapshot_index(case, time) for time in (0.0, 1e-4, 3.00000001e-4, 1e-3, 1.05e-3)] == [0, 1, 3, 10, 11]
    assert convert.snapshot_index(case, 3.4e-4) is None


@pytest.mark.parametrize("change, message", [
    ({"spacing": -1.0}, "spacing: must be a number above 0"),
    ({"physics": ["flow", "magnetism"]}, "no model 'magnetism'"),
    ({"dimensions": 4}, "dimensions: must be 2 or 3"),
    ({"materials": {"oil": {"density": -900.0, "viscosity": 1.0, "surface_tension": 1.0, "contact_angle": 1.0},
                    "water": {"density": 1.0, "viscosity": 1.0}}}, "materials.oil.density: must be a number above 0"),
    ({"materials": {"oil": {"density": 900.0, "surface_tension": 1.0, "contact_angle": 1.0},
                    "water": {"density": 1.0, "viscosity": 1.0}}}, "materials.oil.viscosity: is missing"),
    ({"bodies": []}, "no body"),
    ({"bodies": [{"shape": "cone", "material": "oil", "state": "liquid"}]}, "not 'cone'"),
    ({"bodies": [{"shape": "powder_bed", "material": "oil", "state": "liquid", "file": "/nowhere/bed.csv"}]}, "make it with: ./cupel bed"),
])
def test_what_cannot_be_run_is_refused_in_one_line_that_names_the_key(tmp_path, change, message):
    with pytest.raises(Refused) as refusal:
        read(drop() | change, tmp_path)
    assert message in str(refusal.value) and "\n" not in str(refusal.value)


def test_a_damaged_checkpoint_is_refused_and_a_half_written_one_passed_over(tmp_path):
    written = case_folder.CaseFolder(tmp_path, grids.Grid(*3*[np.linspace(0, 1, 2)], False), (1, 1, 1))
    for name, text in (("0.1", "good"), ("0.2", "good")):
        (tmp_path/name).mkdir()
        (tmp_path/name/"U").write_text(text)
        (tmp_path/name/"complete").write_text("4 U\n")
    (tmp_path/"0.3").mkdir()
    (tmp_path/"0.3"/"U").write_text("go")
    assert written.newest() == (0.2, "0.2") and not (tmp_path/"0.3").exists()
    (tmp_path/"0.2"/"U").write_text("go")
    with pytest.raises(Refused, match="truncated or damaged"):
        written.newest()


def test_a_parallel_checkpoint_counts_only_when_every_rank_has_marked_it(tmp_path):
    written = case_folder.CaseFolder(tmp_path, grids.Grid(*3*[np.linspace(0, 1, 3)], False), (2, 1, 1))
    for rank, names in ((0, ("0.1", "0.2")), (1, ("0.1",))):
        for name in ("0.1", "0.2"):
            (tmp_path/f"processor{rank}"/name).mkdir(parents=True)
        for name in names:
            (tmp_path/f"processor{rank}"/name/"complete").write_text("")
    assert written.newest() == (0.1, "0.1")
    assert sorted(path.name for path in (tmp_path/"processor0").iterdir()) == ["0.1"]


@pytest.mark.parametrize("counts", [(2, 1, 1), (1, 2, 1), (2, 3, 1), (1, 1, 4)])
def test_blocks_cover_the_grid_once_and_meet_in_the_same_faces(counts):
    grid = grids.Grid(np.linspace(0, 1, 6), np.linspace(0, 1, 8), np.linspace(0, 1, 5), False)
    parts = blocks.divide(grid, counts)
    values, covered = np.arange(grid.cell_count), np.zeros(grid.shape[::-1], dtype=int)
    for rank, block in enumerate(parts):
        covered[block.place] += 1
        assert block.rank == rank and np.allclose(block.part(grid.cell_centres(), grid), block.cell_centres())
        for side, other in block.neighbours:
            opposite = side[:2] + ("min" if side.endswith("max") else "max")
            assert (opposite, rank) in parts[other].neighbours
            axis, mine, theirs = "xyz".index(side[0]), block.cell_centres(), parts[other].cell_centres()
            mine, theirs = mine[block.side_cells(side)], theirs[parts[other].side_cells(opposite)]
            assert np.allclose(np.delete(mine, axis, 1), np.delete(theirs, axis, 1))
    assert np.all(covered == 1)
    assert np.array_equal(np.sort(np.concatenate([block.part(values, grid) for block in parts])), values)


def test_a_small_case_or_one_with_periodic_sides_is_not_divided(tmp_path):
    case = read(small_cases.grain_on_plate(), tmp_path)
    grid = grids.make_grid(case, 6e-5)
    assert blocks.block_counts(case, grid, 2) in ((2, 1, 1), (1, 2, 1)) and blocks.block_counts(case, grid, 64) != (1, 1, 1)
    assert np.prod(blocks.block_counts(case, grid, 64)) <= grid.cell_count/blocks.FEWEST_CELLS
    periodic = {"kind": "periodic", "temperature": None}
    sides = small_cases.boundaries(x_min=periodic, x_max=periodic, y_min=periodic, y_max=periodic)
    data = small_cases.grain_on_plate()
    data["domain"]["boundaries"] = sides
    assert blocks.block_counts(read(data, tmp_path), grid, 2) == (1, 1, 1)
