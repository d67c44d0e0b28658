"""One run: write the case, have it solved, convert snapshots as they come, write run.json last."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path
from typing import TextIO

from . import run_record, supervision
from .case_folder import CaseFolder
from .convert import SnapshotWriter, snapshot_index
from .errors import Refused
from .mesh_sequence import MeshSequence
from .resolved_case import ResolvedCase

MESH_MUST_FOLLOW = 3            # status of a solver that has left the fine part of its mesh


def run(case: ResolvedCase, output: Path, threads: int = 1, resume: bool = False) -> int:
    """Run `case` into `output` on up to `threads` ranks; returns the exit status (0 completed, 1 stopped, 130 interrupted).

    A resumed run has the ranks that it began with.
    Errors: Refused before anything is written.
    """
    supervision.solver_program()
    output = output.resolve()
    folder = output/"checkpoints"
    if resume:
        _check_same_case(case, folder)
        meshes = MeshSequence(case, folder, threads)
        written = meshes.newest()
        start, _ = written.newest()
        _cut_history(folder/"history.csv", start)
    else:
        meshes = MeshSequence(case, folder, threads if supervision.can_run_parallel() else 1)
        meshes.check()                                   # refuses a broken bed before anything is written
        try:
            _clear(output)
            folder.mkdir(parents=True)
            written = meshes.first()
            (folder/"resolved.json").write_text(json.dumps(case.data))
        except OSError as error:
            raise Refused(f"{output}: cannot be written: {error.strerror}") from None
    (output/"run.json").unlink(missing_ok=True)
    (folder/"outcome.json").unlink(missing_ok=True)
    snapshots = SnapshotWriter(case, output/"fields")
    with open(output/"log.txt", "a" if resume else "w", buffering=1, encoding="utf-8") as log:
        if written.ranks != threads:
            log.write(f"{threads} threads were offered, the run takes {written.ranks}\n")
        return _solve(case, meshes, written, output, snapshots, log)


def _clear(output: Path) -> None:
    """Remove what an earlier run of this solver left."""
    for name in ("run.json", "history.csv", "log.txt"):
        (output/name).unlink(missing_ok=True)
    for name in ("fields", "checkpoints"):
        if (output/name).exists():
            shutil.rmtree(output/name)


def _check_same_case(case: ResolvedCase, folder: Path) -> None:
    try:
        earlier = json.loads((folder/"resolved.json").read_text())
    except (OSError, json.JSONDecodeError):
        raise Refused(f"{folder}: there is no run to go on from; run without --resume") from None
    if earlier.get("hash") != case.data.get("hash"):
        raise Refused(f"{folder}: belongs to other settings; run without --resume")


def _cut_history(path: Path, start: float) -> None:
    """Drop rows after the checkpoint and a row cut short."""
    if not path.is_file():
        return
    lines = path.read_text().splitlines()
    columns = lines[0].count(",")
    kept = [line for line in lines[1:] if line.count(",") == columns and float(line.split(",")[0]) <= start*(1 + 1e-9)]
    path.write_text("\n".join(lines[:1] + kept) + "\n")


def _solve(case: ResolvedCase, meshes: MeshSequence, written: CaseFolder, output: Path, snapshots: SnapshotWriter,
           log: TextIO) -> int:
    """Run the solver, mesh after mesh, to the end of the case and write down how it ended."""
    folder = output/"checkpoints"
    with supervision.Supervisor(log) as supervisor:
        status: int | None = MESH_MUST_FOLLOW
        while status == MESH_MUST_FOLLOW and not supervisor.interrupted:
            _convert(case, written, snapshots)
            written = meshes.following(written)
            status = supervisor.run(written.path, written.ranks, lambda: _convert(case, written, snapshots))
        _convert(case, written, snapshots)
        if supervisor.interrupted and status == MESH_MUST_FOLLOW:
            status = 130
    if (folder/"history.csv").is_file():
        run_record.copy_beside(folder/"history.csv", output/"history.csv")
    if status == 130 or (supervisor.interrupted and status is None):
        print(f"reference_openfoam: {case.name}: interrupted; --resume goes on from the newest checkpoint", file=sys.stderr)
        return 130
    if not (folder/"outcome.json").is_file():
        print(f"reference_openfoam: {case.name}: the solver gave no result ({supervisor.cause}); see {output/'log.txt'}",
              file=sys.stderr)
        return 1
    record = run_record.write(case, folder/"outcome.json", output)
    if record["status"] == "stopped":
        print(f"reference_openfoam: {case.name}: stopped: {record['diagnosis']}", file=sys.stderr)
        return 1
    return 0


def _convert(case: ResolvedCase, written: CaseFolder, snapshots: SnapshotWriter) -> None:
    """Convert complete times that are snapshots and not yet there, then thin the checkpoints out."""
    complete = written.complete_times()
    for time, name in complete:
        index = snapshot_index(case, time)
        if index is not None and not (snapshots.folder/f"fields_{index:06d}.vtu").exists():
            snapshots.write(written, name, index)
    written.thin_out(complete)
