"""Case files: which there are, and what one says at a level once every default is filled in."""

from __future__ import annotations

import difflib
import json
import subprocess
import tomllib
from pathlib import Path

from .errors import CupelError
from .layout import CASES, program


def case_names() -> list[str]:
    """Names of all cases of the suite, sorted."""
    return sorted(path.parent.name for path in CASES.glob("*/case.toml"))


def find_case(name: str) -> Path:
    """Path of the case file of `name`, which is a case of the suite or a path of a case file.

    Raises `CupelError` that names the nearest known case.
    """
    path = Path(name)
    if "/" in name or path.suffix == ".toml":
        path = path / "case.toml" if path.is_dir() else path
        if not path.is_file():
            raise CupelError(f"no case file {path}", status=2)
        return path.absolute()
    path = CASES / name / "case.toml"
    if not path.is_file():
        known = case_names()
        near = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
        hint = f"did you mean '{near[0]}'?" if near else "./cupel cases lists them"
        raise CupelError(f"unknown case '{name}'; {hint}", status=2)
    return path


def resolve(path: Path, level: str, overrides: list[str] | tuple[str, ...] = ()) -> dict:
    """The resolved case: what the file says at `level`, in SI units, with every default filled in.

    `overrides` are `key=value` texts. Raises `CupelError` (status 2) with the case reader's own line.
    """
    command = [str(program("cupel_case")), "resolve", str(path), "--level", level]
    for override in overrides:
        command += ["--set", override]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise CupelError(last_line(done.stderr) or f"{path}: the case reader failed ({done.returncode})", status=2)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError as error:
        raise CupelError(f"{path}: the case reader wrote no readable answer ({error})") from None


def case_schema() -> str:
    """JSON schema of case files, generated from the declarations of the case reader."""
    done = subprocess.run([str(program("cupel_case")), "schema"], capture_output=True, text=True)
    if done.returncode != 0:
        raise CupelError(last_line(done.stderr) or "the case reader could not print its schema")
    return done.stdout


def raw_case(path: Path) -> dict:
    """The case file as it stands, for listing; `CupelError` if it is no TOML."""
    try:
        return tomllib.loads(path.read_text())
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise CupelError(f"{path}: {error}", status=2) from None


def last_line(text: str) -> str:
    """The last line of `text` that is not empty."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else ""
