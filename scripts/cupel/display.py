"""Progress of running jobs: a live table on a terminal, plain lines in a pipe or with --quiet."""

from __future__ import annotations

import sys
import time

from rich.console import Console
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table

from .jobs import Job

OUTCOME_STYLE = {"completed": "green", "kept": "green", "interrupted": "yellow", "stopped": "red", "refused": "red", "failed": "red"}
PLAIN_STEP = 0.1  # a plain line each tenth of a run
PLAIN_PAUSE_S = 5.0  # but no more often than this


def duration(seconds: float | None) -> str:
    """A time span in words that stay short: 45 s, 3 min 20 s, 2 h 05 min."""
    if seconds is None:
        return "–"
    seconds = int(round(seconds))
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60} min {seconds % 60:02d} s"
    return f"{seconds // 3600} h {seconds % 3600 // 60:02d} min"


def simulated(seconds: float) -> str:
    """A simulated time in the unit that fits it."""
    for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "μs")):
        if abs(seconds) >= scale or unit == "μs":
            return f"{seconds / scale:.3g} {unit}"
    return "0 s"


def rate_text(job: Job) -> str:
    """Simulated time per minute of wall time."""
    return f"{simulated(job.rate * 60)}/min" if job.rate else "–"


class PlainDisplay:
    """One line when a run starts, gets on by a tenth, or ends."""

    def __init__(self, quiet: bool = False):
        self.quiet = quiet
        self.told: dict[int, tuple[float, float]] = {}

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        return None

    def say(self, text: str) -> None:
        print(text, file=sys.stderr, flush=True)

    def started(self, job: Job, resumed: bool) -> None:
        self.told[id(job)] = (time.monotonic(), job.simulated / job.end_time)
        self.say(f"{job.place}: {'resumed' if resumed else 'started'}, to {simulated(job.end_time)}")

    def progressed(self, job: Job) -> None:
        when, share = self.told.get(id(job), (0.0, 0.0))
        now, reached = time.monotonic(), job.simulated / job.end_time
        if self.quiet or reached - share < PLAIN_STEP or now - when < PLAIN_PAUSE_S:
            return
        self.told[id(job)] = (now, reached)
        self.say(f"{job.place}: {simulated(job.simulated)} of {simulated(job.end_time)}, {rate_text(job)}, "
                 f"{duration(job.seconds_left)} left")

    def finished(self, job: Job) -> None:
        spent = f" after {duration(job.ended - job.started)}" if job.started else ""
        self.say(f"{job.place}: {job.outcome}{spent}" + (f": {job.message}" if job.message else ""))

    def refresh(self, jobs: list[Job]) -> None:
        return None


class LiveDisplay(PlainDisplay):
    """A table that is drawn over itself, with a bar for each run."""

    def __init__(self, console: Console):
        super().__init__()
        self.console = console
        self.live = Live(console=console, refresh_per_second=4, transient=False)

    def __enter__(self):
        self.live.__enter__()
        return self

    def __exit__(self, *exception):
        return self.live.__exit__(*exception)

    def say(self, text: str) -> None:
        self.console.print(text, markup=False, highlight=False)

    def started(self, job: Job, resumed: bool) -> None:
        if resumed:
            self.say(f"{job.place}: resumed from its checkpoint")

    def progressed(self, job: Job) -> None:
        return None

    def finished(self, job: Job) -> None:
        if not job.good:
            super().finished(job)

    def refresh(self, jobs: list[Job]) -> None:
        self.live.update(self.table(jobs))

    @staticmethod
    def table(jobs: list[Job]) -> Table:
        table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
        for heading in ("case", "solver", "variant", "", "simulated", "rate", "left", ""):
            table.add_column(heading, justify="right" if heading in ("simulated", "rate", "left") else "left", no_wrap=True)
        for job in jobs:
            bar = ProgressBar(total=1.0, completed=min(1.0, job.simulated / job.end_time), width=20)
            state = job.outcome or job.phase
            left = duration(job.seconds_left) if job.phase == "solving" else (
                duration(job.ended - job.started) if job.ended and job.started else "")
            table.add_row(job.place.case, job.place.solver, job.place.variant, bar,
                          f"{simulated(job.simulated)} / {simulated(job.end_time)}",
                          rate_text(job) if job.phase == "solving" else "", left, state,
                          style="dim" if job.phase == "waiting" else OUTCOME_STYLE.get(job.outcome, ""))
        return table


def make_display(quiet: bool) -> PlainDisplay:
    """The display that fits: live on a terminal, plain otherwise."""
    console = Console(stderr=True)
    return LiveDisplay(console) if console.is_terminal and not quiet else PlainDisplay(quiet)
