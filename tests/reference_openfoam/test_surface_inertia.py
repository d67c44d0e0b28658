"""Inertia of the last half cells below a surface, alone: planes at a known place in their cell, in a known acceleration."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest

from reference_openfoam import supervision
from tests.reference_openfoam import small_cases

LIQUID, GAS = 7.0, 0.5          # densities, which nothing of the formulae makes alike
CELLS, SPACING = 4, 0.25


class Faces(NamedTuple):
    """Centres and normals (n, 3), areas (n,), what is taken off each face's inertia [kg/m^3] and carried by the faces across [N]."""

    centre: np.ndarray
    normal: np.ndarray
    area: np.ndarray
    excess: np.ndarray
    carried: np.ndarray
    boundary: np.ndarray


def faces_of(bodies, folder, uniform=(0, 0, 0), below=(0, 0, 0), above=(0, 0, 0), level=0.0):
    """Faces of a cube of four cells a side with `bodies` in it, accelerated as surface_inertia_of_faces.cpp says."""
    data = small_cases.case(
        spacing=SPACING, physics=["flow", "surface_tension"],
        materials={"liquid": {"density": LIQUID, "viscosity": 0.1, "surface_tension": 1.0}, "gas": {"density": GAS, "viscosity": 0.01}},
        surrounding={"material": "gas", "resolved": True, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0},
        domain={"lower": [0.0, 0.0, 0.0], "upper": [1.0, 1.0, 1.0], "boundaries": small_cases.boundaries()},
        bodies=bodies, time={"end": 1.0, "output_interval": 1.0})
    (folder/"resolved.json").write_text(json.dumps(data))
    place = folder/"case"
    subprocess.run([sys.executable, "-m", "reference_openfoam", "write", str(folder/"resolved.json"), "--output", str(place)],
                   env=os.environ | {"PYTHONPATH": str(small_cases.ROOT)}, check=True, timeout=60)
    entries = {"uniform": uniform, "below": below, "above": above}
    (place/"constant"/"acceleration").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object acceleration; }\n"
        + "".join(f"{name} ({' '.join(map(repr, value))});\n" for name, value in entries.items()) + f"level {level!r};\n")
    printed = subprocess.run([str(supervision.solver_program().with_name("cupel_surface_inertia")), "-case", str(place)],
                             env=supervision.environment(), capture_output=True, text=True, check=True, timeout=60).stdout
    rows = np.array([line.split()[1:] for line in printed.splitlines() if line.startswith("face ")], dtype=float)
    assert len(rows) == 3*CELLS**2*(CELLS + 1)
    return Faces(rows[:, :3], rows[:, 3:6], *rows[:, 6:9].T, rows[:, 9] > 0)


def layer(axis, lower, upper):
    """Liquid between two planes across `axis`."""
    corners = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
    corners[0][axis], corners[1][axis] = lower, upper
    return [{"shape": "box", "material": "liquid", "state": "liquid", "lower": corners[0], "upper": corners[1]}]


def linear(axis, slope):
    """Rates of change along one axis."""
    return tuple(slope*float(k == axis) for k in range(3))


def taken_off(faces, axis, acceleration):
    """What the faces across `axis` lose of mass times acceleration, along it, by area [N/m^2], all that are accelerated by
    `acceleration` (n,) [m/s^2]; it must be nothing where they are of a boundary."""
    across = np.abs(faces.normal[:, axis]) > 0.5
    loss = (faces.excess*acceleration - faces.carried/faces.area*faces.normal[:, axis])[across]
    assert np.all(loss[faces.boundary[across]] == 0)
    return loss, faces.centre[across, axis]


@pytest.mark.parametrize("axis", [0, 2])
@pytest.mark.parametrize("liquid_below", [True, False])
@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.85])
def test_a_column_below_a_plane_surface_loses_what_means_of_cells_have_too_much(share, liquid_below, axis, tmp_path):
    # a = 2 + 3 x along the column: means of cells have rho a' D^2 (1/8 + s (1 - s)/2) too much by the liquid, s its share of the
    # surface's cell, and by the gas the same with the other sign, being on the other side
    top, rate = SPACING*(2 + share), 3.0
    bodies = layer(axis, 0.0, top) if liquid_below else layer(axis, 1.0 - top, 1.0)
    faces = faces_of(bodies, tmp_path, uniform=linear(axis, 2.0), below=linear(axis, rate), above=linear(axis, rate))
    loss, _ = taken_off(faces, axis, 2.0 + rate*faces.centre[:, axis])
    expected = (LIQUID - GAS)*rate*SPACING**2*(1/8 + share*(1 - share)/2)
    assert loss.sum()*SPACING/CELLS**2 == pytest.approx(expected if liquid_below else -expected, rel=1e-6)


@pytest.mark.parametrize("liquid_below", [True, False])
def test_each_side_has_the_rate_of_its_own_column(liquid_below, tmp_path):
    # a surface on a face, 3 /s^2 below it and -1.25 /s^2 above: D/8 (rho a' of the lower side - rho a' of the upper), on that face alone
    below, above, (lower, upper) = 3.0, -1.25, (LIQUID, GAS) if liquid_below else (GAS, LIQUID)
    bodies = layer(2, 0.0, 0.5) if liquid_below else layer(2, 0.5, 1.0)
    faces = faces_of(bodies, tmp_path, uniform=linear(2, 2.0), below=linear(2, below), above=linear(2, above), level=0.5)
    height = faces.centre[:, 2] - 0.5
    loss, z = taken_off(faces, 2, 2.0 + np.where(height <= 0, below, above)*height)
    at_surface = np.abs(z - 0.5) < 1e-9
    assert loss[at_surface] == pytest.approx((lower*below - upper*above)*SPACING/8, rel=1e-9)
    assert np.abs(loss[~at_surface]).max() < 1e-12


def test_faces_of_a_drop_lose_nothing_at_rest_nor_where_all_is_accelerated_alike(tmp_path):
    drop = [{"shape": "sphere", "material": "liquid", "state": "liquid", "center": [0.47, 0.52, 0.55], "radius": 0.31}]
    (tmp_path/"rest").mkdir()
    at_rest = faces_of(drop, tmp_path/"rest")
    assert at_rest.excess.max() > 0.1*LIQUID and np.all(at_rest.carried == 0)
    falling = faces_of(drop, tmp_path, uniform=(1.0, -2.0, 5.0))
    for axis, acceleration in enumerate((1.0, -2.0, 5.0)):
        loss, _ = taken_off(falling, axis, acceleration)
        inside = loss[~falling.boundary[np.abs(falling.normal[:, axis]) > 0.5]]
        assert np.abs(inside).max() < 1e-12*LIQUID*abs(acceleration)         # it falls with its whole weight: momentum is kept


def test_a_layer_that_is_stretched_keeps_its_momentum(tmp_path):
    # both surfaces with three tenths of their cells: what one side loses the other has
    faces = faces_of(layer(2, 0.7*SPACING, 3.3*SPACING), tmp_path, below=linear(2, 3.0), above=linear(2, 3.0), level=0.5)
    loss, z = taken_off(faces, 2, 3.0*(faces.centre[:, 2] - 0.5))
    assert loss[z > 0.5].sum() > 0.1 and abs(loss.sum()) < 1e-9*np.abs(loss).sum()


def test_a_face_of_a_drop_keeps_half_of_its_mass_and_one_off_its_surface_all(tmp_path):
    faces = faces_of([{"shape": "sphere", "material": "liquid", "state": "liquid", "center": [0.47, 0.52, 0.55], "radius": 0.31}], tmp_path)
    distance = np.linalg.norm(faces.centre - (0.47, 0.52, 0.55), axis=1)
    assert np.all(faces.excess >= 0) and faces.excess.max() <= 0.5*0.5*(LIQUID + GAS)
    assert np.all(faces.excess[distance > 0.31 + 1.5*SPACING] == 0)
