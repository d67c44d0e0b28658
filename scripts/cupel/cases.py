"""Case files: which there are, and what one says at a level once every default is filled in.

A case file with a `[sweep]` holds several cases, its members, one a variation: CASE_VARIATION. Any other file has one
member, itself. Everything that is run, judged and reported is a member.
"""

from __future__ import annotations

import difflib
import functools
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

from .errors import CupelError
from .layout import CANONICAL_CASES, CASES, program


@dataclass(frozen=True)
class Member:
    """One case to run. `variation` is None where the file has no `[sweep]`; `levels` are those that it has."""

    name: str
    path: Path
    variation: str | None
    title: str
    levels: tuple[str, ...]
    tier: str | None

    def resolve(self, level: str, overrides: list[str] | tuple[str, ...] = ()) -> dict:
        """The resolved case at `level`."""
        return resolve(self.path, level, overrides, self.variation)

    @property
    def kept(self) -> Path:
        """Where its kept results are."""
        folder = self.path.parent / "kept"
        return folder / self.variation if self.variation else folder


def case_names() -> list[str]:
    """Names of all case folders of the suite, sorted."""
    return sorted(path.parent.name for path in CASES.glob("*/case.toml"))


def find_case(name: str) -> Path:
    """Path of the case file of `name`, which is a case folder of the suite or a path of a case file.

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
        raise unknown_case(name, case_names())
    return path


def unknown_case(name: str, known: list[str]) -> CupelError:
    """The refusal of a name, with the nearest of the known ones."""
    near = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
    hint = f"did you mean '{near[0]}'?" if near else "./cupel cases lists them"
    return CupelError(f"unknown case '{name}'; {hint}", status=2)


@functools.cache
def members(path: Path) -> tuple[Member, ...]:
    """The members of a case file, in its order. Raises `CupelError` (status 2) with the case reader's own line."""
    summary = ask_reader("summary", str(path))
    return tuple(
        Member(each["name"], path, each["variation"], each["title"], tuple(each["levels"]), summary["tier"])
        for each in summary["members"]
    )


def find_members(name: str) -> list[Member]:
    """What a name on the command line means: a case (all its variations), one variation, or a path of a case file.

    Raises `CupelError` that names the nearest known case or variation.
    """
    known = case_names()
    if "/" in name or name.endswith(".toml") or name in known:
        return list(members(find_case(name)))
    owners = [case for case in known if name.startswith(f"{case}_")]
    candidates = [member for case in owners for member in members(find_case(case))]
    found = [member for member in candidates if member.name == name]
    if not found:
        raise unknown_case(name, known + [member.name for member in candidates])
    return found


def select_members(names: list[str] | None, tier: str | None, level: str) -> list[Member]:
    """The cases to run or to judge: those named, or all of a tier that have `level`, or else the canonical ones.

    Raises `CupelError` for an unknown name, for names beside a tier, and for a tier without such a case.
    """
    if names and tier:
        raise CupelError("name cases or give --tier, not both", status=2)
    if not tier:
        return list(dict.fromkeys(member for name in names or CANONICAL_CASES for member in find_members(name)))
    of_tier = [member for name in case_names() for member in members(find_case(name)) if member.tier == tier]
    found = [member for member in of_tier if level in member.levels]
    if not found:
        raise CupelError(f"no case of tier '{tier}' has a level '{level}'; ./cupel cases lists them", status=2)
    return found


def resolve(path: Path, level: str, overrides: list[str] | tuple[str, ...] = (), variation: str | None = None) -> dict:
    """The resolved case: what the file says at `level`, in SI units, with every default filled in.

    `overrides` are `key=value` texts; `variation` is one of the file's `[sweep]`, where it has one.
    Raises `CupelError` (status 2) with the case reader's own line.
    """
    arguments = ["resolve", str(path), "--level", level]
    if variation is not None:
        arguments += ["--variation", variation]
    for override in overrides:
        arguments += ["--set", override]
    return ask_reader(*arguments)


def ask_reader(*arguments: str) -> dict:
    """The JSON answer of the case reader. Raises `CupelError` (status 2) with its own line where it refuses."""
    done = subprocess.run([str(program("cupel_case")), *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise CupelError(last_line(done.stderr) or f"the case reader failed ({done.returncode})", status=2)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError as error:
        raise CupelError(f"{arguments[1]}: the case reader wrote no readable answer ({error})") from None


def case_schema() -> str:
    """JSON schema of case files, generated from the declarations of the case reader."""
    done = subprocess.run([str(program("cupel_case")), "schema"], capture_output=True, text=True)
    if done.returncode != 0:
        raise CupelError(last_line(done.stderr) or "the case reader could not print its schema")
    return done.stdout


def last_line(text: str) -> str:
    """The last line of `text` that is not empty."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else ""
