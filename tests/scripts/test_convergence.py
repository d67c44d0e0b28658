"""Observed order, Richardson value and uncertainty: exact for made series, and honest where there is no order."""

from __future__ import annotations

import json
import math

import pytest
from cupel.convergence import Point, converge, lines_of, observed_order, order_of_error, study_of, write_convergence
from tests.scripts.made_results import made_result


def study(values, spacings=(0.25, 0.5, 1.0), uncertainty=None, reference=None):
    points = [Point(f"l{n}", spacing, value, uncertainty, None if reference is None else value - reference)
              for n, (spacing, value) in enumerate(zip(spacings, values))]
    return study_of("case", "sph", "width", "m", points, reference, reference is not None)


@pytest.mark.parametrize("spacings", [(1.0, 2.0, 4.0), (1.0, 1.5, 2.0), (1.0, 1.3, 2.6)])
@pytest.mark.parametrize("order", [0.7, 1.0, 1.5, 2.0, 3.1])
def test_a_power_law_gives_its_order_and_its_limit(order, spacings):
    found = study([5.0 + 0.1 * h**order for h in spacings], spacings, reference=5.0)
    assert found.kind == "monotone"
    assert found.order == pytest.approx(order, rel=1e-6) and found.richardson == pytest.approx(5.0, abs=1e-9)
    assert found.order_of_error == pytest.approx(order, rel=1e-9)
    fine = spacings[1] / spacings[0]
    used = min(order, 2.0)
    assert found.gci == pytest.approx(1.25 * abs(0.1 * (spacings[1]**order - spacings[0]**order)) / (fine**used - 1.0))


def test_the_published_example_of_celik():
    """Table 1, first column: N = 18000, 8000, 4500, reattachment length 6.063, 5.972, 5.863; p 1.53, extrapolated 6.1685, GCI 2.2 %."""
    found = study((6.063, 5.972, 5.863), (1.0, 1.5, 2.0))
    assert found.order == pytest.approx(1.53, abs=0.005)
    assert found.richardson == pytest.approx(6.1685, abs=5e-4)
    assert found.gci / 6.063 == pytest.approx(0.022, abs=5e-4)


def test_the_published_oscillatory_example_of_celik():
    """Table 1, third column: axial velocity 6.0042, 5.9624, 6.0909 at ratios 2.0 and 2.144; p 1.51, extrapolated 6.0269."""
    found = study((6.0042, 5.9624, 6.0909), (1.0, 2.0, 4.288))
    assert found.kind == "oscillatory"
    assert found.order == pytest.approx(1.51, abs=0.005) and found.richardson == pytest.approx(6.0269, abs=2e-4)
    assert found.gci == pytest.approx(0.5 * (6.0909 - 5.9624))      # half the range, more than its GCI of 0.5 %


def test_oscillating_values_are_not_surer_than_half_their_range():
    assert study((1.0, 1.001, 0.9)).gci == pytest.approx(0.5 * 0.101)


@pytest.mark.parametrize("values", [(1.0, 1.3, 1.4), (1.0, 1.3, 1.0), (1.0, 1.1, 1.2)])
def test_differences_that_do_not_shrink_have_no_order_and_an_uncertainty_of_their_range(values):
    found = study(values)
    assert found.kind == "diverging" and found.order is None and found.richardson is None
    assert found.gci == pytest.approx(1.25 * (max(values) - min(values)))


def test_the_same_value_at_every_level_is_constant():
    found = study((2.0, 2.0, 2.0))
    assert (found.kind, found.gci, found.order, found.richardson) == ("constant", 0.0, None, None)


def test_the_same_value_at_the_finest_two_has_no_order_but_an_uncertainty():
    found = study((2.0, 2.0, 2.3))
    assert found.order is None and found.gci == pytest.approx(1.25 * 0.3) and "no order" in found.note


def test_scatter_greater_than_the_last_difference_is_said():
    assert "scatter" in study((1.0, 1.01, 1.05), uncertainty=0.1).note
    assert study((1.0, 1.01, 1.05), uncertainty=1e-4).note == ""


def test_order_of_the_error_takes_all_levels_and_needs_all_errors():
    points = [Point("l", h, 0.0, None, -0.2 * h**1.5) for h in (1.0, 2.0, 3.0, 8.0)]
    assert order_of_error(points) == pytest.approx(1.5)
    assert order_of_error([*points, Point("l", 9.0, 0.0, None, None)]) is None


def test_no_order_from_differences_of_which_one_is_nothing():
    assert observed_order(0.1, 0.0, 2.0, 2.0) is None


@pytest.fixture
def results(tmp_path):
    """Three levels in both solvers: SPH tends to 1.00 with order 1, OpenFOAM to 1.01 with order 2."""
    for level, spacing in (("coarse", 4e-5), ("medium", 2e-5), ("fine", 1e-5)):
        made_result(tmp_path, "sph", level, spacing, 1.0 + 0.02 * spacing / 1e-5)
        made_result(tmp_path, "openfoam", level, spacing, 1.01 + 0.001 * (spacing / 1e-5)**2)
    return tmp_path


def test_a_case_is_studied_in_both_solvers_and_they_agree_within_their_uncertainties(results):
    found = converge(results, "made")
    orders = {each.solver: each.order for each in found.studies}
    assert orders == {"sph": pytest.approx(1.0), "openfoam": pytest.approx(2.0)}
    one, = found.agreements
    assert one.difference == pytest.approx(1.02 - 1.011)
    sph, foam = (next(each for each in found.studies if each.solver == solver) for solver in ("sph", "openfoam"))
    assert one.uncertainty == pytest.approx(math.hypot(sph.uncertainty, foam.uncertainty)) and one.agree
    assert sph.uncertainty == pytest.approx(1.25 * 0.02)


def test_solvers_that_are_farther_apart_than_that_differ(results):
    made_result(results, "sph", "fine", 1e-5, 1.3)
    made_result(results, "sph", "medium", 2e-5, 1.301)
    made_result(results, "sph", "coarse", 4e-5, 1.303)
    one, = converge(results, "made").agreements
    assert not one.agree and any(line.startswith("differ") and "+0.289" in line for line in lines_of(converge(results, "made")))


def test_convergence_is_data_beside_the_results(results):
    write_convergence(results, converge(results, "made"))
    data = json.loads((results / "made" / "convergence.json").read_text())
    assert {each["solver"] for each in data["studies"]} == {"sph", "openfoam"} and data["safety_factor"] == 1.25
    assert [point["level"] for point in data["studies"][0]["points"]] == ["fine", "medium", "coarse"]


def test_two_levels_are_too_few_and_that_is_said(tmp_path):
    for level, spacing in (("coarse", 4e-5), ("medium", 2e-5)):
        made_result(tmp_path, "sph", level, spacing, 1.0)
    found = converge(tmp_path, "made")
    assert not found.studies and "need 3 levels, there are 2 (coarse, medium)" in found.missing[0]
    write_convergence(tmp_path, found)
    assert not (tmp_path / "made" / "convergence.json").exists()


def test_levels_of_different_commits_are_said(results):
    made_result(results, "sph", "fine", 1e-5, 1.02, commit="fedcba987654")
    sph = next(each for each in converge(results, "made").studies if each.solver == "sph")
    assert "different commits" in sph.note


def test_a_failed_level_does_not_count(results):
    made_result(results, "sph", "fine", 1e-5, 1.02, status="stopped")
    assert {each.solver for each in converge(results, "made").studies} == {"openfoam"}
