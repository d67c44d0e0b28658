"""What the orchestration knows of each solver: how to start it, and how to tell whether it has changed."""

from __future__ import annotations

import functools
import hashlib
import os
from pathlib import Path

from .layout import PYTHON, ROOT, program


def command(solver: str, case_file: Path, folder: Path, threads: int, resume: bool) -> list[str]:
    """Command line that runs `solver` on a resolved case and writes into `folder`."""
    if solver == "sph":
        start = [str(program("cupel_sph"))]
    else:
        program("cupel_foam")
        start = [PYTHON, "-m", "reference_openfoam"]
    line = start + ["run", str(case_file), "--output", str(folder), "--threads", str(threads)]
    return line + ["--resume"] if resume else line


def refusal(solver: str, resolved: dict) -> str | None:
    """Why a solver has no result of a resolved case; None where it can have one."""
    if solver == "openfoam" and resolved["domain"].get("round_walls"):
        return "its walls are flat, and those of the case are round"
    return None


def environment(threads: int) -> dict[str, str]:
    """Environment of a solver: the repository's Python packages, and no more threads than it was given."""
    paths = f"{ROOT / 'scripts'}:{ROOT}"
    return os.environ | {"PYTHONPATH": paths, "OMP_NUM_THREADS": str(threads), "PYTHONUNBUFFERED": "1"}


@functools.cache
def fingerprint(solver: str) -> str:
    """SHA-256 over the program of `solver` (and its Python part): changes when the code that computes changes."""
    digest = hashlib.sha256()
    if solver == "sph":
        parts = [program("cupel_sph")]
    else:
        parts = [program("cupel_foam"), *sorted((ROOT / "reference_openfoam").rglob("*.py"))]
    for part in parts:
        digest.update(part.read_bytes())
    return digest.hexdigest()
