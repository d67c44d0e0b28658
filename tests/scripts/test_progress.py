"""Progress in words, and the closing lines of the tests."""

from __future__ import annotations

import io

import pytest
from cupel import testing
from cupel.display import LiveDisplay, PlainDisplay, duration, simulated
from cupel.jobs import Job
from cupel.layout import ResultPlace
from rich.console import Console


@pytest.fixture
def job(tmp_path, monkeypatch) -> Job:
    """A job of 10 ms that has got 4 ms far in 2 s."""
    clock = iter([100.0, 101.0, 102.0])
    monkeypatch.setattr("cupel.jobs.time.monotonic", lambda: next(clock))
    job = Job(ResultPlace(tmp_path, "case", "sph", "coarse"), {"time": {"end": 0.01}, "spacing": 1e-3})
    job.phase = "solving"
    for time in (0.0, 0.002, 0.004):
        job.note_progress(time)
    return job


def test_rate_and_time_left_follow_from_progress(job):
    assert job.rate == pytest.approx(0.002) and job.seconds_left == pytest.approx(3.0)


@pytest.mark.parametrize("seconds, words", [(None, "–"), (4.2, "4 s"), (200, "3 min 20 s"), (7500, "2 h 05 min")])
def test_durations(seconds, words):
    assert duration(seconds) == words


@pytest.mark.parametrize("seconds, words", [(0.15, "150 ms"), (2.0, "2 s"), (3.2e-6, "3.2 μs"), (0.0, "0 μs")])
def test_simulated_times(seconds, words):
    assert simulated(seconds) == words


def test_plain_lines_name_time_rate_and_what_is_left(job, capsys, monkeypatch):
    display = PlainDisplay()
    monkeypatch.setattr("cupel.display.time.monotonic", lambda: 1000.0)
    display.progressed(job)
    assert capsys.readouterr().err == "case/sph/coarse: 4 ms of 10 ms, 120 ms/min, 3 s left\n"
    PlainDisplay(quiet=True).progressed(job)
    assert capsys.readouterr().err == ""


def test_the_table_shows_every_run(job):
    console = Console(file=io.StringIO(), width=120, force_terminal=False)
    console.print(LiveDisplay.table([job]))
    row = console.file.getvalue().splitlines()[1].split()
    assert row[:3] == ["case", "sph", "coarse"] and " ".join(row[-10:]) == "4 ms / 10 ms 120 ms/min 3 s solving"


def test_the_last_line_is_held_back(capsys):
    status, lines = testing.follow(["bash", "-c", "echo one; echo; echo two; echo '== 3 passed =='; exit 3"], hold_last=True)
    assert status == 3 and lines[-1] == "== 3 passed =="
    assert capsys.readouterr().out == "one\n\ntwo\n"
