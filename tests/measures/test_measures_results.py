"""From files to judged measures: what is read, averaged, written and refused."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from cupel.measures import MeasureError, known_measures, measure, read_series
from tests.measures.exact_elements import drop, plate, track_scene
from tests.measures.test_measures_melt_pool import ellipsoid
from tests.measures.written_results import write_result

DX = 20e-6


def request(name, **more):
    return {"name": name, "unit": "m", "tolerance": 0.06, "metric": "relative",
            "reference": {"kind": "exact", "value": None, "source": "the cap of the drop's volume"}} | more


@pytest.fixture(scope="module", params=["jittered", "cells"])
def drop_run(request, tmp_path_factory):
    """Three snapshots of a 60 degree drop, the first a 90 degree one; and the case."""
    snapshots = []
    for time, angle in ((0.0, 90), (0.1, 60), (0.2, 60), (0.3, 60)):
        elements, case, cap = drop(angle, request.param, center=(0.1 * time, 0.0), seed=int(10 * time), room=(21.0, 17.0))
        snapshots.append(replace(elements, time=time))
    case["bodies"] = [{"shape": "sphere", "material": "liquid", "state": "liquid", "center": [0, 0, 10.0], "radius": 10.0}]
    case["materials"]["liquid"]["contact_angle"] = np.radians(60.0)
    folder = write_result(tmp_path_factory.mktemp("drop"), snapshots,
                          {"ledgers": {"energy": {"closure": 2e-4}, "mass": {"closure": 0.0}}})
    return folder, case


def test_measures_are_means_over_the_window_judged_against_the_exact_cap(drop_run):
    folder, case = drop_run
    window = {"between": [0.1, 0.3]}
    case = case | {"measures": [
        request("contact_angle", metric="absolute", tolerance=np.radians(2.0), **window),
        request("base_radius", **window), request("apex_height", **window),
        request("volume_change", metric="absolute", tolerance=0.02, **window)]}
    rows = measure(folder, case)
    assert [row["name"] for row in rows] == ["contact_angle", "base_radius", "apex_height", "volume_change"]
    angle, base, height, volume = rows
    assert [row["pass"] for row in rows] == [True] * 4
    assert angle["reference"] == pytest.approx(np.radians(60.0)) and angle["unit"] == "rad"
    assert base["reference"] == pytest.approx(16.079, abs=0.01) and height["reference"] == pytest.approx(9.283, abs=0.01)
    assert angle["error"] == pytest.approx(angle["value"] - angle["reference"])
    assert base["error"] == pytest.approx(base["value"] / base["reference"] - 1.0)
    assert 0.0 < angle["uncertainty"] < np.radians(1.0)
    json.dumps(rows, allow_nan=False)


def test_every_snapshot_has_its_row_in_measures_csv(drop_run):
    folder, case = drop_run
    measure(folder, case | {"measures": [request("contact_angle"), request("volume_change", metric="absolute")]})
    with open(folder / "measures.csv") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["time_s"]) for row in rows] == [0.0, 0.1, 0.2, 0.3]
    assert np.degrees(float(rows[0]["contact_angle_rad"])) == pytest.approx(90, abs=1.0)
    assert np.degrees(float(rows[3]["contact_angle_from_height_and_base_rad"])) == pytest.approx(60, abs=2.0)
    assert float(rows[0]["volume_change"]) == 0.0


def test_a_tolerance_that_is_missed_fails(drop_run):
    folder, case = drop_run
    rows = measure(folder, case | {"measures": [
        request("contact_angle", metric="absolute", tolerance=0.1,
                reference={"kind": "exact", "value": 0.8, "source": "another angle"})]})
    assert rows[0]["pass"] is False and rows[0]["error"] > 0.2


def test_a_reference_of_the_other_solver_stays_open(drop_run):
    folder, case = drop_run
    rows = measure(folder, case | {"measures": [
        request("base_radius", reference={"kind": "solver", "solver": "openfoam", "value": None, "source": "x"})]})
    assert rows[0]["reference"] is None and rows[0]["error"] is None and rows[0]["pass"] is None
    assert rows[0]["reference_solver"] == "openfoam"


def test_ledgers_come_from_the_run(drop_run):
    folder, case = drop_run
    zero = {"metric": "absolute", "tolerance": 1e-3}
    rows = measure(folder, case | {"measures": [request("energy_closure", **zero), request("mass_closure", **zero)]})
    assert [row["value"] for row in rows] == [2e-4, 0.0] and all(row["pass"] for row in rows)
    with pytest.raises(MeasureError, match=r"run.json: no ledgers.energy.absorbed_error"):
        measure(folder, case | {"measures": [request("laser_absorbed_error", **zero)]})


def test_a_run_that_ended_early_has_no_value_and_does_not_pass(drop_run):
    folder, case = drop_run
    rows = measure(folder, case | {"measures": [request("base_radius", between=[0.7, 1.0])]})
    assert rows[0]["value"] is None and rows[0]["pass"] is False and "no snapshot" in rows[0]["note"]


@pytest.mark.parametrize("form", ["lattice", "cells"])
def test_pool_and_track_are_measured_from_files(form, tmp_path):
    case = track_scene(DX, end=(-2.5e-4, 0.0))
    shape = ellipsoid(2e-4, 1e-4, 8e-5)
    snapshots = [plate(case, lambda p: np.full(len(p), 300.0), form, time=0.0, peak_temperature=lambda p: np.full(len(p), 300.0)),
                 plate(case, shape, form, time=2.2e-3, peak_temperature=shape),
                 plate(case, ellipsoid(2e-4, 1.1e-4, 8e-5), form, time=2.4e-3, peak_temperature=ellipsoid(2e-4, 1.1e-4, 8e-5))]
    wanted = ["melt_pool_width", "melt_pool_depth", "melt_pool_length", "bead_height", "fused_width"]
    case["measures"] = [{"name": name, "between": [2e-3, 2.4e-3]} for name in wanted]
    rows = {row["name"]: row for row in measure(write_result(tmp_path / "run", snapshots), case)}
    assert rows["melt_pool_width"]["value"] == pytest.approx(2.1e-4, abs=0.2 * DX)
    assert rows["melt_pool_width"]["uncertainty"] == pytest.approx(2e-5 / np.sqrt(2.0), rel=0.1)
    assert rows["melt_pool_depth"]["value"] == pytest.approx(8e-5, abs=0.1 * DX)
    assert rows["fused_width"]["value"] > 1.8e-4
    assert "go through the pool" in rows["fused_width"]["note"]
    assert all(row["pass"] is None for row in rows.values())


def test_pieces_of_one_instant_are_joined(tmp_path):
    elements, case, _ = drop(60, "cells")
    left = elements.position[:, 0] < 0.0
    folder = write_result(tmp_path / "run", [elements.take(left), elements.take(~left)])
    series = read_series(folder)
    assert len(series) == 1 and series.load(0).count == elements.count


# What is wrong with files is one clear line.

def test_unknown_measure_names_the_nearest(tmp_path):
    with pytest.raises(MeasureError, match="'contact_angel' is unknown; did you mean 'contact_angle'"):
        measure(tmp_path, track_scene(DX) | {"measures": [{"name": "contact_angel"}]})


def test_missing_field_names_file_field_and_measure(tmp_path):
    elements, case, _ = drop(60, "cells")
    case["materials"]["liquid"]["melting_temperature"] = 1723.0
    folder = write_result(tmp_path / "run", [elements])
    with pytest.raises(MeasureError, match=r"fields_000000.vtu: no field 'temperature', which melt_pool_width needs"):
        measure(folder, case | {"measures": [{"name": "melt_pool_width"}]})


def test_missing_snapshot_is_named(tmp_path):
    elements, case, _ = drop(60, "jittered")
    folder = write_result(tmp_path / "run", [elements, replace(elements, time=0.1)])
    (folder / "fields" / "fields_000001.vtp").unlink()
    with pytest.raises(MeasureError, match=r"fields_000001.vtp: named in the series but missing"):
        measure(folder, case | {"measures": [{"name": "contact_angle"}]})


@pytest.mark.parametrize("form", ["jittered", "cells"])
@pytest.mark.parametrize("share", [0.0, 0.02, 0.3, 0.7, 0.99])
def test_truncated_snapshot_is_refused_in_one_line(form, share, tmp_path, capfd):
    elements, case, _ = drop(60, form, 12.0)
    folder = write_result(tmp_path / "run", [elements])
    path = next((folder / "fields").glob("fields_*"))
    content = path.read_bytes()
    path.write_bytes(content[:int(share * len(content))])
    with pytest.raises(MeasureError) as problem:
        measure(folder, case | {"measures": [{"name": "contact_angle"}]})
    assert path.name in str(problem.value) and "\n" not in str(problem.value)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("content, why", [(None, "cannot be read"), ("<VTKFile><Coll", "truncated"),
                                          ("<VTKFile><Collection></Collection></VTKFile>", "no snapshots")])
def test_series_that_is_missing_truncated_or_empty_is_refused(content, why, tmp_path):
    (tmp_path / "fields").mkdir()
    if content is not None:
        (tmp_path / "fields" / "fields.pvd").write_text(content)
    with pytest.raises(MeasureError, match=why):
        read_series(tmp_path)


def test_numbers_that_are_not_finite_are_refused(tmp_path):
    elements, case, _ = drop(60, "jittered", 12.0)
    elements.volume[7] = np.nan
    folder = write_result(tmp_path / "run", [elements])
    with pytest.raises(MeasureError, match="'volume' holds 1 numbers that are not finite"):
        measure(folder, case | {"measures": [{"name": "contact_angle"}]})


def test_fraction_may_be_absent_only_where_the_surrounding_has_no_particles(tmp_path):
    elements, case, _ = drop(60, "lattice", 12.0)
    folder = write_result(tmp_path / "run", [replace(elements, fraction=None)])
    assert measure(folder, case | {"measures": [{"name": "contact_angle"}]})[0]["value"] == pytest.approx(np.radians(60), abs=0.03)
    with pytest.raises(MeasureError, match="no field 'fraction'"):
        measure(folder, case | {"measures": [{"name": "contact_angle"}], "surrounding": {"material": "gas", "resolved": True}})


def test_a_relative_tolerance_to_zero_is_refused(drop_run):
    folder, case = drop_run
    with pytest.raises(MeasureError, match="needs metric 'absolute'"):
        measure(folder, case | {"measures": [request("volume_change")]})


def test_every_measure_is_defined_in_the_readme():
    from pathlib import Path

    import cupel.measures
    text = (Path(cupel.measures.__file__).parent / "README.md").read_text()
    missing = [name for name in known_measures() if f"`{name}`" not in text]
    assert not missing
