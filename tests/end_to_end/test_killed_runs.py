"""A run that is killed again and again, at moments that nobody chose, ends as the one that never was."""

from __future__ import annotations

import json
import random
import subprocess

import numpy as np
from cupel import cases
from cupel.layout import program
from cupel.measures import read_series

KILLS = 20


def solve(case, folder, seconds: float | None = None) -> int | None:
    """Runs the solver, going on from its newest checkpoint; killed after so many seconds. Its status, None if killed."""
    command = [str(program("cupel_sph")), "run", str(case), "--output", str(folder), "--threads", "1", "--resume",
               "--checkpoint-every", "0.02"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    try:
        _, errors = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return None
    assert process.returncode == 0, errors
    return process.returncode


def end(folder):
    series = read_series(folder, fraction_when_absent=1.0)
    return series.load(len(series) - 1)


def test_twenty_kills_change_nothing(tmp_path):
    overrides = ["resolution.coarse=30 um", "time.end=4 ms", "time.output_interval=0.4 ms"]
    case = tmp_path / "resolved.json"
    case.write_text(json.dumps(cases.resolve(cases.find_case("slm_track_150w"), "coarse", overrides)))
    assert solve(case, tmp_path / "whole") == 0
    # Of the processor, not of the clock: however busy the machine was then or is now, no run is over sooner.
    whole_time = json.loads((tmp_path / "whole" / "run.json").read_text())["cost"]["cpu_s"]

    chance = random.Random(20)
    kills = 0
    for _ in range(20 * KILLS):
        if kills == KILLS or solve(case, tmp_path / "killed", chance.uniform(0.05, 0.2) * whole_time) == 0:
            break
        account = tmp_path / "killed" / "run.json"
        if account.exists():  # written last of all: only a run that was whole when the kill came looks finished
            finished = json.loads(account.read_text())
            assert finished["status"] == "completed" and end(tmp_path / "killed").time == end(tmp_path / "whole").time
            break
        kills += 1
    assert solve(case, tmp_path / "killed") == 0
    assert kills >= KILLS // 2, "the run was over too soon to be killed"
    whole, killed = end(tmp_path / "whole"), end(tmp_path / "killed")
    assert np.array_equal(whole.position, killed.position)
    assert np.array_equal(whole.velocity, killed.velocity)
    assert np.array_equal(whole.temperature, killed.temperature)
