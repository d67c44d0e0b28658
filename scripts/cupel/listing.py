"""`./cupel cases`: what there is, what it must reach, and what it costs."""

from __future__ import annotations

from pathlib import Path

from reports.formatting import SOLVER_NAMES, limit, percent, scale_of

from .cases import Member, case_names, find_case, members
from .display import duration
from .errors import CupelError
from .layout import ROOT, SOLVERS, TIERS, ResultPlace
from .results import check_result, read_json, read_result


def print_cases(results: Path | None, tier: str | None = None) -> None:
    """Prints each case (of a tier): title, variations, spacing of its levels, measures with tolerances, known cost."""
    root = (results or ROOT / "results").absolute()
    groups: dict[str | None, list[tuple[str, tuple[Member, ...] | CupelError]]] = {}
    for name in case_names():
        try:
            found = members(find_case(name))
            groups.setdefault(found[0].tier, []).append((name, found))
        except CupelError as error:
            groups.setdefault(None, []).append((name, error))
    for group in [each for each in (*TIERS, None) if each in groups and tier in (None, each)]:
        print(f"Tier {group}" if group else "In no tier")
        for name, found in groups[group]:
            lines = [f"not readable: {found}"] if isinstance(found, CupelError) else description(found, root)
            print(f"  {name}\n" + "\n".join(f"      {line}" for line in lines))


def description(found: tuple[Member, ...], root: Path) -> list[str]:
    """Lines that say what a case file holds; measures are those of its first member."""
    first = found[0]
    try:
        resolved = {level: first.resolve(level) for level in first.levels}
    except CupelError as error:
        return [f"not readable: {error}"]
    lines = [first.title]
    if first.variation is not None:
        lines.append("variations: " + ", ".join(str(member.variation) for member in found))
    lines.append("spacing: " + ", ".join(f"{level} {length(case['spacing'])}" for level, case in resolved.items()))
    for place in range(len(resolved[first.levels[0]].get("measures", []))):
        measures = {level: case["measures"][place] for level, case in resolved.items()}
        lines.append(f"measure: {measures[first.levels[0]]['name']}, {tolerance_text(measures)}")
    for member in found:
        for level in member.levels:
            for solver in SOLVERS:
                cost = known_cost(root, member, solver, level)
                if cost is not None:
                    which = "" if member.variation is None else f"{member.variation}, "
                    lines.append(f"cost: {which}{level} in {solver} {duration(cost['wall_s'])} "
                                 f"({cost.get('threads', 1)} thread, {cost['elements']} elements, {cost['steps']} steps)")
    return lines


def length(value: float) -> str:
    """A length (m) as a reader wants to see it."""
    factor, unit = (1.0, "m") if value >= 1e-2 else scale_of("m", value)
    return f"{value * factor:.4g} {unit}"


def tolerance_text(measures: dict[str, dict]) -> str:
    """The tolerance of a declared measure at each level in words, with where its reference comes from.

    `measures`: the resolved measure by level, coarsest first.
    """
    steps: list[tuple[str, str]] = []   # level from which on, amount
    for level, measure in measures.items():
        tolerance = measure.get("tolerance")
        if tolerance is None:
            continue
        absolute = measure.get("metric") == "absolute"
        amount = limit(tolerance, measure.get("unit") or "1", None) if absolute else percent(tolerance)
        if not steps or steps[-1][1] != amount:
            steps.append((level, amount))
    if not steps:
        return "recorded, not judged"
    first = next(iter(measures))
    if len(steps) == 1 and steps[0][0] == first:
        amounts = steps[0][1]
    else:
        amounts = ", ".join(f"{amount} from {level} on" for level, amount in steps)
    reference = next(iter(measures.values())).get("reference") or {}
    against = reference.get("solver") if reference.get("kind") == "solver" else reference.get("kind")
    return f"within {amounts} of {SOLVER_NAMES.get(against, 'the ' + (against or 'given') + ' reference')}"


def known_cost(root: Path, member: Member, solver: str, level: str) -> dict | None:
    """The cost of a completed result: the last one of the results folder, or else a kept one."""
    kept = member.kept / solver / level / "result.json"
    for read in (lambda: read_result(ResultPlace(root, member.name, solver, level)),
                 lambda: check_result(read_json(kept), kept) if kept.exists() else None):
        try:
            result = read()
        except CupelError:
            continue
        if result is not None and result["status"] == "completed":
            return result["cost"]
    return None
