"""The references in the case files are what their reference.py computes, and the schema takes every case file."""

import importlib.util
import json
import subprocess
import tomllib
from math import radians
from pathlib import Path

import jsonschema
import pytest

from cupel.layout import PROGRAMS

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "validation_cases"


def reference_of(case: str):
    spec = importlib.util.spec_from_file_location(f"reference_of_{case}", CASES / case / "reference.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def declared_references(case: str) -> dict[str, str]:
    content = tomllib.loads((CASES / case / "case.toml").read_text())
    return {measure["name"]: measure["reference"]["value"] for measure in content["measure"]}


def test_droplet_ends_as_the_spherical_cap_of_its_volume():
    _, base_radius, apex_height = reference_of("droplet_wetting").spherical_cap(1.0, radians(45))
    declared = declared_references("droplet_wetting")
    assert declared["base_radius"] == f"{base_radius:.4f} mm"
    assert declared["apex_height"] == f"{apex_height:.4f} mm"


def test_return_flow_has_no_net_flux_and_the_declared_surface_speed():
    velocity = reference_of("marangoni_layer").velocity
    heights = [(index + 0.5) / 1000 for index in range(1000)]
    surface_speed = velocity(1.0, 0.4, 1e-3, 0.01)
    assert abs(sum(velocity(eta, 0.4, 1e-3, 0.01) for eta in heights)) / 1000 < 1e-6 * surface_speed
    assert declared_references("marangoni_layer")["surface_speed"] == f"{surface_speed:g} m/s"


@pytest.mark.parametrize("case", sorted([*CASES.glob("*/case.toml"), *CASES.glob("common/*.toml")]), ids=lambda path: path.parent.name)
def test_schema_takes_every_case_file(case):
    done = subprocess.run([PROGRAMS / "cupel_case", "schema"], capture_output=True, text=True, check=True)
    jsonschema.Draft202012Validator(json.loads(done.stdout)).validate(tomllib.loads(case.read_text()))


def test_schema_refuses_an_unknown_key():
    done = subprocess.run([PROGRAMS / "cupel_case", "schema"], capture_output=True, text=True, check=True)
    content = tomllib.loads((CASES / "droplet_wetting" / "case.toml").read_text())
    content["time"]["ende"] = "1 s"
    with pytest.raises(jsonschema.ValidationError, match="ende"):
        jsonschema.Draft202012Validator(json.loads(done.stdout)).validate(content)
