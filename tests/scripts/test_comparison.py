"""Who passes and who does not."""

from __future__ import annotations

import json
from xml.etree import ElementTree

import pytest
from cupel import comparison
from cupel.check import check_results, describe, junit_xml
from cupel.comparison import Row, judge, ledger_measures, power_trend_rows
from cupel.external import take_in
from cupel.errors import CupelError
from cupel.finish_result import finish
from cupel.layout import ResultPlace
from cupel.results import read_result, write_result
from tests import synthetic


def measure(**values) -> dict:
    return {"name": "melt_pool_width", "value": 1.0, "unit": "m", "uncertainty": None, "reference": 1.0, "reference_kind": "exact",
            "source": "", "metric": "relative", "tolerance": 0.1} | values


@pytest.mark.parametrize("values, error, passes", [
    ({"value": 1.09, "reference": 1.0}, 0.09, True), ({"value": 1.11}, 0.11, False), ({"value": 0.5, "reference": -1.0}, 1.5, False),
    ({"value": 0.15, "reference": 0.1, "metric": "absolute"}, 0.05, True),
    ({"value": 0.3, "reference": 0.1, "metric": "absolute"}, 0.2, False),
    ({"value": 1.05, "tolerance": None}, 0.05, None), ({"reference": None}, None, None), ({"value": None}, None, False),
    ({"value": float("nan")}, None, False), ({"value": float("inf")}, None, False), ({"reference": 0.0}, None, None)])
def test_judging(values, error, passes):
    judged = judge(measure(**values))
    assert judged["error"] == (None if error is None else pytest.approx(error))
    assert judged["pass"] is passes


def test_a_reference_that_could_not_measure_is_not_judged_but_others_fail():
    assert judge(measure(value=None, reference=None), is_reference=True)["pass"] is None
    assert judge(measure(value=None, reference=None))["pass"] is False


@pytest.fixture
def track(tmp_path):
    """Results of a track in both solvers, SPH wider by some percent; the references not yet filled in."""
    case = synthetic.resolved_track(150)
    for solver, bias in (("sph", 0.05), ("openfoam", 0.0)):
        synthetic.write_run(tmp_path / case["name"] / solver / "coarse", solver, case, bias)
        finish(tmp_path / case["name"] / solver / "coarse")
    return {solver: ResultPlace(tmp_path, case["name"], solver, "coarse") for solver in ("sph", "openfoam")}


def width(place: ResultPlace) -> dict:
    return next(m for m in read_result(place)["measures"] if m["name"] == "melt_pool_width")


def test_the_other_solver_becomes_the_reference(track):
    assert width(track["sph"])["reference"] is None
    comparison.fill_solver_references(track["sph"].root, "slm_track_150w", "coarse")
    sph, foam = width(track["sph"]), width(track["openfoam"])
    assert sph["reference"] == foam["value"] and sph["error"] == pytest.approx(sph["value"] / foam["value"] - 1)
    assert sph["pass"] is (abs(sph["error"]) <= 0.1)
    assert foam["reference"] is None and foam["pass"] is None


def test_a_stopped_reference_takes_its_value_away_again(track):
    root = track["sph"].root
    comparison.fill_solver_references(root, "slm_track_150w", "coarse")
    result = read_result(track["openfoam"])
    write_result(track["openfoam"].folder, result | {"status": "stopped", "diagnosis": "too hot"})
    comparison.fill_solver_references(root, "slm_track_150w", "coarse")
    assert width(track["sph"])["reference"] is None and width(track["sph"])["pass"] is None


def test_check_counts_a_missing_result_as_not_passed(track, tmp_path):
    status = check_results(track["sph"].root, ["slm_track_150w"], ("sph", "openfoam"), "fine", tmp_path / "check.xml")
    suite = ElementTree.parse(tmp_path / "check.xml").getroot().find("testsuite")
    assert status == 1 and suite.get("errors") == "2" and suite.get("failures") == "0"


def test_check_passes_only_if_every_row_does(track, tmp_path):
    def status() -> int:
        return check_results(track["sph"].root, ["slm_track_150w"], ("sph", "openfoam"), "coarse", tmp_path / "check.xml")

    assert status() == 0
    result = read_result(track["sph"])
    result["ledgers"]["energy"]["closure"] = 2e-3
    result["measures"] = [m for m in result["measures"] if "closure" not in m["name"] and "absorbed" not in m["name"]]
    result["measures"] += ledger_measures(result)
    write_result(track["sph"].folder, result)
    assert status() == 1
    failed = ElementTree.parse(tmp_path / "check.xml").getroot().findall(".//failure")
    assert len(failed) == 1 and "tolerance 0.001" in failed[0].get("message")


def test_the_limit_of_the_energy_ledger_is_tighter_for_the_reference():
    record = synthetic.run_record(synthetic.resolved_track(150), "openfoam") | {"measures": []}
    record["ledgers"]["energy"]["closure"] = 5e-5
    verdicts = {m["name"]: m["pass"] for m in ledger_measures(record)}
    assert verdicts == {"energy_closure": False, "laser_absorbed_error": True}
    assert all(m["pass"] for m in ledger_measures(record | {"solver": "sph"}))


def powers(widths: dict[float, float], tier: str) -> list[dict]:
    return [
        {"case": f"t{power}", "solver": "sph", "variant": "coarse", "status": "completed", "measures": [measure(value=value)],
         "settings": {"tier": tier, "spacing": 2e-5, "laser": {"power": power, "speed": 0.15, "spot_radius": 8e-5}}}
        for power, value in widths.items()
    ]


def trend(widths: dict[float, float]) -> list[Row]:
    return power_trend_rows(powers(widths, "canonical"))


def test_width_must_rise_at_every_step_of_power():
    assert trend({100: 1.0, 150: 1.2, 200: 1.3})[0].verdict == "pass"
    assert trend({100: 1.0, 150: 1.4, 200: 1.3})[0].verdict == "fail"
    assert trend({100: 1.0}) == []


def test_a_source_that_moves_over_metal_at_rest_is_no_track():
    tracks, sources = powers({100: 1.0, 150: 1.2}, "canonical"), powers({100: 3.0, 150: 3.5}, "v0")
    assert sorted(row.value for row in power_trend_rows(tracks + sources)) == pytest.approx([0.2, 0.5])


def test_junit_has_a_case_for_each_row():
    rows = [Row("a", "sph", "coarse", "x", 1.0, "m", 2.0, "exact", "", -1.0, "absolute", 0.5, "fail"),
            Row("a", "sph", "coarse", "y", None, "", None, None, "", None, None, None, "missing", "not run yet")]
    suite = ElementTree.fromstring(junit_xml(rows)).find("testsuite")
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("2", "1", "1")
    assert "reference 2" in describe(rows[0])


def test_results_of_another_solver_join_the_comparison(track, tmp_path_factory):
    source = tmp_path_factory.mktemp("elsewhere")
    result = read_result(track["sph"]) | {"solver": "otherware"}
    result["measures"] = [measure(reference_kind="solver", reference_solver="openfoam", reference=None, value=2e-4, error=None,
                                  **{"pass": True})]
    (source / "result.json").write_text(json.dumps(result))
    assert take_in(source, track["sph"].root) == 1
    taken = width(ResultPlace(track["sph"].root, "slm_track_150w", "otherware", "coarse"))
    assert taken["reference"] == width(track["openfoam"])["value"] and taken["pass"] is (abs(taken["error"]) <= 0.1)


def test_a_foreign_result_under_an_own_name_or_out_of_schema_is_refused(track, tmp_path_factory):
    source = tmp_path_factory.mktemp("elsewhere")
    result = read_result(track["sph"])
    (source / "result.json").write_text(json.dumps(result))
    with pytest.raises(CupelError, match="one of Cupel's own"):
        take_in(source, track["sph"].root)
    (source / "result.json").write_text(json.dumps(result | {"solver": "x", "status": "great"}))
    with pytest.raises(CupelError, match="status"):
        take_in(source, track["sph"].root)
