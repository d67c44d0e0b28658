"""`./cupel cases`: what there is, what it must reach, and what it costs."""

from __future__ import annotations

from pathlib import Path

from reports.formatting import SOLVER_NAMES, limit, percent

from .cases import case_names, find_case, resolve
from .display import duration
from .errors import CupelError
from .layout import CASES, LEVELS, ROOT, SOLVERS, ResultPlace
from .results import check_result, read_json, read_result


def print_cases(results: Path | None) -> None:
    """Prints each case: title, spacing of its levels, measures with tolerances, and the cost of results that are there."""
    root = (results or ROOT / "results").absolute()
    for name in case_names():
        try:
            resolved = {level: resolve(find_case(name), level) for level in available_levels(name)}
        except CupelError as error:
            print(f"{name}\n    not readable: {error}")
            continue
        first = next(iter(resolved.values()))
        print(f"{name}\n    {first.get('title', '')}")
        print("    spacing: " + ", ".join(f"{level} {case['spacing'] * 1e6:g} μm" for level, case in resolved.items()))
        for measure in first.get("measures", []):
            print(f"    measure: {measure['name']}, {tolerance_text(measure)}")
        for level in resolved:
            for solver in SOLVERS:
                cost = known_cost(root, name, solver, level)
                if cost is not None:
                    print(f"    cost: {level} in {solver} {duration(cost['wall_s'])} "
                          f"({cost.get('threads', 1)} thread, {cost['elements']} elements, {cost['steps']} steps)")


def available_levels(name: str) -> list[str]:
    """The levels that the case reader accepts for a case; at least coarse."""
    levels = []
    for level in LEVELS:
        try:
            resolve(find_case(name), level)
            levels.append(level)
        except CupelError:
            if level == "coarse":
                raise
    return levels


def tolerance_text(measure: dict) -> str:
    """The tolerance of a declared measure in words, with where its reference comes from."""
    reference = measure.get("reference") or {}
    against = reference.get("solver") if reference.get("kind") == "solver" else reference.get("kind")
    tolerance = measure.get("tolerance")
    if tolerance is None:
        return "recorded, not judged"
    amount = limit(tolerance, measure.get("unit") or "1", None) if measure.get("metric") == "absolute" else percent(tolerance)
    return f"within {amount} of {SOLVER_NAMES.get(against, 'the ' + (against or 'given') + ' reference')}"


def known_cost(root: Path, case: str, solver: str, level: str) -> dict | None:
    """The cost of a completed result: the last one of the results folder, or else a kept one."""
    kept = CASES / case / "kept" / solver / level / "result.json"
    for read in (lambda: read_result(ResultPlace(root, case, solver, level)),
                 lambda: check_result(read_json(kept), kept) if kept.exists() else None):
        try:
            result = read()
        except CupelError:
            continue
        if result is not None and result["status"] == "completed":
            return result["cost"]
    return None
