"""What case files may ask for is what is measured, and every reference that they leave to the measure can be worked out."""

import json
import math
import subprocess

import pytest
from cupel.cases import case_names, find_case, members
from cupel.layout import PROGRAMS
from cupel.measures import known_measures
from cupel.measures.registry import find_measure


def declared_names(schema) -> set[str]:
    """The choices of measure.name in the schema of case files."""
    return set(schema["properties"]["measure"]["items"]["properties"]["name"]["anyOf"][0]["enum"])


def test_case_files_may_name_every_measure_and_no_other():
    done = subprocess.run([PROGRAMS / "cupel_case", "schema"], capture_output=True, text=True, check=True)
    assert declared_names(json.loads(done.stdout)) == set(known_measures())


@pytest.mark.parametrize("case", case_names())
def test_every_reference_of_the_suite_is_given_or_computed_in_the_declared_unit(case):
    asked = 0
    for member in members(find_case(case)):
        for request in member.resolve(member.levels[0])["measures"]:
            measure, reference = find_measure(request["name"]), request["reference"] or {}
            assert request["unit"].replace("^", "") == measure.unit.replace("^", ""), request["name"]
            if reference.get("kind") in ("exact", "tabulated"):
                value = reference["value"] if reference["value"] is not None else measure.exact(member.resolve(member.levels[0]))
                assert math.isfinite(value), (member.name, request["name"])
                asked += 1
    assert asked or case.startswith("slm_track"), f"{case} has no exact or tabulated reference"
