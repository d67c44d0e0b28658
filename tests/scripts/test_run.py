"""`./cupel run`: every way in which a run can end, and that no half-made result is taken for a good one."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time

import pytest
from tests.conftest import PYTHON, ROOT


def one_line(text: str) -> str:
    """The text if it is one line that is no traceback."""
    assert "Traceback" not in text and len(text.strip().splitlines()) == 1, text
    return text.strip()


def test_a_good_run_leaves_a_whole_measured_result(run_case):
    done = run_case()
    assert done.returncode == 0, done.stderr
    result = json.loads((run_case.folder / "result.json").read_text())
    assert result["status"] == "completed" and result["variant"] == "v" and result["solver"] == "sph"
    assert {"contact_angle", "base_radius", "apex_height", "volume_closure"} <= {m["name"] for m in result["measures"]}
    assert (run_case.folder / "series.csv").read_text().startswith("time_s,")
    assert not list(run_case.folder.glob(".*"))


def test_a_stopped_run_is_recorded_with_its_diagnosis(run_case):
    done = run_case("--set", "behaviour=stop")
    assert done.returncode == 1 and "particle 7 left the domain" in done.stderr
    result = json.loads((run_case.folder / "result.json").read_text())
    assert result["status"] == "stopped" and result["measures"] == []


def test_a_crashed_run_is_recorded_as_failed(run_case):
    done = run_case("--set", "behaviour=crash")
    assert done.returncode == 1 and "Traceback" not in done.stderr
    result = json.loads((run_case.folder / "result.json").read_text())
    assert result["status"] == "failed" and result["diagnosis"] == "thread 0: out of memory"


def test_a_refused_run_says_why(run_case):
    done = run_case("--set", "behaviour=refuse")
    assert done.returncode == 1 and "laser.power: must be positive" in done.stderr
    assert json.loads((run_case.folder / "result.json").read_text())["status"] == "refused"


def test_a_solver_that_ends_without_its_account_has_failed(run_case):
    done = run_case("--set", "behaviour=silent")
    assert done.returncode == 1
    assert "run.json" in json.loads((run_case.folder / "result.json").read_text())["diagnosis"]


def test_bad_case_files_give_the_readers_line(run_case):
    done = run_case("--set", "bad=1")
    assert done.returncode == 2
    assert one_line(done.stderr).endswith("case.toml:3:1: laser.pwoer: unknown key; did you mean 'laser.power'?")
    assert not run_case.folder.exists()


def test_an_unknown_case_names_the_nearest(cupel, stand_ins, tmp_path):
    done = cupel("run", "droplet_weting", "--results", tmp_path / "r", env=stand_ins)
    assert done.returncode == 2 and "unknown case 'droplet_weting'; did you mean 'droplet_wetting'?" in one_line(done.stderr)


def test_an_unknown_option_is_one_line(cupel):
    done = cupel("run", "--lvel", "coarse")
    assert done.returncode == 2 and "--level" in one_line(done.stderr)


def test_a_results_folder_that_cannot_be_written_is_one_line(run_case):
    done = run_case("--results", "/proc/results")
    assert done.returncode == 1 and "/proc/results" in one_line(done.stderr)


def test_a_missing_program_says_how_to_get_it(cupel, tmp_path):
    done = cupel("run", "--results", tmp_path / "r", env={"CUPEL_BUILD": str(tmp_path)})
    assert done.returncode == 1 and "cupel_case is missing" in one_line(done.stderr)


def start(run_case, *arguments: str) -> subprocess.Popen:
    """Starts a slow run and waits until its solver is under way."""
    command = [PYTHON, "-m", "cupel", "run", str(run_case.case), "--solver", "sph", "--variant", "v", "--no-report",
               "--results", str(run_case.results), "--set", "behaviour=slow", *arguments]
    environment = os.environ | run_case.environment | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}"}
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 30
    while not (run_case.folder / "started.txt").exists():
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.05)
    time.sleep(0.3)
    return process


def test_interrupting_leaves_a_checkpoint_and_resume_goes_on(run_case):
    process = start(run_case)
    process.send_signal(signal.SIGINT)
    _, messages = process.communicate(timeout=60)
    assert process.returncode == 130 and "--resume" in messages and "Traceback" not in messages
    assert (run_case.folder / "checkpoints" / "checkpoint_000001.h5").exists()
    assert not (run_case.folder / "result.json").exists()

    done = run_case("--set", "behaviour=slow", "--resume")
    assert done.returncode == 0, done.stderr
    assert (run_case.folder / "started.txt").read_text().split() == ["fresh", "resumed"]
    assert json.loads((run_case.folder / "result.json").read_text())["status"] == "completed"


def test_killing_the_command_line_lets_solvers_leave_a_checkpoint_and_no_result(run_case):
    assert run_case().returncode == 0  # an earlier good result
    process = start_after_removal(run_case)
    process.kill()
    process.wait(timeout=30)
    deadline = time.monotonic() + 20
    while not list((run_case.folder / "checkpoints").glob("*")):
        assert time.monotonic() < deadline, "the solver was not told"
        time.sleep(0.05)
    assert not (run_case.folder / "result.json").exists()
    assert (run_case.results / ".previous" / "odd_drop" / "sph" / "v" / "result.json").exists()


@pytest.mark.parametrize(("behaviour", "line", "status"), [
    ("full", "the disk is full; free some space, then go on with --resume", "failed"),
    ("missing", "there is no bed bed_seed1.csv", "refused"),
])
def test_a_run_that_could_not_go_on_says_so_and_goes_on_from_its_checkpoint(run_case, behaviour, line, status):
    done = run_case("--set", f"behaviour={behaviour}")
    assert done.returncode == 1 and line in done.stderr
    assert json.loads((run_case.folder / "result.json").read_text())["status"] == status

    done = run_case("--set", f"behaviour={behaviour}", "--resume")
    assert done.returncode == 0, done.stderr
    assert (run_case.folder / "started.txt").read_text().split() == ["fresh", "resumed"]
    assert json.loads((run_case.folder / "result.json").read_text())["status"] == "completed"


def test_a_failed_run_without_a_checkpoint_is_started_afresh(run_case):
    assert run_case("--set", "behaviour=crash").returncode == 1
    assert run_case("--set", "behaviour=crash", "--resume").returncode == 1
    assert "resumed" not in (run_case.folder / "started.txt").read_text()


@pytest.mark.parametrize("what", ["result", "results"])
def test_a_folder_that_vanishes_ends_in_the_solvers_line(run_case, what):
    process = start(run_case, "--set", "behaviour=vanish")
    lost = run_case.folder if what == "result" else run_case.results
    lost.rename(run_case.results.parent / "elsewhere")
    _, messages = process.communicate(timeout=60)
    assert process.returncode == 1 and "Traceback" not in messages, messages
    assert "history.csv: cannot be written: the folder or file is not there" in messages
    assert not lost.exists()


def start_after_removal(run_case) -> subprocess.Popen:
    """Starts afresh over an earlier result, whose marker would be taken for that of the new run."""
    (run_case.folder / "started.txt").unlink()
    return start(run_case)


def test_resume_keeps_finished_results_and_notices_changes(run_case):
    assert run_case("--resume").returncode == 0
    before = (run_case.folder / "started.txt").read_text()
    assert run_case("--resume").returncode == 0
    assert (run_case.folder / "started.txt").read_text() == before

    done = run_case("--resume", "--set", "other=1")
    assert done.returncode == 0 and "starting afresh" in done.stderr
    assert (run_case.folder / "started.txt").read_text() == "fresh\n"


def test_a_second_run_of_the_same_result_is_refused(run_case):
    process = start(run_case)
    try:
        done = run_case("--set", "behaviour=slow")
        assert done.returncode == 1 and "another process" in done.stderr
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
    assert process.returncode == 130


def test_a_solver_that_cannot_run_a_case_is_left_out_of_it(cupel, tmp_path):
    name, place = "sessile_drop_round_wall_free_cylinder_90deg", ("--results", str(tmp_path))
    done = cupel("run", name, "--solver", "openfoam", *place)
    assert done.returncode == 2 and f"{name}: left out of openfoam: its walls are flat" in done.stderr
    assert "nothing is left to run" in done.stderr and not list(tmp_path.glob("*/openfoam"))
    rows = cupel("check", name, "--level", "fine", *place).stdout
    assert f"{name} sph" in rows and f"{name} openfoam" not in rows
