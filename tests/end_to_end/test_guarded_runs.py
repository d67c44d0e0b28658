"""A run that goes wrong is stopped by its guards: a diagnosis that says what to do, and the last good state to look at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cupel import cases
from cupel.measures import read_series
from tests.end_to_end.direct_runs import (
    checkpoint_fields, newest_checkpoint, one_line, record, resolved, small_melt, snapshots, solve, step_of,
)

pytestmark = pytest.mark.end_to_end
LAYER = ("marangoni_layer", "resolution.coarse=100 um", "time.end=20 ms")
DROP = ("droplet_wetting", "resolution.coarse=222 um", "time.end=0.3 ms", "numerics.sound_speed=10 m/s")
TRACK = ("slm_track_150w", "resolution.coarse=40 um", "time.end=1 ms")

# What is wrong with a case → what its diagnosis says: model, quantity with its unit, and a remedy.
FAULTS = {
    "a number that is none": ((*TRACK, "laser.power=1e308 W", 'physics=["laser", "heat", "melting"]',
                               *(f"material.steel.{name}={value}" for name, value in (
                                   ("specific_heat", "1e-8 J/(kg K)"), ("specific_heat_solid", "1e-8 J/(kg K)"),
                                   ("conductivity", "1e-14 W/(m K)"), ("conductivity_solid", "1e-14 W/(m K)")))),
                              ("not a number", " = inf", "of particle ", "reduce numerics.")),
    "a temperature beyond any metal's": ((*TRACK, "laser.power=1 MW", 'physics=["laser", "heat", "melting"]'), ("heat: ", "20000 K", "temperature [K]", "of particle ", "check laser power")),
    "a speed above that of sound": ((*LAYER, "numerics.sound_speed=0.005 m/s"),
                                    ("momentum: ", "artificial speed of sound", "speed [m/s]", "of particle ", "raise numerics.reference_speed")),
    "a density far from the liquid's": ((*DROP, 'physics=["flow", "gravity"]', 'gravity=["0 m/s^2", "0 m/s^2", "-1e5 m/s^2"]', "material.oil.viscosity=5 Pa s", "material.water.viscosity=5 Pa s"),
                                        ("equation of state: ", "density [kg/m3]", "of particle ", "raise numerics.sound_speed_factor")),
    "a time step that collapses": ((*LAYER, "numerics.sound_speed=1 m/s", 'gravity=["0 m/s^2", "0 m/s^2", "-1e14 m/s^2"]'),
                                   ("time step (force): ", "collapsed below", "time step [s]", "check the values")),
}


# A melt that goes well for some thousand steps, until a beam that nothing could bear goes on.
LATE_FAULT = ("initial.temperature=2400 K", "laser.power=1 MW", "laser.start=1 ms")


def stopped_run(case: Path, folder: Path, *more: str) -> str:
    """Runs a case that cannot go well; what it said."""
    done = solve(case, folder, *more)
    assert done.returncode == 1, done.stderr
    return done.stderr


def read_fields(file) -> dict[str, np.ndarray]:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    output = reader.GetOutput()
    data = output.GetPointData()
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())} | {
        "position": vtk_to_numpy(output.GetPoints().GetData())}


@pytest.mark.parametrize("fault", list(FAULTS))
def test_each_fault_stops_the_run_with_its_diagnosis_and_the_last_good_state(tmp_path, fault):
    (case, *overrides), words = FAULTS[fault]
    folder = tmp_path / "run"
    errors = stopped_run(resolved(cases.find_case(case), tmp_path, *overrides), folder)
    line = one_line(errors, "error: ", *words, ", time ", " s; ")
    account = record(folder)
    assert account["status"] == "stopped" and line == "error: " + account["diagnosis"]
    assert "NaN" not in (folder / "run.json").read_text()

    good = read_fields(folder / "fields" / "last_good.vtp")
    assert all(np.isfinite(values).all() for values in good.values())
    limits = {"sound_speed": account["settings"]["numerics"].get("sound_speed") or np.inf}
    assert np.linalg.norm(good["velocity"], axis=1).max() <= limits["sound_speed"]
    assert good.get("temperature", np.zeros(1)).max() <= 20_000
    # The checkpoint is of the same state: nothing in it is bad either, and it is of a step before the fault.
    checkpoint = checkpoint_fields(newest_checkpoint(folder))
    assert all(np.isfinite(values).all() for values in checkpoint.values())
    assert sorted(checkpoint["particles/vectors/position"][0][checkpoint["particles/kind"] != 2]) == sorted(good["position"][:, 0])
    assert checkpoint["step"] < account["cost"]["steps"]
    assert (folder / "fields" / "stopped.vtp").exists()
    # The series has no picture of the fault, and the history no row of it.
    times = [float(row.split(",")[0]) for row in (folder / "history.csv").read_text().splitlines()[1:]]
    assert times == sorted(times) and all("nan" not in row for row in (folder / "history.csv").read_text().splitlines())


def test_the_last_good_state_does_not_depend_on_when_checkpoints_were_written(tmp_path):
    """With none since the start it is computed again from there, with many from the newest: the same bits either way."""
    case = small_melt(tmp_path, *LATE_FAULT)
    often, never = tmp_path / "often", tmp_path / "never"
    stopped_run(case, often, "--checkpoint-every", "0")
    stopped_run(case, never, "--checkpoint-every", "1000")
    assert "by way of checkpoint_000000000000.h5" in (never / "log.txt").read_text()
    assert newest_checkpoint(often).name == newest_checkpoint(never).name and step_of(newest_checkpoint(never)) > 2000
    one, other = checkpoint_fields(newest_checkpoint(often)), checkpoint_fields(newest_checkpoint(never))
    assert one.keys() == other.keys()
    assert not [name for name in one if not np.array_equal(one[name], other[name])]
    assert (often / "fields" / "last_good.vtp").read_bytes() == (never / "fields" / "last_good.vtp").read_bytes()
    assert (often / "history.csv").read_bytes() == (never / "history.csv").read_bytes()


def test_the_last_good_state_leads_to_the_same_fault_again(tmp_path):
    case, folder = small_melt(tmp_path, *LATE_FAULT), tmp_path / "run"
    errors = stopped_run(case, folder)
    before, history = record(folder), (folder / "history.csv").read_bytes()
    assert stopped_run(case, folder, "--resume") == errors
    assert record(folder)["diagnosis"] == before["diagnosis"] and record(folder)["cost"]["steps"] == before["cost"]["steps"]
    assert (folder / "history.csv").read_bytes() == history


def test_shares_of_output_and_guards_are_in_the_account(tmp_path):
    case = small_melt(tmp_path)
    assert solve(case, tmp_path / "run").returncode == 0
    cost = record(tmp_path / "run")["cost"]
    assert len(snapshots(tmp_path / "run")) == 101 and len(read_series(tmp_path / "run", fraction_when_absent=1.0)) == 101
    assert 0 < cost["guards_s"] < cost["wall_s"] and 0 < cost["output_s"] < cost["wall_s"]
    assert cost["guards_s"] + cost["output_s"] < cost["wall_s"]
