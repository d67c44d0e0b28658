"""Turns what a solver left in a result folder into result.json: run as `python3 -m cupel.finish_result FOLDER`.

Runs as a program of its own, so that measuring neither holds up the progress of other runs nor takes them down with it.
Reads launch.json (who, what), case.json (the resolved case) and run.json (the solver's own account); measures the
snapshots; writes series.csv and, last of all, result.json.
"""

from __future__ import annotations

import platform
import shutil
import sys
from pathlib import Path

from .comparison import judge, ledger_measures
from .errors import CupelError, describe_system_error
from .results import finite, read_json, write_result


def finish(folder: Path) -> dict:
    """Measures a completed (or records a stopped) run in `folder` and writes its result.json; returns the result.

    Raises `CupelError` if the solver's account is missing, damaged, or of another case.
    """
    launch, case, run = (read_json(folder / name) for name in ("launch.json", "case.json", "run.json"))
    if run.get("settings", {}).get("hash") != case.get("hash"):
        raise CupelError(f"{folder / 'run.json'}: belongs to another case or other settings (its hash differs)")
    result = {key: run.get(key) for key in ("schema", "status", "diagnosis", "ledgers", "cost", "host")}
    result |= {
        "case": launch["case"], "solver": launch["solver"], "variant": launch["variant"], "settings": case,
        "code": run.get("code", {}) | {"fingerprint": launch["fingerprint"]}, "measures": [],
    }
    if result["status"] == "completed":
        from .measures import measure

        result["measures"] = [complete(row) for row in measure(folder, case)]
        result["measures"] += ledger_measures(result)
    history = folder / "history.csv"
    if history.exists():
        try:
            shutil.copyfile(history, folder / ".series.csv")
            (folder / ".series.csv").rename(folder / "series.csv")
        except OSError as error:
            raise describe_system_error(error, folder / "series.csv") from None
    write_result(folder, result)
    return result


def complete(row: dict) -> dict:
    """A measure with every key of the schema, judged; how its reference is named is brought to one form."""
    row = dict(row)
    reference = row.get("reference")
    if isinstance(reference, dict):
        row["reference"] = reference.get("value")
        row.setdefault("reference_kind", reference.get("kind"))
        row.setdefault("source", reference.get("source"))
        if reference.get("solver"):
            row.setdefault("reference_solver", reference["solver"])
    for key in ("value", "uncertainty", "reference", "reference_kind", "metric", "tolerance"):
        row.setdefault(key, None)
    row["source"] = row.get("source") or ""
    row["unit"] = row.get("unit") or "1"
    row["uncertainty"] = finite(row["uncertainty"])
    return judge(row, is_reference=row["reference_kind"] == "solver")


def failed_result(folder: Path, status: str, diagnosis: str, wall_seconds: float) -> dict:
    """Records a run that left no account of its own (it crashed, or was refused); returns the result."""
    launch, case = read_json(folder / "launch.json"), read_json(folder / "case.json")
    result = {
        "schema": 1, "case": launch["case"], "solver": launch["solver"], "variant": launch["variant"],
        "status": status, "diagnosis": diagnosis or "no message",
        "code": {"version": "", "commit": "", "fingerprint": launch["fingerprint"]},
        "host": {"name": platform.node()}, "settings": case, "measures": [], "ledgers": {},
        "cost": {"wall_s": wall_seconds},
    }
    write_result(folder, result)
    return result


def main() -> int:
    try:
        finish(Path(sys.argv[1]))
    except CupelError as error:
        print(f"cupel: {error}", file=sys.stderr)
        return error.status
    except Exception as error:  # a measure that fails on odd data must not look like a crash of the command line
        kind = "" if type(error).__name__ == "MeasureError" else f"{type(error).__name__}: "
        print(f"cupel: measuring {sys.argv[1]} failed: {kind}{error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
