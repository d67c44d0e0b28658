"""Every case file of the suite: complete, described, and accepted by the reader and by the writer of the OpenFOAM reference.

What the SPH solver makes of them is in tests/sph_solver/scene.
"""

from __future__ import annotations

import json
import subprocess
import tomllib

import jsonschema
import numpy as np
import pytest

from cupel import cases
from cupel.layout import CASES, PROGRAMS, TIERS
from cupel.solvers import refusal
from reference_openfoam import case_writer, resolved_case
from reference_openfoam.errors import Refused
from reference_openfoam.grid import make_grid
from reference_openfoam.volume_fractions import top_of_bodies

NAMES = cases.case_names()
MEMBERS = [member for name in NAMES for member in cases.members(cases.find_case(name))]
MOST_CELLS = 30_000     # larger meshes are not written here: they take long and differ in little but their size


@pytest.fixture(scope="module")
def schema() -> jsonschema.Draft202012Validator:
    done = subprocess.run([PROGRAMS / "cupel_case", "schema"], capture_output=True, text=True, check=True)
    return jsonschema.Draft202012Validator(json.loads(done.stdout))


@pytest.mark.parametrize("case", sorted([*CASES.glob("*/case.toml"), *CASES.glob("common/*.toml")]), ids=lambda path: path.parent.name)
def test_schema_takes_every_case_file(schema, case):
    schema.validate(tomllib.loads(case.read_text()))


def test_schema_refuses_an_unknown_key(schema):
    content = tomllib.loads((CASES / "droplet_wetting" / "case.toml").read_text())
    content["time"]["ende"] = "1 s"
    with pytest.raises(jsonschema.ValidationError, match="ende"):
        schema.validate(content)


@pytest.mark.parametrize("name", NAMES)
def test_case_is_described_and_has_a_tier_and_three_levels(name):
    folder = CASES / name
    assert len((folder / "README.md").read_text()) > 200
    assert f"({name}/README.md)" in (CASES / "README.md").read_text(), "validation_cases/README.md does not list it"
    for member in cases.members(cases.find_case(name)):
        assert member.tier in TIERS
        assert {"coarse", "medium", "fine"} <= set(member.levels)


@pytest.mark.parametrize("name", [name for name in NAMES if not name.startswith("slm_track")])
def test_case_begins_with_its_dimensionless_groups(name):
    head = (CASES / name / "case.toml").read_text().split("\n\n")[0]
    assert "Groups" in head.split("title")[0]


def test_members_have_names_of_their_own():
    names = [member.name for member in MEMBERS]
    assert len(set(names)) == len(names)
    for name in names:
        assert [member.name for member in cases.find_members(name)] == [name] or name in NAMES


@pytest.mark.parametrize("member", MEMBERS, ids=lambda member: member.name)
def test_member_resolves_at_every_level_with_a_judged_measure(member):
    spacings, judged = [], False
    for level in member.levels:
        resolved = member.resolve(level)
        assert resolved["name"] == member.name and resolved["tier"] == member.tier
        spacings.append(resolved["spacing"])
        judged = judged or any(measure["tolerance"] is not None for measure in resolved["measures"])
        assert resolved["numerics"]["formulation"] == "default"
        allowed = {"position_jitter"} if member.variation and "jitter" in member.variation else set()
        assert {key for key, value in resolved["numerics"].items() if value != DEFAULT_NUMERICS.get(key)} <= allowed
    assert spacings == sorted(spacings, reverse=True) and len(set(spacings)) == len(spacings)
    assert judged or member.name.startswith("thermocapillary_drop_unbounded")     # judged together, in the largest box


DEFAULT_NUMERICS = MEMBERS[0].resolve("coarse")["numerics"]


@pytest.mark.parametrize("member", MEMBERS, ids=lambda member: member.name)
def test_openfoam_writer_takes_it(member, tmp_path):
    for level in member.levels:
        file = tmp_path / f"{level}.json"
        resolved = member.resolve(level)
        file.write_text(json.dumps(resolved))
        if refusal("openfoam", resolved):
            with pytest.raises(Refused, match="domain.round_walls.*run the case in SPH"):
                resolved_case.read(file)
            continue
        case = resolved_case.read(file)
        grid = make_grid(case, top_of_bodies(case))
        assert grid.cell_count > 100
        if level == "coarse" and grid.cell_count < MOST_CELLS:
            case_writer.write_case(case, tmp_path / level, grid=grid)
            assert (tmp_path / level / "0" / "fraction").stat().st_size > 1000


def test_sweeps_vary_what_their_names_say():
    angles = {member.variation: member.resolve("coarse")["materials"]["liquid"]["contact_angle"]
              for member in cases.members(cases.find_case("sessile_drop"))}
    assert len(angles) == 18
    for variation, angle in angles.items():
        assert np.degrees(angle) == pytest.approx(float(variation.split("_")[-1].removesuffix("deg")))
    for member in cases.members(cases.find_case("sessile_drop_round_wall")):
        mode, wall, angle = member.variation.replace("two_phase", "two-phase").split("_")
        resolved = member.resolve("coarse")
        assert np.degrees(resolved["materials"]["liquid"]["contact_angle"]) == pytest.approx(float(angle.removesuffix("deg")))
        assert resolved["surrounding"]["resolved"] == (mode == "two-phase")
        assert ("inner_radius" in resolved["domain"]["round_walls"]) == (wall == "cylinder")
    for name in ("static_drop", "static_drop_3d"):
        for member in cases.members(cases.find_case(name)):
            resolved = member.resolve("coarse")
            liquid = resolved["materials"]["liquid"]
            laplace = liquid["surface_tension"] * liquid["density"] * 2 * resolved["bodies"][0]["radius"] / liquid["viscosity"]**2
            wanted = 12000 if member.variation == "air_water" else float(member.variation.removesuffix("_jitter").split("la")[-1])
            assert laplace == pytest.approx(wanted, rel=1e-3), member.name
            assert resolved["surrounding"]["resolved"] == (not member.variation.startswith("free"))
            assert resolved["dimensions"] == (3 if "3d" in name else 2)
