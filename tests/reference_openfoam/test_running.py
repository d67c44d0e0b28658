"""The command line around the solver: progress, interruption, resumption, refusal, divergence."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from tests.reference_openfoam import small_cases


def start(data, folder, *options):
    (folder/"resolved.json").write_text(json.dumps(data))
    command = [sys.executable, "-m", "reference_openfoam", "run", str(folder/"resolved.json"), "--output", str(folder/"result"), *options]
    return subprocess.Popen(command, env=os.environ | {"PYTHONPATH": str(small_cases.ROOT)},
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    """A grain on a plate, run in one go: (case, folder, run.json, standard output)."""
    folder = tmp_path_factory.mktemp("unbroken")
    data = small_cases.grain_on_plate()
    result = small_cases.solve(data, folder)
    assert result.returncode == 0, result.stderr
    return data, folder, json.loads((folder/"result"/"run.json").read_text()), result.stdout


def test_energy_ledger_closes_and_absorbed_power_is_a_times_p(unbroken):
    _, folder, record, _ = unbroken
    energy = record["ledgers"]["energy"]
    assert energy["closure"] < 1e-6
    assert energy["absorbed_error"] < 1e-9
    # the beam's foot is 3.2 x 3.2 spot radii: nearly all of A P = 52.5 W meets the plate or the grain
    assert energy["laser_absorbed"] == pytest.approx(0.35*150*6e-5, rel=3e-3)
    assert np.all(small_cases.history(folder)["absorbed_power_W"][1:] > 52.0)


def test_volume_is_kept_and_melting_begins(unbroken):
    data, folder, record, _ = unbroken
    assert record["ledgers"]["volume"]["closure"] < 1e-9
    fields, _ = small_cases.last_fields(data, folder)
    assert fields["peak_temperature"].max() > 1673 and fields["fraction"].min() >= 0 and fields["fraction"].max() <= 1
    assert set(fields) == {"temperature", "velocity", "volume", "fraction", "liquid_fraction", "peak_temperature", "pressure", "density"}


def test_progress_is_one_json_object_a_line_and_snapshots_are_a_series(unbroken):
    _, folder, _, output = unbroken
    lines = [json.loads(line)["progress"] for line in output.splitlines()]
    assert lines and set(lines[0]) == {"time", "end", "step", "wall_s"}
    names = sorted(path.name for path in (folder/"result"/"fields").iterdir())
    assert names == ["fields.pvd"] + [f"fields_{index:06d}.vtu" for index in range(4)]


@pytest.fixture(scope="module")
def unbroken_side_by_side(tmp_path_factory):
    """The same case on two ranks."""
    folder = tmp_path_factory.mktemp("side_by_side")
    data = small_cases.grain_on_plate()
    return data, folder, small_cases.completed(data, folder, "--threads", "2"), ""


def last_states(folder):
    """Every field of the last checkpoint as bytes, by name and rank."""
    mesh, = (folder/"result"/"checkpoints").glob("mesh_*")
    parts = sorted(mesh.glob("processor*")) or [mesh]
    states = {}
    for part in parts:
        last = max((path for path in part.iterdir() if path.name[0].isdigit()), key=lambda path: float(path.name))
        states |= {(part.name, path.name): path.read_bytes() for path in last.iterdir() if path.is_file() and path.name != "complete"}
    return states


def test_serial_and_two_ranks_agree_to_the_tolerance_of_the_linear_solvers(unbroken, unbroken_side_by_side):
    data, folder, record, _ = unbroken
    _, other_folder, other, _ = unbroken_side_by_side
    assert (record["cost"]["threads"], other["cost"]["threads"]) == (1, 2)
    ours, centres = small_cases.last_fields(data, folder)
    theirs, other_centres = small_cases.last_fields(data, other_folder)
    assert np.array_equal(centres, other_centres)
    # the pressure is solved to 1e-8 of its source: kPa to a Pa, speeds of mm/s to 1e-5 m/s. Gas under the open top, which moves at
    # such speeds, may then come in or go out: its temperature is not compared
    metal = ours["fraction"] > 0.5
    assert np.abs(ours["temperature"] - theirs["temperature"])[metal].max() < 0.01
    assert np.abs(ours["fraction"] - theirs["fraction"]).max() < 1e-8
    assert np.abs(ours["velocity"] - theirs["velocity"]).max() < 1e-5
    assert other["ledgers"]["energy"]["laser_absorbed"] == pytest.approx(record["ledgers"]["energy"]["laser_absorbed"], rel=1e-12)
    assert other["ledgers"]["energy"]["absorbed_error"] < 1e-9 and other["ledgers"]["energy"]["closure"] < 1e-6
    assert other["ledgers"]["volume"]["closure"] < 1e-9
    assert np.array_equal(small_cases.history(folder)["time_s"].round(12), small_cases.history(other_folder)["time_s"].round(12))


@pytest.mark.parametrize("threads, whole", [(1, "unbroken"), (2, "unbroken_side_by_side")])
def test_an_interrupted_run_leaves_a_checkpoint_and_resumes_to_the_same_bits(threads, whole, request, tmp_path):
    data, folder, record, _ = request.getfixturevalue(whole)
    options = ("--threads", str(threads))
    process = start(data, tmp_path, *options)
    limit = time.monotonic() + 60
    while not (tmp_path/"result"/"fields"/"fields_000000.vtu").exists() and time.monotonic() < limit:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    assert not (tmp_path/"result"/"run.json").exists()
    resumed = small_cases.completed(data, tmp_path, *options, "--resume")
    assert last_states(tmp_path) == last_states(folder)
    assert resumed["ledgers"] == record["ledgers"] and resumed["cost"]["steps"] == record["cost"]["steps"]
    assert (tmp_path/"result"/"history.csv").read_text() == (folder/"result"/"history.csv").read_text()


@pytest.mark.parametrize("threads", [1, 2])
def test_a_killed_run_leaves_no_result_and_can_be_resumed(threads, tmp_path):
    data = small_cases.grain_on_plate()
    process = start(data, tmp_path, "--threads", str(threads))
    limit = time.monotonic() + 60
    while not (tmp_path/"result"/"fields"/"fields_000000.vtu").exists() and time.monotonic() < limit:
        time.sleep(0.02)
    process.kill()
    process.communicate(timeout=60)
    assert not (tmp_path/"result"/"run.json").exists()
    time.sleep(2)                                    # the solver, asked by the kernel, ends its step and leaves a checkpoint
    assert small_cases.completed(data, tmp_path, "--resume")["ledgers"]["energy"]["closure"] < 1e-6


def test_a_truncated_checkpoint_is_refused_in_one_line(unbroken, tmp_path):
    data, folder, _, _ = unbroken
    subprocess.run(["cp", "-r", str(folder/"result"), str(tmp_path/"result")], check=True)
    written = [path for path in next((tmp_path/"result"/"checkpoints").glob("mesh_*")).iterdir() if path.name[0].isdigit()]
    newest = max(written, key=lambda path: float(path.name))
    (newest/"T").write_bytes((newest/"T").read_bytes()[:-100])
    result = small_cases.solve(data, tmp_path, "--resume")
    assert result.returncode == 2
    assert "truncated" in result.stderr and len(result.stderr.splitlines()) == 1


def test_resuming_with_other_settings_is_refused(unbroken, tmp_path):
    _, folder, _, _ = unbroken
    other = small_cases.grain_on_plate(time={"end": 9e-5, "output_interval": 2e-5})
    subprocess.run(["cp", "-r", str(folder/"result"), str(tmp_path/"result")], check=True)
    result = small_cases.solve(other, tmp_path, "--resume")
    assert result.returncode == 2 and "other settings" in result.stderr


@pytest.mark.parametrize("header, row, message", [
    ("x_m,y_m,z_m,radius_m", "0,0,0,-1e-5", "bed.csv:2: the radius is not above 0"),
    ("x_m,y_m,z_m,radius_m", "0,0,zero,1e-5", "bed.csv:2: must be four numbers"),
    ("x,y,z", "0,0,0", "bed.csv:1: the header must be"),
])
def test_a_broken_bed_ends_in_one_line_and_writes_nothing(tmp_path, header, row, message):
    (tmp_path/"bed.csv").write_text(f"{header}\n{row}\n")
    data = small_cases.grain_on_plate()
    data["bodies"][1] = {"shape": "powder_bed", "material": "steel", "state": "solid", "file": str(tmp_path/"bed.csv"),
                         "lower": [0, 0, 0], "upper": [1, 1, 1]}
    result = small_cases.solve(data, tmp_path)
    assert result.returncode == 2 and message in result.stderr and len(result.stderr.splitlines()) == 1
    assert not (tmp_path/"result").exists()


def test_a_folder_that_cannot_be_written_ends_in_one_line(tmp_path):
    (tmp_path/"result").write_text("a file where the folder should be")
    result = small_cases.solve(small_cases.grain_on_plate(), tmp_path)
    assert result.returncode == 2 and len(result.stderr.splitlines()) == 1


def test_a_folder_with_blanks_in_its_name_is_as_good_as_any(tmp_path):
    folder = tmp_path/"a folder, mine"
    folder.mkdir()
    small_cases.completed(small_cases.grain_on_plate(time={"end": 1e-5, "output_interval": 1e-5}), folder)
    assert (folder/"result"/"fields"/"fields_000001.vtu").is_file()


def test_a_beam_that_the_mesh_cannot_bear_is_stopped_with_a_diagnosis(tmp_path):
    data = small_cases.grain_on_plate(physics=["heat", "melting", "evaporation", "laser"])
    data["laser"]["power"] = 1e6
    result = small_cases.solve(data, tmp_path)
    assert result.returncode == 1
    record = json.loads((tmp_path/"result"/"run.json").read_text())
    assert record["status"] == "stopped"
    assert "three times the boiling temperature" in record["diagnosis"] and "refine it or lower the power" in record["diagnosis"]
    assert len(result.stderr.splitlines()) == 1


def falling_block(**changes):
    """A block of liquid that falls through gas in a closed box, in the plane: 16 x 16 cells."""
    parts = dict(
        spacing=1e-3, dimensions=2, physics=["flow", "gravity"], gravity=[0.0, 0.0, -9.81],
        materials={"oil": {"density": 1000.0, "viscosity": 0.01}, "gas": {"density": 1.0, "viscosity": 1e-5}},
        surrounding={"material": "gas", "resolved": True, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0},
        domain={"lower": [0.0, 0.0, 0.0], "upper": [0.016, 0.0, 0.016],
                "boundaries": {side: small_cases.WALL for side in ("x_min", "x_max", "z_min", "z_max")}},
        bodies=[{"shape": "box", "material": "oil", "state": "liquid", "lower": [0.004, 0.0, 0.009], "upper": [0.012, 0.0, 0.015]}],
        time={"end": 0.05, "output_interval": 0.05})
    return small_cases.case(**(parts | changes))


def stopped(result, folder):
    """run.json of a run that a guard has stopped, with one line on standard error and no claim to be a result."""
    assert result.returncode == 1 and len(result.stderr.splitlines()) == 1, result.stderr
    record = json.loads((folder/"result"/"run.json").read_text())
    assert record["status"] == "stopped" and record["diagnosis"] in result.stderr
    return record


def test_a_courant_number_out_of_hand_is_stopped_with_a_diagnosis(tmp_path):
    # forty times the longest steps that the limits allow, from the first on: it falls for 50 ms, to 0.5 m/s, 25 cells a step
    data = falling_block(numerics={"time_step_factor": 40.0}, time={"end": 50.0, "output_interval": 50.0})
    record = stopped(small_cases.solve(data, tmp_path), tmp_path)
    assert "Courant number has risen to" in record["diagnosis"] and "lower numerics.time_step_factor" in record["diagnosis"]


def interrupted_after_the_start(data, folder, *options):
    """Folder of the mesh of a run that was interrupted soon after its first snapshot; it can be resumed."""
    process = start(data, folder, *options)
    while not (folder/"result"/"fields"/"fields_000000.vtu").exists() and process.poll() is None:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    return folder/"result"/"checkpoints"/"mesh_0000"


@pytest.mark.parametrize("threads", [1, 2])
def test_a_field_that_is_no_number_is_stopped_with_place_and_time(threads, tmp_path):
    data = small_cases.grain_on_plate(numerics={"openfoam": {"mesh": "static"}})
    mesh = interrupted_after_the_start(data, tmp_path, "--threads", str(threads))
    part = mesh/f"processor{threads - 1}" if threads > 1 else mesh           # on the last rank, which is not the one that reports
    newest = max((path for path in part.iterdir() if path.name[0].isdigit()), key=lambda path: float(path.name))
    raw = bytearray((newest/"T").read_bytes())
    place = raw.index(b"(", raw.index(b"internalField")) + 1
    raw[place:place + 8] = np.array([np.nan]).tobytes()
    (newest/"T").write_bytes(raw)
    record = stopped(small_cases.solve(data, tmp_path, "--resume"), tmp_path)
    assert "the temperature is not a number at t = " in record["diagnosis"] and "x = (" in record["diagnosis"]


def test_a_frozen_temperature_drives_the_same_flow_on_two_ranks(tmp_path):
    # nothing ever solves for this temperature: what a rank knows beyond its cut is what it fetched at the start
    data = small_cases.case(
        spacing=5e-5, dimensions=2, physics=["flow", "gravity", "marangoni"], gravity=[0.0, 0.0, -25.0],
        materials={"liquid": {"density": 1000.0, "viscosity": 0.01, "surface_tension_slope": -4e-4},
                   "gas": {"density": 1.0, "viscosity": 1e-5}},
        surrounding={"material": "gas", "resolved": False, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0},
        domain={"lower": [0.0, 0.0, 0.0], "upper": [6e-3, 0.0, 1.4e-3],
                "boundaries": {side: small_cases.WALL for side in ("x_min", "x_max", "z_min")} | {"z_max": small_cases.OPEN}},
        initial={"temperature": 300.0, "temperature_gradient": [1000.0, 0.0, 0.0]},
        bodies=[{"shape": "box", "material": "liquid", "state": "liquid", "lower": [0.0, 0.0, 0.0], "upper": [6e-3, 0.0, 1e-3]}],
        time={"end": 5e-3, "output_interval": 5e-3})
    fields = []
    for threads in ("1", "2"):
        (tmp_path/threads).mkdir()
        record = small_cases.completed(data, tmp_path/threads, "--threads", threads)
        assert record["cost"]["threads"] == int(threads)
        fields.append(small_cases.last_fields(data, tmp_path/threads)[0])
    speeds = [field["velocity"][field["fraction"] > 0.5] for field in fields]
    assert np.abs(speeds[0]).max() > 1e-3
    assert np.abs(speeds[0] - speeds[1]).max() < 1e-4*np.abs(speeds[0]).max()


@pytest.mark.parametrize("threads", [1, 2])
def test_an_error_of_openfoam_on_all_ranks_is_stopped_with_what_it_says(threads, tmp_path):
    data = small_cases.grain_on_plate(numerics={"openfoam": {"mesh": "static"}})
    mesh = interrupted_after_the_start(data, tmp_path, "--threads", str(threads))
    settings = mesh/"system"/"fvSolution"
    settings.write_text(settings.read_text().replace("PBiCGStab", "NoSuchSolver"))
    record = stopped(small_cases.solve(data, tmp_path, "--resume"), tmp_path)
    assert "OpenFOAM reports at t = " in record["diagnosis"] and "NoSuchSolver" in record["diagnosis"]
    assert record["cost"]["threads"] == threads


def test_an_error_of_openfoam_on_one_rank_only_is_stopped_with_its_rank_and_ledgers(tmp_path):
    # a file stands where the second rank wants to make the folder of its next snapshot: the first rank waits for it in vain
    data = small_cases.grain_on_plate(numerics={"openfoam": {"mesh": "static"}})
    mesh = interrupted_after_the_start(data, tmp_path, "--threads", "2")
    reached = max(float(path.name) for path in mesh.glob("processor1/*") if path.name[0].isdigit())
    for moment in ("2e-05", "4e-05", "6e-05"):
        if float(moment) > reached:
            (mesh/"processor1"/moment).write_text("not a folder")
    began = time.monotonic()
    record = stopped(small_cases.solve(data, tmp_path, "--resume"), tmp_path)
    assert time.monotonic() - began < 60
    assert "OpenFOAM reports at t = " in record["diagnosis"] and "(rank 1)" in record["diagnosis"]
    assert record["cost"]["threads"] == 2 and record["cost"]["elements"] == 16*16*13
    assert record["ledgers"]["energy"]["closure"] < 1e-6
