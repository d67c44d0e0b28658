"""One run: write the case, start the solver, pass its progress on, convert snapshots as they come, write run.json last."""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from . import case_writer, checkpoints, run_record
from .convert import SnapshotWriter, snapshot_index
from .errors import Refused
from .grid import make_grid
from .resolved_case import ResolvedCase
from .volume_fractions import top_of_bodies

ROOT = Path(__file__).resolve().parent.parent
FOAM_SHARE = Path("/usr/share/openfoam")


def solver_program() -> Path:
    """The solver's executable, in the build folder (CUPEL_BUILD overrides <repository>/build).

    Errors: Refused if it is not there.
    """
    program = Path(os.environ.get("CUPEL_BUILD", ROOT/"build"))/"bin"/"cupel_foam"
    if not program.is_file():
        raise Refused(f"{program}: is not built; run: cmake -S {ROOT} -B {program.parents[1]} && cmake --build {program.parents[1]}")
    return program


def solver_environment() -> dict[str, str]:
    """Environment of the solver: OpenFOAM's own if it is sourced, else the little that Debian's package needs."""
    environment = dict(os.environ)
    environment.setdefault("WM_PROJECT_DIR", str(FOAM_SHARE))
    environment["FOAM_SIGFPE"] = "false"        # not-a-number is found by the solver's own guards, with place and remedy
    return environment


def run(case: ResolvedCase, output: Path, threads: int = 1, resume: bool = False) -> int:
    """Run `case` into `output`; returns the exit status (0 completed, 1 stopped, 130 interrupted).

    Errors: Refused before anything is written.
    """
    program = solver_program()
    output = output.resolve()
    case_folder = output/"checkpoints"
    if resume:
        _check_same_case(case, case_folder)
        start, _ = checkpoints.newest(case_folder)
        grid = make_grid(case, top_of_bodies(case))
        _cut_history(case_folder/"history.csv", start)
    else:
        grid = make_grid(case, top_of_bodies(case))      # refuses a broken bed before anything is written
        try:
            _clear(output)
            output.mkdir(parents=True, exist_ok=True)
            case_folder.mkdir()
            case_writer.write_case(case, case_folder, grid)
            (case_folder/"resolved.json").write_text(json.dumps(case.data))
        except OSError as error:
            raise Refused(f"{output}: cannot be written: {error.strerror}") from None
    (output/"run.json").unlink(missing_ok=True)
    (case_folder/"outcome.json").unlink(missing_ok=True)
    snapshots = SnapshotWriter(case, grid, output/"fields")
    with open(output/"log.txt", "a" if resume else "w", encoding="utf-8") as log:
        if threads > 1:
            log.write(f"{threads} threads were offered; this solver runs on one core\n")
        with _plain_path(case_folder) as plain:
            return _supervise(case, [str(program), "-case", str(plain)], output, case_folder, snapshots, log)


def _clear(output: Path) -> None:
    """Remove what an earlier run of this solver left."""
    for name in ("run.json", "history.csv", "log.txt"):
        (output/name).unlink(missing_ok=True)
    for name in ("fields", "checkpoints"):
        if (output/name).exists():
            shutil.rmtree(output/name)


def _check_same_case(case: ResolvedCase, case_folder: Path) -> None:
    try:
        earlier = json.loads((case_folder/"resolved.json").read_text())
    except (OSError, json.JSONDecodeError):
        raise Refused(f"{case_folder}: there is no run to go on from; run without --resume") from None
    if earlier.get("hash") != case.data.get("hash"):
        raise Refused(f"{case_folder}: belongs to other settings; run without --resume")


def _cut_history(path: Path, start: float) -> None:
    """Drop rows after the checkpoint and a row cut short."""
    if not path.is_file():
        return
    lines = path.read_text().splitlines()
    columns = lines[0].count(",")
    kept = [line for line in lines[1:] if line.count(",") == columns and float(line.split(",")[0]) <= start*(1 + 1e-9)]
    path.write_text("\n".join(lines[:1] + kept) + "\n")


@contextlib.contextmanager
def _plain_path(folder: Path) -> Iterator[Path]:
    """The folder under a path that OpenFOAM takes: it drops blanks and the like, so then a link stands in for it."""
    if re.fullmatch(r"[\w./+-]+", str(folder), re.ASCII):
        yield folder
        return
    with tempfile.TemporaryDirectory(prefix="cupel_foam_") as place:
        link = Path(place)/"case"
        link.symlink_to(folder, target_is_directory=True)
        yield link


def _supervise(case: ResolvedCase, command: list[str], output: Path, case_folder: Path, snapshots: SnapshotWriter,
               log: TextIO) -> int:
    """Run the solver in its own session, so that a Ctrl-C reaches it once, through this process."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, errors="replace", env=solver_environment(), start_new_session=True,
                               preexec_fn=_end_with_parent)
    interruptions: list[int] = []

    def pass_on(number: int, _frame) -> None:
        interruptions.append(number)
        process.send_signal(signal.SIGTERM)

    earlier = {number: signal.signal(number, pass_on) for number in (signal.SIGINT, signal.SIGTERM)}
    complaints: list[str] = []
    listener = threading.Thread(target=_listen, args=(process.stderr, log, complaints))
    listener.start()
    try:
        for line in process.stdout:
            if line.startswith('{"progress"'):
                print(line, end="", flush=True)
            else:
                log.write(line)
            _convert(case, case_folder, snapshots)
        status = process.wait()
    except BaseException:
        process.kill()
        process.wait()
        raise
    finally:
        listener.join()
        for number, handler in earlier.items():
            signal.signal(number, handler)
    _convert(case, case_folder, snapshots)
    if (case_folder/"history.csv").is_file():
        run_record.copy_beside(case_folder/"history.csv", output/"history.csv")
    if status == 130 or (interruptions and status < 0):
        print(f"reference_openfoam: {case.name}: interrupted; --resume goes on from the newest checkpoint", file=sys.stderr)
        return 130
    if not (case_folder/"outcome.json").is_file():
        return _report_failure(case, output, status, complaints)
    record = run_record.write(case, case_folder/"outcome.json", output)
    if record["status"] == "stopped":
        print(f"reference_openfoam: {case.name}: stopped: {record['diagnosis']}", file=sys.stderr)
        return 1
    return 0


def _end_with_parent() -> None:
    """In the solver's process: have the kernel send SIGTERM when the parent dies, even if it is killed."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)          # PR_SET_PDEATHSIG


def _listen(stream, log, complaints: list[str]) -> None:
    for line in stream:
        log.write(line)
        if line.strip():
            complaints.append(line.strip())


def _report_failure(case: ResolvedCase, output: Path, status: int, complaints: list[str]) -> int:
    """The solver ended without an outcome: refused by OpenFOAM, or killed."""
    cause = complaints[0] if complaints else f"killed by signal {-status}" if status < 0 else f"ended with status {status}"
    print(f"reference_openfoam: {case.name}: the solver gave no result ({cause}); see {output/'log.txt'}", file=sys.stderr)
    return 1


def _convert(case: ResolvedCase, case_folder: Path, snapshots: SnapshotWriter) -> None:
    """Convert complete time folders that are snapshots and not yet there, then thin the checkpoints out."""
    for time, folder in checkpoints.complete_folders(case_folder):
        index = snapshot_index(case, time)
        if index is not None and not (snapshots.folder/f"fields_{index:06d}.vtu").exists():
            snapshots.write(folder, index)
    checkpoints.thin_out(case_folder)
