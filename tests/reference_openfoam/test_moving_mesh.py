"""The mesh that follows the beam: what it takes of the base grid, what is conserved from one mesh to the next, and real runs."""

from __future__ import annotations

import signal

import numpy as np
import pytest

from reference_openfoam import case_folder, face_fields, moving_mesh, remap, resolved_case
from reference_openfoam.grid import Grid
from tests.reference_openfoam import small_cases
from tests.reference_openfoam.test_running import last_states, start


def passing_beam(**changes):
    """A strong and fast beam over a plate with a grain: 40 x 16 x 13 base cells, several meshes."""
    parts = dict(
        domain={"lower": [0.0, -1.6e-4, -1.2e-4], "upper": [8e-4, 1.6e-4, 1.4e-4],
                "boundaries": small_cases.boundaries(z_max=small_cases.OPEN)},
        bodies=[{"shape": "box", "material": "steel", "state": "solid", "lower": [0.0, -1.6e-4, -1.2e-4], "upper": [8e-4, 1.6e-4, 0.0]},
                {"shape": "sphere", "material": "steel", "state": "solid", "center": [3e-4, 1e-5, 3e-5], "radius": 3e-5}],
        laser={"power": 500.0, "speed": 2.0, "spot_radius": 8e-5, "absorptivity": 0.35, "start": 0.0,
               "path": {"from": [2e-4, 0.0], "to": [6e-4, 0.0]}},
        time={"end": 9e-5, "output_interval": 3e-5})
    return small_cases.grain_on_plate(**(parts | changes))


def grids():
    base = Grid(np.linspace(0, 2, 41), np.linspace(0, 1, 21), np.linspace(0, 1, 17), False)

    def fine(x, y, z):
        return Grid(*(moving_mesh.coarsened_lines(lines, *span) for lines, span in zip((base.x, base.y, base.z), (x, y, z))), False)

    return base, fine((0.2, 0.7), (0.4, 0.7), (0.3, 0.9)), fine((0.5, 1.1), (0.2, 0.8), (0.2, 1.0))


def test_lines_are_those_of_the_base_fine_in_the_window_and_widen_by_at_most_two():
    lines = np.linspace(0.0, 1.0, 101)
    taken = moving_mesh.coarsened_lines(lines, 0.3, 0.45)
    assert np.all(np.isin(taken, lines)) and taken[0] == 0 and taken[-1] == 1
    inside = (taken >= 0.299) & (taken <= 0.451)
    assert np.count_nonzero(inside) == 16
    widths = np.rint(np.diff(taken)*100)
    assert np.all(widths[1:] <= 2*widths[:-1]) and np.all(widths[:-1] <= 2*widths[1:])
    assert len(taken) < 45


@pytest.mark.parametrize("span", [(0.0, 1.0), (0.0, 0.01), (0.99, 1.0), (0.01, 0.98), (0.02, 0.97), (0.03, 0.96)])
def test_a_window_at_the_end_of_the_domain_is_covered_too(span):
    lines = np.linspace(0.0, 1.0, 101)
    taken = moving_mesh.coarsened_lines(lines, *span)
    assert np.all(np.diff(taken) > 0) and taken[0] == 0 and taken[-1] == 1


def test_volume_enthalpy_and_momentum_are_those_of_the_old_mesh():
    base, old, new = grids()
    random = np.random.default_rng(1)
    pattern = np.clip(random.normal(0.5, 0.6, base.shape[::-1]), 0, 1)
    overlap = remap.Overlap(base, old, new)
    volume_old, volume_new = (grid.cell_volumes().reshape(grid.shape[::-1]) for grid in (old, new))
    mean = overlap.gather_old(overlap.base_volume*pattern)/volume_old
    moved = random.random(mean.shape) < 0.3                          # material has gone and come there
    fields = {"fraction": np.where(moved, random.random(mean.shape), mean), "T": random.uniform(300, 3000, mean.shape),
              "U": random.normal(size=mean.shape + (3,)), "p_rgh": random.normal(size=mean.shape)}
    fields |= {"primary_enthalpy": 700*fields["T"] + 1e5, "peak_temperature": fields["T"] + 10}
    cells = remap.remap_cells(overlap, fields, pattern, (6900.0, 1.62), 520.0)
    alpha, after = fields["fraction"], cells["fraction"]
    assert (after*volume_new).sum() == pytest.approx((alpha*volume_old).sum(), rel=1e-13)
    enthalpy = alpha*6900*fields["primary_enthalpy"] + (1 - alpha)*1.62*520*fields["T"]
    assert (cells["volumetric_enthalpy"]*volume_new).sum() == pytest.approx((enthalpy*volume_old).sum(), rel=1e-13)
    density, density_after = (6900*share + 1.62*(1 - share) for share in (alpha, after))
    momentum = np.einsum("ijk,ijk,ijkl->l", density, volume_old, fields["U"])
    assert np.einsum("ijk,ijk,ijkl->l", density_after, volume_new, cells["U"]) == pytest.approx(momentum, rel=1e-10)
    assert after.min() >= 0 and after.max() <= 1 and cells["peak_temperature"].max() <= fields["peak_temperature"].max()


def test_bodies_that_the_window_reaches_are_as_sharp_as_at_the_start():
    base, old, new = grids()
    centres = base.cell_centres().reshape(base.shape[::-1] + (3,))
    pattern = (np.linalg.norm(centres - [1.0, 0.5, 0.6], axis=-1) < 0.2).astype(float)
    overlap = remap.Overlap(base, old, new)
    mean = overlap.gather_old(overlap.base_volume*pattern)/overlap.gather_old(overlap.base_volume)
    assert np.allclose(remap.base_fraction(overlap, mean, pattern), pattern, atol=1e-12)


def test_fluxes_without_divergence_have_none_on_the_next_mesh():
    base, old, new = grids()
    random = np.random.default_rng(2)
    nx, ny, nz = old.shape
    potential = [random.normal(size=(nz + 1, ny + 1, nx)), random.normal(size=(nz + 1, ny, nx + 1)), random.normal(size=(nz, ny + 1, nx + 1))]
    fluxes = (np.diff(potential[2], axis=1) - np.diff(potential[1], axis=0), np.diff(potential[0], axis=0) - np.diff(potential[2], axis=2),
              np.diff(potential[1], axis=2) - np.diff(potential[0], axis=1))          # the curl of edge values
    def divergence(parts):
        return sum(np.diff(part, axis=axis) for part, axis in zip(parts, (2, 1, 0)))
    assert np.abs(divergence(fluxes)).max() < 1e-12
    after = remap.remap_fluxes(old, new, fluxes)
    assert np.abs(divergence(after)).max() < 1e-12 and np.abs(after[0]).max() > 0.1
    for axis, name in enumerate("xyz"):                             # and what crosses a side of the domain is kept
        side = [slice(None)]*3
        side[2 - axis] = 0
        assert after[axis][tuple(side)].sum() == pytest.approx(fluxes[axis][tuple(side)].sum(), abs=1e-11)


@pytest.mark.parametrize("counts", [(1, 1, 1), (2, 1, 1), (1, 2, 1), (2, 2, 1)])
def test_fluxes_are_read_as_they_were_written(counts, tmp_path):
    grid = Grid(np.linspace(0, 1, 6), np.linspace(0, 1, 5), np.linspace(0, 1, 4), False)
    written = case_folder.CaseFolder(tmp_path, grid, counts)
    random = np.random.default_rng(3)
    fluxes = tuple(random.normal(size=part.shape) for part in face_fields.empty_fluxes(grid))
    patches = {side: "wall" for side in resolved_case.SIDES}
    for folder, block in written.parts():
        face_fields.write_fluxes(folder/"0"/"phi", block, patches, fluxes, grid)
        as_binary(folder/"0"/"phi")
    for ours, theirs in zip(face_fields.read_fluxes(written, "0", "phi"), fluxes):
        assert np.array_equal(ours, theirs)


def as_binary(path):
    """Turn the lists of a field file into binary ones, as the solver writes them."""
    text = path.read_bytes().replace(b"format ascii", b"format binary")
    pieces = text.split(b"nonuniform List<scalar> ")
    for index, piece in enumerate(pieces[1:], start=1):
        body, rest = piece.split(b")", 1)
        count, numbers = body.split(b"(")
        pieces[index] = count.strip() + b"\n(" + np.array(numbers.split(), dtype="<f8").tobytes() + b")" + rest
    path.write_bytes(b"nonuniform List<scalar> ".join(pieces))


@pytest.fixture(scope="module")
def followed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("followed")
    data = passing_beam()
    return data, folder, small_cases.completed(data, folder)


def test_a_following_mesh_heats_and_melts_as_a_static_one_and_keeps_its_ledgers(followed, tmp_path):
    data, folder, record = followed
    static = passing_beam(numerics={"openfoam": {"mesh": "static"}})
    other = small_cases.completed(static, tmp_path)
    mesh, = (folder/"result"/"checkpoints").glob("mesh_*")
    assert mesh.name >= "mesh_0003"                                 # 180 um of travel, some 40 um on one mesh
    assert record["cost"]["elements"] < other["cost"]["elements"]
    assert record["ledgers"]["energy"]["closure"] < 1e-6 and record["ledgers"]["volume"]["closure"] < 1e-10
    assert record["ledgers"]["energy"]["laser_absorbed"] == pytest.approx(other["ledgers"]["energy"]["laser_absorbed"], rel=1e-3)
    ours, theirs = small_cases.last_fields(data, folder)[0], small_cases.last_fields(static, tmp_path)[0]
    melted = [(fields["volume"]*fields["fraction"]*fields["liquid_fraction"]).sum() for fields in (ours, theirs)]
    assert theirs["liquid_fraction"][theirs["fraction"] > 0.5].max() == 1
    assert melted[0] == pytest.approx(melted[1], rel=0.02)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_run_interrupted_between_meshes_resumes_to_the_same_bits(threads, followed, tmp_path):
    data, whole, record = followed
    options = ("--threads", str(threads))
    if threads == 2:
        whole = tmp_path/"whole"
        whole.mkdir()
        record = small_cases.completed(data, whole, *options)
    process = start(data, tmp_path, *options)
    while not (tmp_path/"result"/"checkpoints"/"mesh_0001").exists() and process.poll() is None:
        pass
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    resumed = small_cases.completed(data, tmp_path, *options, "--resume")
    assert last_states(tmp_path) == last_states(whole)
    assert resumed["ledgers"] == record["ledgers"] and resumed["cost"]["steps"] == record["cost"]["steps"]
