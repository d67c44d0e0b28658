"""Reading and writing results: whole or not at all, and checked against the schema both ways."""

from __future__ import annotations

import functools
import json
import math
import os
import shutil
from pathlib import Path

import jsonschema

from .errors import CupelError, describe_system_error
from .layout import CASES, ResultPlace

SCHEMA_FILE = Path(__file__).parent / "schema" / "result.schema.json"


@functools.cache
def result_schema() -> dict:
    """The JSON schema of result.json."""
    return json.loads(SCHEMA_FILE.read_text())


@functools.cache
def _validator() -> jsonschema.protocols.Validator:
    return jsonschema.Draft202012Validator(result_schema())


def write_whole(path: Path, text: str) -> None:
    """Writes `text` beside `path`, flushes it to the disk and renames it: a reader sees the old file or the new one.

    Raises `CupelError` on a full disk or a folder that cannot be written.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with open(beside, "w") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise describe_system_error(error, path) from None


def write_json(path: Path, content: dict) -> None:
    """Writes `content` as JSON, whole or not at all; numbers that are not finite are refused (`CupelError`)."""
    try:
        text = json.dumps(content, indent=1, allow_nan=False)
    except ValueError:
        raise CupelError(f"{path}: a number is not finite; the result is not written") from None
    write_whole(path, text + "\n")


def read_json(path: Path) -> dict:
    """Reads a JSON object; `CupelError` if it is missing, cut off, or holds numbers that are not finite."""

    def refuse(constant: str):
        raise ValueError(f"{constant} is not a number")

    try:
        content = json.loads(path.read_text(), parse_constant=refuse)
    except OSError as error:
        raise describe_system_error(error, path) from None
    except ValueError as error:
        raise CupelError(f"{path}: not a whole JSON file ({error})") from None
    if not isinstance(content, dict):
        raise CupelError(f"{path}: not a JSON object")
    return content


def check_result(result: dict, where: Path | str) -> dict:
    """Returns `result` if it keeps the schema; else `CupelError` with the first thing that does not."""
    error = jsonschema.exceptions.best_match(_validator().iter_errors(result))
    if error is not None:
        key = "/".join(str(part) for part in error.absolute_path) or "the result"
        raise CupelError(f"{where}: {key}: {error.message[:200]} (see scripts/cupel/schema/result.schema.json)")
    return result


def write_result(folder: Path, result: dict) -> None:
    """Writes `folder`/result.json after checking it against the schema."""
    write_json(folder / "result.json", check_result(result, folder / "result.json"))


def read_result(place: ResultPlace) -> dict | None:
    """The result at `place`, or None if there is none; `CupelError` if there is one that cannot be trusted."""
    path = place.folder / "result.json"
    if not path.exists():
        return None
    result = check_result(read_json(path), path)
    for key in ("case", "solver", "variant"):
        if result[key] != getattr(place, key):
            raise CupelError(f"{path}: {key} is '{result[key]}', but the folder says '{getattr(place, key)}'")
    return result


def kept_folder(case: str) -> Path | None:
    """Where kept results of a case (or of CASE_VARIATION) are or would be; None if no case folder has that name."""
    if (CASES / case).is_dir():
        return CASES / case / "kept"
    owners = [folder for folder in CASES.glob("*/") if case.startswith(f"{folder.name}_") and (folder / "case.toml").exists()]
    folders = [owner / "kept" / case.removeprefix(f"{owner.name}_") for owner in owners]
    there = [folder for folder in folders if folder.is_dir()]
    return (there or folders or [None])[0]


def read_kept(case: str, solver: str, level: str) -> dict | None:
    """A kept result, or None if there is none; `CupelError` if it cannot be trusted."""
    folder = kept_folder(case)
    path = folder / solver / level / "result.json" if folder else None
    if path is None or not path.exists():
        return None
    result = check_result(read_json(path), path)
    for key, name in (("case", case), ("solver", solver), ("variant", level)):
        if result[key] != name:
            raise CupelError(f"{path}: {key} is '{result[key]}', but the folder says '{name}'")
    return result


def kept_cases(level: str) -> set[str]:
    """Names of the cases that have a kept result at `level`."""
    found = set()
    for path in CASES.glob(f"*/kept/**/{level}/result.json"):
        owner = path.relative_to(CASES).parts[0]
        variation = path.parent.parent.parent.relative_to(CASES / owner / "kept").parts
        found.add("_".join((owner, *variation)))
    return found


def move_aside(place: ResultPlace) -> None:
    """Moves an existing result out of the way, so that nothing of it can be taken for the new one.

    What holds no result (an aborted run that is not resumed) is removed; an earlier result that waits stays.
    """
    if not place.folder.exists():
        return
    try:
        if not (place.folder / "result.json").exists():
            shutil.rmtree(place.folder)
            return
        if place.previous.exists():
            shutil.rmtree(place.previous)
        place.previous.parent.mkdir(parents=True, exist_ok=True)
        os.rename(place.folder, place.previous)
    except OSError as error:
        raise describe_system_error(error, place.folder) from None


def drop_previous(place: ResultPlace) -> None:
    """Removes what `move_aside` kept, once the new result is complete."""
    shutil.rmtree(place.previous, ignore_errors=True)


def finite(value) -> float | None:
    """`value` as a finite float, or None."""
    if value is None:
        return None
    number = float(value)
    return number if math.isfinite(number) else None
