"""One run of one case in one solver: its folder, whether it can be skipped or resumed, and its state while it runs."""

from __future__ import annotations

import fcntl
import time
from dataclasses import dataclass, field
from pathlib import Path

from . import results, solvers
from .errors import CupelError, describe_system_error
from .layout import ResultPlace


@dataclass(eq=False)
class Job:
    """A run to be made. `phase` goes waiting → solving → measuring → done; `outcome` is a word for the user."""

    place: ResultPlace
    resolved: dict
    threads: int = 1
    resume: bool = False
    phase: str = "waiting"
    outcome: str = ""
    message: str = ""
    simulated: float = 0.0
    started: float = 0.0
    ended: float = 0.0
    samples: list[tuple[float, float]] = field(default_factory=list)
    _lock: object = None

    @property
    def end_time(self) -> float:
        """Simulated time at the end [s]."""
        return float(self.resolved["time"]["end"])

    @property
    def good(self) -> bool:
        return self.outcome in ("completed", "kept")

    def launch_record(self) -> dict:
        """What decides whether an earlier result is the same run."""
        return {
            "case": self.place.case, "solver": self.place.solver, "variant": self.place.variant,
            "hash": self.resolved["hash"], "fingerprint": solvers.fingerprint(self.place.solver),
        }

    def expected_seconds(self) -> float:
        """A rough measure of how long it takes, only good for starting the longest runs first."""
        box = self.resolved.get("domain", {})
        elements = 1.0
        spacing = self.resolved["spacing"]
        for lower, upper in zip(box.get("lower", []), box.get("upper", [])):
            elements *= max(1.0, (upper - lower) / spacing)
        return elements * (self.end_time / spacing)

    def take(self) -> None:
        """Takes the result folder for this process; `CupelError` if another run has it."""
        try:
            self.place.lock.parent.mkdir(parents=True, exist_ok=True)
            lock = open(self.place.lock, "w")
        except OSError as error:
            raise describe_system_error(error, self.place.lock) from None
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            lock.close()
            raise CupelError(f"{self.place} is being run by another process; wait for it or choose other --results") from None
        self._lock = lock

    def release(self) -> None:
        """Gives the result folder back."""
        if self._lock is not None:
            self._lock.close()
            self._lock = None

    def earlier(self) -> str:
        """What the folder holds of this very run: `result`, `run` (not yet measured), `checkpoint`, `other` or `nothing`."""
        folder = self.place.folder
        if not folder.exists():
            return "nothing"
        try:
            if results.read_json(folder / "launch.json") != self.launch_record():
                return "other"
            if (folder / "result.json").exists():
                result = results.read_result(self.place)
                if result["status"] == "completed":
                    return "result"
                # A stopped run would stop again: start it afresh. One that failed (a full disk, a kill) goes on, and so
                # does one that was refused (a powder bed that was not there) if it had come as far as a checkpoint.
                if result["status"] not in ("failed", "refused"):
                    return "other"
            elif (folder / "run.json").exists() and results.read_json(folder / "run.json").get("status") == "completed":
                return "run"
        except CupelError:
            return "other"
        return "checkpoint" if any((folder / "checkpoints").glob("*")) else "nothing"

    def forget_failure(self) -> None:
        """Removes the result of a failed run, which goes on now."""
        try:
            (self.place.folder / "result.json").unlink(missing_ok=True)
        except OSError as error:
            raise describe_system_error(error, self.place.folder / "result.json") from None

    def prepare_folder(self) -> None:
        """An empty folder with the resolved case and the launch record; what was there is moved aside."""
        results.move_aside(self.place)
        try:
            self.place.folder.mkdir(parents=True)
        except OSError as error:
            raise describe_system_error(error, self.place.folder) from None
        results.write_json(self.place.folder / "case.json", self.resolved)
        results.write_json(self.place.folder / "launch.json", self.launch_record())

    @property
    def case_file(self) -> Path:
        return self.place.folder / "case.json"

    def note_progress(self, simulated: float) -> None:
        """Takes a progress report: the simulated time reached [s]."""
        now = time.monotonic()
        self.simulated = simulated
        self.samples.append((now, simulated))
        if len(self.samples) > 2 and now - self.samples[0][0] > 60:
            self.samples.pop(0)

    @property
    def rate(self) -> float | None:
        """Simulated seconds per second of the last minute; None until it is known."""
        if len(self.samples) < 2:
            return None
        (first, start), (last, end) = self.samples[0], self.samples[-1]
        return (end - start) / (last - first) if last > first and end > start else None

    @property
    def seconds_left(self) -> float | None:
        return (self.end_time - self.simulated) / self.rate if self.rate else None
