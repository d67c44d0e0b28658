"""References that measures work out of the case are the published numbers, and the case reader knows which measures can."""

from __future__ import annotations

import math
import subprocess

import pytest

from cupel import cases
from cupel.layout import PROGRAMS
from cupel.measures.registry import find_measure, known_measures

MEMBERS = {member.name: member for name in cases.case_names() for member in cases.members(cases.find_case(name))}


def exact(member: str, measure: str) -> float:
    """The exact reference of a measure, worked out of the resolved case."""
    return find_measure(measure).exact(MEMBERS[member].resolve("coarse"))


@pytest.mark.parametrize(("member", "measure", "value", "within"), [
    ("droplet_wetting", "contact_angle", math.pi / 4, 1e-12),
    ("droplet_wetting", "base_radius", 1.8261e-3, 7e-4),   # of the whole sphere; the wall cuts 0.18 % of its volume off
    ("droplet_wetting", "apex_height", 0.7564e-3, 7e-4),
    ("marangoni_layer", "surface_speed", 0.01, 1e-12),
    ("marangoni_return_flow_re100", "surface_speed", 0.025, 1e-12),
    ("sessile_drop_free_30deg", "base_radius", 0.5 * math.sin(math.pi / 6) * math.sqrt(0.5 / (1 / 6 - math.sqrt(3) / 4 / math.pi)),
     1e-9),
    ("sessile_drop_two_phase_90deg", "base_radius", 0.5, 1e-12),
    ("moving_gaussian_source_100w", "melt_pool_width", 169.0e-6, 1e-3),
    ("moving_gaussian_source_150w", "melt_pool_depth", 79.5e-6, 1e-3),
    ("moving_gaussian_source_200w", "melt_pool_depth", 98.4e-6, 1e-3),
    ("taylor_green", "decay_rate", 2 * 0.78957, 1e-4),                  # of the energy
    ("static_drop_free_la120", "laplace_pressure", 2.0, 1e-12),
    ("static_drop_3d_two_phase_la12", "laplace_pressure", 4.0, 1e-12),
    ("oscillating_drop_2d_free", "oscillation_frequency", 2.42587, 1e-5),
    ("oscillating_drop_2d_free", "oscillation_decay", 0.177334, 1e-5),
    ("oscillating_drop_3d", "oscillation_period", 168.4e-6, 1e-3),
    ("stefan_dt100", "front_position", 0.1017e-3, 1e-4),
    ("stefan_dt300", "front_position", 0.1017e-3, 1e-4),
    ("stefan_dt1000", "front_position", 0.1017e-3, 1e-4),
    ("thermocapillary_drop_unbounded_box16", "drop_velocity", 1.3333e-3, 1e-4),
])
def test_reference_is_the_published_number(member, measure, value, within):
    assert exact(member, measure) == pytest.approx(value, rel=within)


@pytest.mark.parametrize("name", MEMBERS)
def test_every_reference_that_is_left_to_its_measure_can_be_worked_out(name):
    resolved = MEMBERS[name].resolve("coarse")
    for measure in resolved["measures"]:
        reference = measure["reference"]
        if reference["kind"] in ("exact", "tabulated") and reference["value"] is None:
            assert math.isfinite(find_measure(measure["name"]).exact(resolved)), measure["name"]


def declared_measures() -> dict[str, tuple[str, str]]:
    """Unit and own reference of each measure, as the case reader lists them."""
    text = subprocess.run([PROGRAMS / "cupel_case", "list-parameters"], capture_output=True, text=True, check=True).stdout
    rows = [line.split("|") for line in text[text.index("## Measures"):].splitlines() if line.startswith("| `")]
    return {row[1].strip(" `"): (row[2].strip(), row[3].strip()) for row in rows}


def test_every_registered_measure_is_declared_with_its_unit():
    declared = declared_measures()
    assert {name: declared.get(name, ("",))[0] for name in known_measures()} == {
        name: measure.unit for name, measure in known_measures().items()}


def test_measures_that_are_said_to_work_out_their_reference_do():
    for name, (_, own) in declared_measures().items():
        if name in known_measures():
            assert (find_measure(name).exact is None) == (own == "none"), name
