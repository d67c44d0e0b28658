"""Runs jobs side by side: starts solvers, follows their progress, passes interruptions on, has results measured."""

from __future__ import annotations

import ctypes
import json
import os
import selectors
import signal
import subprocess
import time

from . import finish_result, results, solvers
from .cases import last_line
from .errors import CupelError
from .jobs import Job
from .layout import PYTHON

PATIENCE_S = 120.0  # time that an interrupted solver has to leave its checkpoint
_SET_PARENT_DEATH_SIGNAL = 1  # prctl(2)
_libc = ctypes.CDLL(None)


def _follow_parent() -> None:
    """In a child: be told (SIGTERM, which leaves a checkpoint) if the command line is killed."""
    _libc.prctl(_SET_PARENT_DEATH_SIGNAL, signal.SIGTERM)


def kill_group(process: subprocess.Popen) -> None:
    """Kills a program and all that it has started (each program of the runner leads its own session)."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


class Runner:
    """Runs `jobs`, at most `slots` at a time, and reports to `display` (see display.py)."""

    def __init__(self, jobs: list[Job], slots: int, display):
        self.jobs, self.slots, self.display = jobs, slots, display
        self.waiting = sorted(jobs, key=Job.expected_seconds, reverse=True)
        self.running: dict[Job, subprocess.Popen] = {}
        self.buffers: dict[Job, bytes] = {}
        self.messages: dict[Job, int] = {}  # files in memory that programs write their messages to
        self.selector = selectors.DefaultSelector()
        self.interrupted = 0
        self.interrupted_at = 0.0

    def run(self) -> bool:
        """Runs everything; True if it was interrupted. Failures are in each job's `outcome` and `message`."""
        old = {number: signal.signal(number, self._on_signal) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            with self.display:
                while self.running or (self.waiting and not self.interrupted):
                    while self.waiting and len(self.running) < self.slots and not self.interrupted:
                        self._start(self.waiting.pop(0))
                    self._listen()
                    self.display.refresh(self.jobs)
        finally:
            for number, handler in old.items():
                signal.signal(number, handler)
            for process in self.running.values():
                kill_group(process)
        return bool(self.interrupted)

    def _on_signal(self, number, frame) -> None:
        self.interrupted += 1
        self.interrupted_at = time.monotonic()
        for process in self.running.values():
            if self.interrupted == 1:
                process.send_signal(signal.SIGINT)
            else:
                kill_group(process)
        if self.interrupted == 1:
            self.display.say("interrupted: waiting for checkpoints (once more to give up)")

    def _start(self, job: Job) -> None:
        try:
            job.take()
            earlier = job.earlier() if job.resume else "nothing"
            if earlier == "result" or earlier == "run":
                job.simulated = job.end_time
                self._measure(job)
                return
            if earlier == "checkpoint":
                job.forget_failure()
            else:
                if earlier == "other":
                    self.display.say(f"{job.place}: the case or the code has changed; starting afresh")
                job.prepare_folder()
            self._spawn(job, "solving", solvers.command(job.place.solver, job.case_file, job.place.folder, job.threads,
                                                        resume=earlier == "checkpoint"))
            self.display.started(job, resumed=earlier == "checkpoint")
        except CupelError as error:
            self._close(job, "failed", str(error))

    def _spawn(self, job: Job, phase: str, command: list[str]) -> None:
        """Starts a program for `job`; its messages are kept in memory, where neither a full disk nor a lost folder takes them."""
        messages = os.memfd_create("messages")
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=messages,
                                       env=solvers.environment(job.threads), start_new_session=True,
                                       preexec_fn=_follow_parent)
        except OSError as error:
            os.close(messages)
            raise CupelError(f"cannot start {command[0]}: {error.strerror}") from None
        self.messages[job] = messages
        os.set_blocking(process.stdout.fileno(), False)
        job.phase = phase
        if phase == "solving":
            job.started = time.monotonic()
        self.running[job], self.buffers[job] = process, b""
        self.selector.register(process.stdout, selectors.EVENT_READ, job)

    def _measure(self, job: Job) -> None:
        job.started = job.started or time.monotonic()
        self._spawn(job, "measuring", [PYTHON, "-m", "cupel.finish_result", str(job.place.folder)])

    def _listen(self) -> None:
        if self.interrupted and time.monotonic() - self.interrupted_at > PATIENCE_S:
            for process in self.running.values():
                kill_group(process)
        for key, _ in self.selector.select(timeout=0.25):
            job = key.data
            chunk = key.fileobj.read()
            if chunk:
                *lines, self.buffers[job] = (self.buffers[job] + chunk).split(b"\n")
                for line in lines:
                    self._on_line(job, line)
            elif chunk == b"":
                self.selector.unregister(key.fileobj)
                key.fileobj.close()
                self._on_end(job, self.running.pop(job).wait())

    def _on_line(self, job: Job, line: bytes) -> None:
        try:
            progress = json.loads(line)["progress"]
            job.note_progress(float(progress["time"]))
        except (ValueError, KeyError, TypeError):
            return  # only progress reports are read here; everything else is in the solver's log
        self.display.progressed(job)

    def _on_end(self, job: Job, status: int) -> None:
        """A program of `job` has ended: measures a run that has an account, records one that has none."""
        message = self._take_messages(job)
        try:
            if job.phase == "measuring":
                self._on_measured(job, status, message)
            elif self.interrupted and status != 0:
                self._close(job, "interrupted", "" if status in (130, -signal.SIGINT) else message)
            elif status in (0, 1) and (job.place.folder / "run.json").exists():
                job.simulated = job.end_time if status == 0 else job.simulated
                self._measure(job)
            else:
                word = "refused" if status == 2 else "failed"
                text = message or (f"killed by signal {-status}" if status < 0 else f"exit status {status}, no message")
                if status == 0:
                    text = "the solver ended without writing its account (run.json)"
                try:
                    finish_result.failed_result(job.place.folder, word, text, time.monotonic() - job.started)
                except CupelError:
                    pass  # a full disk or a lost folder: the solver's own line says so, and says more
                self._close(job, word, text)
        except CupelError as error:
            self._close(job, "failed", str(error))

    def _take_messages(self, job: Job) -> str:
        """The last line of what a program that has ended said; all of it goes to messages.txt where that can be written."""
        with open(self.messages.pop(job), "rb") as messages:
            messages.seek(0)
            text = messages.read().decode(errors="replace")
        try:
            with open(job.place.folder / "messages.txt", "a" if job.phase == "measuring" else "w") as file:
                file.write(text)
        except OSError:
            pass
        return last_line(text)

    def _on_measured(self, job: Job, status: int, message: str) -> None:
        if self.interrupted and status != 0:
            self._close(job, "interrupted", "")
        elif status != 0:
            self._close(job, "failed", message or "measuring failed")
        else:
            result = results.read_result(job.place)
            skipped = job.samples == [] and job.resume
            word = "kept" if skipped and result["status"] == "completed" else result["status"]
            self._close(job, word, result["diagnosis"])

    def _close(self, job: Job, outcome: str, message: str) -> None:
        job.phase, job.outcome, job.message, job.ended = "done", outcome, message, time.monotonic()
        if job.good:
            job.simulated = job.end_time
            results.drop_previous(job.place)
        job.release()
        self.display.finished(job)
