"""A run outlives what happens to its disk and to its folder, or ends in one line and goes on from where it was."""

from __future__ import annotations

import json
import os
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from tests.end_to_end.direct_runs import (
    assert_nothing_half_written, assert_same_run, command, listed_snapshots, newest_checkpoint, one_line, record, small_melt, snapshots, solve, step_of,
)

pytestmark = pytest.mark.end_to_end
OFTEN = ("--checkpoint-every", "0.05")


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    """The run that nothing happens to: its case and its folder."""
    root = tmp_path_factory.mktemp("unbroken")
    case = small_melt(root, "time.end=4 ms")
    done = solve(case, root / "run", *OFTEN)
    assert done.returncode == 0, done.stderr
    assert record(root / "run")["cost"]["acoustic_steps"] > 20_000
    return case, root / "run"


@pytest.fixture(scope="module")
def begun(unbroken, tmp_path_factory):
    """The folder of the same run, interrupted early on: its newest checkpoint is beyond the start."""
    folder = tmp_path_factory.mktemp("begun") / "run"
    process = start(unbroken[0], folder, listed=20)
    process.send_signal(signal.SIGTERM)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    one_line(errors, "interrupted", "--resume")
    assert step_of(newest_checkpoint(folder)) > 0
    return folder


def start(case, folder, listed: int) -> subprocess.Popen:
    """Starts the run, or goes on with it, and waits until it has so many snapshots."""
    process = subprocess.Popen(command(case, folder, *OFTEN, "--resume"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while len(listed_snapshots(folder)) < listed:
        assert process.poll() is None and time.monotonic() < deadline, "the run was over too soon or never began"
        time.sleep(0.01)
    return process


def go_on(case, begun, folder) -> subprocess.Popen:
    """Goes on with a copy of the begun run and waits until it has written something more."""
    shutil.copytree(begun, folder)
    return start(case, folder, listed=len(listed_snapshots(begun)) + 10)


def resume_and_compare(case, folder, whole) -> None:
    """Goes on from the newest checkpoint to the same end."""
    done = solve(case, folder, "--resume")
    assert done.returncode == 0 and done.stderr == "", done.stderr
    assert "resumed from checkpoint_" in (folder / "log.txt").read_text()
    assert_same_run(folder, whole)


def test_a_run_killed_before_its_first_checkpoint_begins_anew_and_is_the_same(unbroken, tmp_path):
    """The first is written when it is due, not at the start, which costs a short run more than it can lose."""
    case, whole = unbroken
    folder = tmp_path / "run"
    process = subprocess.Popen(command(case, folder), stdout=subprocess.DEVNULL)
    while not (folder / "history.csv").exists():
        assert process.poll() is None
        time.sleep(0.005)
    process.kill()
    process.wait()
    assert newest_checkpoint(folder) is None
    assert solve(case, folder, "--resume").returncode == 0
    assert_same_run(folder, whole)


def enter_namespace() -> list[str] | None:
    """The command after which a process may mount file systems that only it sees; None where the system allows none."""
    for options in (["-m"], ["-Urm"]):  # root needs no user namespace, and may not be given one; others need it
        enter = ["unshare", *options]
        probe = subprocess.run([*enter, "sh", "-c", "mount -t tmpfs -o size=64k none /mnt"], capture_output=True)
        if probe.returncode == 0:
            return enter
    return None


def test_a_disk_that_fills_up_ends_the_run_in_one_line_and_it_goes_on_when_there_is_space(unbroken, begun, tmp_path):
    case, whole = unbroken
    enter = enter_namespace()
    if enter is None:
        pytest.skip("this system lets nobody mount a small file system (unshare -Urm); the limit on file size is tested instead")
    kept = tmp_path / "kept"
    (tmp_path / "disk").mkdir()
    files = [path for path in whole.rglob("*") if path.is_file()]
    size = sum(path.stat().st_size for path in files) - sum(path.stat().st_size for path in snapshots(whole)) // 4
    # What the small disk holds is copied to a large one before it vanishes with its namespace, as if space was made.
    script = 'mount -t tmpfs -o size=$1 none disk && cp -a "$2" disk/run || exit 99; shift 2; "$@"; status=$?; cp -a disk/run kept; exit $status'
    done = subprocess.run([*enter, "sh", "-c", script, "sh", str(size), str(begun), *command(case, "disk/run", "--resume")],
                          cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 1, done.stderr
    one_line(done.stderr, "cupel_sph: disk/run/", "the disk is full", "free some space", "--resume")
    assert_nothing_half_written(kept)
    assert len(listed_snapshots(begun)) < len(listed_snapshots(kept)) < len(listed_snapshots(whole))
    resume_and_compare(case, kept, whole)


def test_a_folder_that_is_renamed_ends_the_run_in_one_line_and_it_goes_on_when_the_name_is_back(unbroken, begun, tmp_path):
    case, whole = unbroken
    process = go_on(case, begun, tmp_path / "run")
    (tmp_path / "run").rename(tmp_path / "elsewhere")
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 1
    one_line(errors, "cupel_sph: ", "run/", "not there", "restore it or choose another --output folder")
    assert not (tmp_path / "run").exists(), "something was written where the folder was"
    assert not (tmp_path / "elsewhere" / "run.json").exists()
    (tmp_path / "elsewhere").rename(tmp_path / "run")
    resume_and_compare(case, tmp_path / "run", whole)


def cpu_seconds(process: subprocess.Popen) -> float:
    fields = (Path("/proc") / str(process.pid) / "stat").read_text().rsplit(") ", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def test_what_a_run_waits_for_its_output_is_in_its_account_and_changes_nothing(unbroken, begun, tmp_path):
    """A pipe where a snapshot is prepared holds the writer up until somebody opens the other end."""
    case, whole = unbroken
    process = go_on(case, begun, tmp_path / "run")
    fields, number = tmp_path / "run" / "fields", len(listed_snapshots(whole)) - 30
    obstacle = fields / f".fields_{number:06}.vtp.beside"
    os.mkfifo(obstacle)
    before, now = -1.0, cpu_seconds(process)
    while not (fields / f"fields_{number - 1:06}.vtp").exists() or now > before:  # it goes on until too much is to be written
        assert process.poll() is None
        time.sleep(0.3)
        before, now = now, cpu_seconds(process)
    held_up = time.monotonic()
    time.sleep(1.0)
    assert not (fields / f"fields_{number + 1:06}.vtp").exists()
    pipe = os.open(obstacle, os.O_RDWR)
    waited = time.monotonic() - held_up
    assert process.wait(timeout=60) == 0
    (fields / f"fields_{number:06}.vtp").unlink()
    (fields / f"fields_{number:06}.vtp").write_bytes(os.read(pipe, 1 << 16))
    os.close(pipe)
    assert_same_run(tmp_path / "run", whole)
    cost = record(tmp_path / "run")["cost"]
    assert waited < cost["output_s"] < cost["wall_s"]


def test_a_folder_that_is_removed_ends_the_run_in_one_line_and_stays_away(unbroken, begun, tmp_path):
    case, _ = unbroken
    folder = tmp_path / "run"
    process = go_on(case, begun, folder)
    while folder.exists():
        shutil.rmtree(folder, ignore_errors=True)  # again where the run has just written another file
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 1
    one_line(errors, "cupel_sph: ", "run/", "not there", "restore it or choose another --output folder")
    assert not folder.exists()


def test_an_interrupted_run_leaves_a_checkpoint_and_goes_on_to_the_same_end(unbroken, begun, tmp_path):
    case, whole = unbroken
    assert_nothing_half_written(begun)
    shutil.copytree(begun, tmp_path / "run")
    resume_and_compare(case, tmp_path / "run", whole)


def resident_bytes(process: subprocess.Popen) -> int | None:
    """Memory of the process that is in use now; None when it has just ended. It stays in /proc until it is waited for."""
    with open(f"/proc/{process.pid}/status") as status:
        return next((1024 * int(line.split()[1]) for line in status if line.startswith("VmRSS:")), None)


@pytest.fixture(scope="module")
def long_run(tmp_path_factory):
    """A run of more than a hundred thousand steps: its case, its folder, and its resident memory by step, each time with
    the step of its newest checkpoint."""
    root = tmp_path_factory.mktemp("long")
    # At one rate, where its steps are many and cheap.
    case = small_melt(root, "time.end=13.5 ms", "numerics.acoustic_substeps=1")
    # The allocator gives nothing back meanwhile: memory can then only rise, and only where more is asked for than before.
    keep = {"MALLOC_TRIM_THRESHOLD_": "1000000000", "MALLOC_MMAP_THRESHOLD_": "1000000000"}
    process = subprocess.Popen(command(case, root / "run", "--checkpoint-every", "0.1"), env=os.environ | keep, stdout=subprocess.PIPE, text=True)
    samples = []
    for line in process.stdout:
        if resident := resident_bytes(process):
            samples.append((json.loads(line)["progress"]["step"], resident, step_of(newest_checkpoint(root / "run"))))
    assert process.wait() == 0
    return case, root / "run", samples


def test_memory_is_flat_over_a_hundred_thousand_steps(long_run):
    """From 10 % of the steps, and a checkpoint of as late, to the end it rises by less than 256 KiB: 3 bytes a step."""
    _, folder, samples = long_run
    steps = record(folder)["cost"]["steps"]
    assert steps > 100_000
    settled = [resident for step, resident, checkpoint in samples if min(step, checkpoint) >= 0.1 * steps]
    assert len(settled) >= 4, "the run was over too soon to be watched"
    assert max(settled) - settled[0] < 256 * 1024, samples


def test_a_limit_on_file_size_ends_the_run_in_one_line_and_it_goes_on_without_it(long_run, tmp_path):
    """A full disk that every user can have on every system: the history outgrows what the process may write."""
    case, whole, _ = long_run
    folder = tmp_path / "run"
    size = (whole / "history.csv").stat().st_size * 3 // 4
    assert size > 1.2 * newest_checkpoint(whole).stat().st_size, "a checkpoint would be refused first"

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    done = subprocess.run(command(case, folder, *OFTEN), capture_output=True, text=True, timeout=300, preexec_fn=limit, restore_signals=False)
    assert done.returncode == 1, done.stderr
    one_line(done.stderr, "history.csv", "may write", "ulimit -f")
    assert_nothing_half_written(folder)
    resume_and_compare(case, folder, whole)
