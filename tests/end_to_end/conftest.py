"""The canonical cases in a tiny variant, run once in both solvers by the command line itself."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from tests.conftest import PYTHON, ROOT

# Coarser and shorter than any level: they show that everything works together, not that it is accurate.
TINY = {
    "droplet_wetting": ("resolution.coarse=222 um", "time.end=6 ms", "time.output_interval=2 ms"),
    "marangoni_layer": ("resolution.coarse=100 um", "time.end=20 ms", "time.output_interval=5 ms"),
    "slm_track_150w": ("resolution.coarse=40 um", "time.end=0.5 ms", "time.output_interval=0.1 ms"),
}
# Long enough to be interrupted in the middle.
INTERRUPTED = {
    ("sph", "marangoni_layer"): ("resolution.coarse=100 um", "time.end=200 ms", "time.output_interval=5 ms"),
    ("sph", "slm_track_150w"): ("resolution.coarse=40 um", "time.end=4 ms", "time.output_interval=0.1 ms"),
    ("openfoam", "slm_track_150w"): ("resolution.coarse=40 um", "time.end=1.5 ms", "time.output_interval=0.1 ms"),
}


def tiny_arguments(case: str, results: Path, *more: str, settings: tuple[str, ...] | None = None) -> list[str]:
    """Arguments of `cupel` that run a case's tiny variant, or one with other settings."""
    overrides = [word for text in settings or TINY[case] for word in ("--set", text)]
    return ["run", case, *overrides, "--variant", "tiny", "--quiet", "--no-report", "--results", str(results), *more]


@dataclass
class TinyRuns:
    """Results folder of all tiny runs, and how each command ended."""

    results: Path
    ended: dict[str, subprocess.CompletedProcess] = field(default_factory=dict)

    def folder(self, case: str, solver: str) -> Path:
        return self.results / case / solver / "tiny"


@pytest.fixture(scope="session")
def tiny_runs(tmp_path_factory) -> TinyRuns:
    runs = TinyRuns(tmp_path_factory.mktemp("tiny"))
    environment = {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}", "PYTHONDONTWRITEBYTECODE": "1"}
    for case in TINY:
        runs.ended[case] = subprocess.run([PYTHON, "-m", "cupel", *tiny_arguments(case, runs.results)],
                                          env=os.environ | environment, capture_output=True, text=True, timeout=900)
    return runs
