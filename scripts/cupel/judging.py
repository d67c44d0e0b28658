"""The verdict on one case in one solver: its fresh result, or else the kept one, as rows."""

from __future__ import annotations

from dataclasses import dataclass, replace

from .comparison import Row, missing_row, rows_of, solver_values, with_solver_references
from .errors import CupelError
from .kept import age, regression_rows
from .layout import ResultPlace
from .results import read_kept, read_result


@dataclass(frozen=True)
class Judged:
    """A result with its rows; `result` is None where there is none that can be trusted. `kept`: it stands in for one that has
    not been run, and `kept` says of which commit it is and what has changed since; empty for a fresh one."""

    result: dict | None
    rows: list[Row]
    kept: str = ""


def judged_at(place: ResultPlace) -> Judged:
    """Result and rows at `place`; the kept result where nothing has been run; a row that says so where there is neither.

    A fresh completed result is also compared with the kept one.
    """
    identity = (place.case, place.solver, place.variant)
    try:
        result = read_result(place)
        if result is not None:
            return Judged(result, rows_of(result) + regression_rows(result))
        if (place.folder / "launch.json").exists():
            note = "run, but not measured (messages.txt beside it says why; --resume measures again)" \
                if (place.folder / "run.json").exists() else "not finished (--resume goes on)"
            return Judged(None, [missing_row(*identity, note)])
        result = read_kept(*identity)
    except CupelError as error:
        return Judged(None, [missing_row(*identity, str(error), verdict="fail")])
    if result is None:
        return Judged(None, [missing_row(*identity, "not run yet")])
    result = with_solver_references(result, solver_values(place.root, place.case, place.variant))
    since = age(result)
    kept = f"kept result of {result['code']['commit']}" + (f", {since}" if since else "")
    return Judged(result, [replace(row, note="; ".join(filter(None, (kept, row.note)))) for row in rows_of(result)], kept)
