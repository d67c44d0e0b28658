"""Starts the solver, alone or side by side under mpirun, follows what it says, and passes interruptions on."""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TextIO

from .errors import Refused

ROOT = Path(__file__).resolve().parent.parent
FOAM_SHARE = Path("/usr/share/openfoam")
STOP = signal.SIGUSR1               # asks for a checkpoint and the end; mpirun passes it on, where SIGTERM would have it kill


def solver_program() -> Path:
    """The solver's executable, in the build folder (CUPEL_BUILD overrides <repository>/build).

    Errors: Refused if it is not there.
    """
    program = Path(os.environ.get("CUPEL_BUILD", ROOT/"build"))/"bin"/"cupel_foam"
    if not program.is_file():
        raise Refused(f"{program}: is not built; run: cmake -S {ROOT} -B {program.parents[1]} && cmake --build {program.parents[1]}")
    return program


def command(case_folder: Path, ranks: int) -> list[str]:
    """Command line of the solver on a case that is divided among `ranks` ranks.

    Errors: Refused if the solver, or mpirun where it is needed, is not there.
    """
    line = [str(solver_program()), "-case", str(case_folder)]
    if ranks == 1:
        return line
    if not can_run_parallel():
        raise Refused(f"{case_folder}: is divided among {ranks} ranks, and there is no mpirun; install it (openmpi-bin), or run "
                      "afresh with one thread")
    # ranks share the cores with whatever else runs: none is bound to a core, and more of them than cores are let through
    return ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none", line[0], "-parallel", *line[1:]]


def can_run_parallel() -> bool:
    """Whether mpirun is there."""
    return shutil.which("mpirun") is not None


def environment() -> dict[str, str]:
    """Environment of the solver: OpenFOAM's own if it is sourced, else the little that Debian's package needs."""
    result = dict(os.environ)
    result.setdefault("WM_PROJECT_DIR", str(FOAM_SHARE))
    result["FOAM_SIGFPE"] = "false"             # not-a-number is found by the solver's own guards, with place and remedy
    # Open MPI: a container's only user is often root; a rank that waits lets the others have its core
    result |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}
    return result


@contextlib.contextmanager
def plain_path(folder: Path) -> Iterator[Path]:
    """The folder under a path that OpenFOAM takes: it drops blanks and the like, so then a link stands in for it."""
    if re.fullmatch(r"[\w./+-]+", str(folder), re.ASCII):
        yield folder
        return
    with tempfile.TemporaryDirectory(prefix="cupel_foam_") as place:
        link = Path(place)/"case"
        link.symlink_to(folder, target_is_directory=True)
        yield link


class Supervisor:
    """Runs solver processes one after the other. While it is open, SIGINT and SIGTERM ask the present one to stop.

    interrupted: whether they came. complaints: what the solvers wrote on standard error, `cause` the most telling of it.
    """

    def __init__(self, log: TextIO):
        self.log, self.interrupted = log, False
        self.complaints: list[str] = []
        self._process: subprocess.Popen | None = None

    def __enter__(self) -> Supervisor:
        self._earlier = {number: signal.signal(number, self._pass_on) for number in (signal.SIGINT, signal.SIGTERM)}
        return self

    def __exit__(self, *_) -> None:
        for number, handler in self._earlier.items():
            signal.signal(number, handler)

    @property
    def cause(self) -> str:
        """What the solver itself said last before it failed; mpirun's talk around it only if it said nothing."""
        said = [line for line in self.complaints if line.startswith("cupel_foam:")]
        return (said or self.complaints or ["no message"])[0]

    def _pass_on(self, number: int, _frame) -> None:
        self.interrupted = True
        if self._process is not None:
            self._process.send_signal(STOP)

    def run(self, case_folder: Path, ranks: int, after_line: Callable[[], None]) -> int | None:
        """Run the solver on a case to its end; returns the status that it ended with, None if it did not say (it was killed).

        Progress lines go to standard output, the others to the log; `after_line` is called after each.
        """
        with plain_path(case_folder.parent) as plain:
            # in a session of its own, so that a Ctrl-C reaches it once, through this process
            process = subprocess.Popen(command(plain/case_folder.name, ranks), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True, errors="replace", env=environment(),
                                       start_new_session=True, preexec_fn=_stop_with_parent)
            self._process = process
            if self.interrupted:
                process.send_signal(STOP)
            listener = threading.Thread(target=self._listen, args=(process.stderr,))
            listener.start()
            ended = None
            try:
                for line in process.stdout:
                    if line.startswith('{"progress"'):
                        print(line, end="", flush=True)
                    elif line.startswith('{"ended"'):
                        ended = int(json.loads(line)["ended"])
                    else:
                        self.log.write(line)
                    after_line()
                status = process.wait()
            except BaseException:
                _end(process)
                raise
            finally:
                listener.join()
                self._process = None
        if ended is None and not self.complaints:
            self.complaints.append(f"killed by signal {-status}" if status < 0 else f"ended with status {status}")
        return ended

    def _listen(self, stream: TextIO) -> None:
        for line in stream:
            self.log.write(line)
            if line.strip():
                self.complaints.append(line.strip())


def _stop_with_parent() -> None:
    """In the solver's process: have the kernel ask it to stop when the parent dies, even if it is killed."""
    ctypes.CDLL(None).prctl(1, STOP)                    # PR_SET_PDEATHSIG


def _end(process: subprocess.Popen) -> None:
    """End a process at once; mpirun ends its ranks when it is asked to, not when it is killed."""
    process.terminate()
    try:
        process.wait(timeout=5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
