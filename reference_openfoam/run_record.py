"""run.json: what the solver reports, with the settings, the code and the machine that made it."""

from __future__ import annotations

import json
import os
import platform
import re
import subprocess
from pathlib import Path
from typing import Any

from . import __version__
from .resolved_case import ResolvedCase

ROOT = Path(__file__).resolve().parent.parent


def code_commit() -> str:
    """Commit of the sources, `+changes` if tracked files differ; `unknown` outside a repository."""
    def git(*arguments: str) -> str:
        return subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=True).stdout.strip()
    try:
        return git("rev-parse", "--short=12", "HEAD") + ("+changes" if git("status", "--porcelain", "--untracked-files=no") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def host() -> dict[str, Any]:
    """Name, processor and cores of this machine."""
    try:
        model = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    except OSError:
        model = None
    return {"name": platform.node(), "cpu": model.group(1) if model else platform.processor(), "cores": os.cpu_count()}


def copy_beside(source: Path, target: Path) -> None:
    """Copy a file under a passing name, then rename it, so that no reader sees half of it."""
    part = target.with_name(target.name + ".part")
    part.write_bytes(source.read_bytes())
    part.replace(target)


def write(case: ResolvedCase, outcome_file: Path, output: Path) -> dict[str, Any]:
    """Write run.json of a completed or stopped run from the solver's outcome; returns it."""
    outcome = json.loads(outcome_file.read_text())
    record = {
        "schema": 1, "case": case.name, "solver": "openfoam", "variant": case.data["level"], "status": outcome["status"],
        "diagnosis": outcome["diagnosis"],
        "code": {"version": __version__, "commit": code_commit(), "reference_version": outcome["reference_version"]},
        "host": host(), "settings": case.data, "ledgers": outcome["ledgers"], "cost": outcome["cost"],
    }
    part = output/"run.json.part"
    part.write_text(json.dumps(record, indent=1))
    part.replace(output/"run.json")
    return record
