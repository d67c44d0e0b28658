"""Where things are: folders of the repository, programs that the build makes, folders of results."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from .errors import CupelError, describe_system_error

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "validation_cases"
PROGRAMS = Path(os.environ.get("CUPEL_BUILD") or ROOT / "build") / "bin"  # CUPEL_BUILD: a build folder elsewhere
PYTHON = "/usr/bin/python3"
LEVELS = ("rough", "coarse", "intermediate", "medium", "fine", "paper")   # from the widest spacing to the narrowest
TIERS = ("canonical", "v0", "v1", "v2", "long")
SOLVERS = ("sph", "openfoam")
CANONICAL_CASES = ("droplet_wetting", "marangoni_layer", "slm_track_100w", "slm_track_150w", "slm_track_200w")


def program(name: str) -> Path:
    """Path of a program made by the build; `CupelError` if it is not there."""
    path = PROGRAMS / name
    if not os.access(path, os.X_OK):
        raise CupelError(f"the program {name} is missing from {PROGRAMS}: run ./cupel, which builds it")
    return path


@dataclass(frozen=True)
class ResultPlace:
    """The folder of one result: results/CASE/SOLVER/VARIANT."""

    root: Path
    case: str
    solver: str
    variant: str

    @property
    def folder(self) -> Path:
        return self.root / self.case / self.solver / self.variant

    @property
    def previous(self) -> Path:
        """Where the result of an earlier run waits until the new one is complete."""
        return self.root / ".previous" / self.case / self.solver / self.variant

    @property
    def lock(self) -> Path:
        return self.root / ".locks" / f"{self.case}.{self.solver}.{self.variant}"

    def __str__(self) -> str:
        return f"{self.case}/{self.solver}/{self.variant}"


def results_root(choice: Path | None) -> Path:
    """The folder of results: the user's choice, or `results` in the repository; made if needed."""
    root = (choice or ROOT / "results").absolute()
    try:
        root.mkdir(parents=True, exist_ok=True)
        probe = root / f".writable.{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise describe_system_error(error, root) from None
    return root


def places(root: Path, cases=None, solvers=None, variants=None) -> list[ResultPlace]:
    """All result folders under `root`, in order of case, solver and variant; each filter None means any."""
    found = []
    for folder in sorted(root.glob("[!.]*/[!.]*/[!.]*")):
        place = ResultPlace(root, folder.parent.parent.name, folder.parent.name, folder.name)
        wanted = (
            (cases is None or place.case in cases)
            and (solvers is None or place.solver in solvers)
            and (variants is None or place.variant in variants)
        )
        if wanted and ((folder / "result.json").exists() or (folder / "launch.json").exists()):
            found.append(place)
    return found
