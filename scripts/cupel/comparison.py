"""Judging measures: errors against references, limits of the ledgers, and one row a comparison.

Every table, figure and verdict of the suite is made from `Row`s; no other place decides what passes.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from .errors import CupelError
from .layout import SOLVERS, ResultPlace, places
from .results import finite, read_kept, read_result, write_result

# What every run must keep, whatever it computes: ledger, entry, name of the row, limit for each solver, where it is asked.
LEDGER_LIMITS = (
    ("energy", "closure", "energy_closure", {"sph": 1e-3, "openfoam": 1e-5},
     "stored energy against what came in and went out"),
    ("mechanical_energy", "closure", "mechanical_energy_closure", {"sph": 1e-3},
     "kinetic and elastic energy against the work of every force, remedy and limiter"),
    ("momentum", "closure", "momentum_closure", {"sph": 1e-9},
     "momentum of a scene that nothing outside acts on, against the greatest Σ m |v|"),
    ("energy", "absorbed_error", "laser_absorbed_error", {"sph": 1e-3, "openfoam": 1e-3},
     "absorbed power against A·P of what the beam hits"),
)
# The volume of each phase is kept where nothing melts (melting changes the density, and so the volume).
VOLUME_LIMIT = 1e-3


@dataclass(frozen=True)
class Row:
    """One comparison of the suite. Values in SI units; `verdict` is pass, fail, missing, or none (nothing to judge)."""

    case: str
    solver: str
    variant: str
    quantity: str
    value: float | None
    unit: str
    reference: float | None
    reference_kind: str | None
    source: str
    error: float | None
    metric: str | None
    tolerance: float | None
    verdict: str
    note: str = ""


def judge(measure: dict, is_reference: bool = False) -> dict:
    """A copy of `measure` with `error` and `pass` worked out from value, reference, metric and tolerance.

    The error is (value − reference)/|reference| for metric `relative` and value − reference for `absolute`. Without a
    reference or a tolerance there is nothing to judge; a value that could not be measured fails, unless it
    `is_reference` itself: the solver that others are compared with.
    """
    judged = dict(measure)
    value, reference = finite(measure.get("value")), finite(measure.get("reference"))
    tolerance, metric = measure.get("tolerance"), measure.get("metric")
    judged["value"], judged["reference"] = value, reference
    judged["error"] = judged["pass"] = None
    if value is not None and reference is not None:
        if metric == "absolute":
            judged["error"] = value - reference
        elif reference != 0:
            judged["error"] = (value - reference) / abs(reference)
    if tolerance is not None:
        if judged["error"] is not None:
            judged["pass"] = abs(judged["error"]) <= tolerance
        elif value is None and not is_reference:
            judged["pass"] = False
    return judged


def ledger_measures(result: dict) -> list[dict]:
    """Measures that judge the ledgers of `result`; one that the case itself declares, or whose ledger the scene does not
    have, gives none."""
    ledgers, physics = result["ledgers"], result["settings"].get("physics", [])
    declared = {measure["name"] for measure in result["measures"]}
    wanted = [
        (ledgers[ledger].get(entry), name, limits[result["solver"]], source)
        for ledger, entry, name, limits, source in LEDGER_LIMITS
        if ledger in ledgers and entry in ledgers[ledger] and result["solver"] in limits
    ]
    if "volume" in ledgers and "melting" not in physics and not any("volume" in name for name in declared):
        wanted.append((ledgers["volume"].get("closure"), "volume_closure", VOLUME_LIMIT, "volume of each phase"))
    return [
        judge({
            "name": name, "value": finite(value), "unit": "1", "uncertainty": None, "reference": 0.0,
            "reference_kind": "exact", "source": source, "metric": "absolute", "tolerance": limit,
        })
        for value, name, limit, source in wanted if name not in declared
    ]


def fill_solver_references(root: Path, case: str, variant: str) -> None:
    """Gives measures whose reference is another solver the value that this solver measured, and judges them again.

    A missing or failed result of the other solver leaves the reference empty; where it has not been run, its kept result
    stands in. Results are rewritten only on change.
    """
    values = solver_values(root, case, variant)
    for place in places(root, [case], variants=[variant]):
        try:
            result = read_result(place)
        except CupelError:
            continue
        filled = result and with_solver_references(result, values)
        if result is not None and filled != result:
            write_result(place.folder, filled)


def solver_values(root: Path, case: str, variant: str) -> dict[tuple[str, str], float | None]:
    """(solver, measure) → value of the completed results of a case, kept ones where there is no fresh one."""
    found = {}
    for solver in dict.fromkeys([*SOLVERS, *(place.solver for place in places(root, [case], variants=[variant]))]):
        place = ResultPlace(root, case, solver, variant)
        try:
            result = read_result(place) if place.folder.exists() else read_kept(case, solver, variant)
        except CupelError:
            continue
        if result is not None and result["status"] == "completed":
            found |= {(solver, measure["name"]): measure["value"] for measure in result["measures"]}
    return found


def with_solver_references(result: dict, values: dict[tuple[str, str], float | None]) -> dict:
    """The result with its measures judged against the other solvers' `values` where these are their references."""
    measures = []
    for measure in result["measures"]:
        if measure["reference_kind"] == "solver":
            other = measure.get("reference_solver", "openfoam")
            own = other == result["solver"]
            reference = None if own else values.get((other, measure["name"]))
            measure = judge(measure | {"reference": reference, "reference_solver": other}, is_reference=own)
        measures.append(measure)
    return result | {"measures": measures}


def rows_of(result: dict) -> list[Row]:
    """The rows of one result; a run that did not complete gives one row that says so."""
    identity = (result["case"], result["solver"], result["variant"])
    if result["status"] != "completed":
        return [missing_row(*identity, f"{result['status']}: {result['diagnosis']}", verdict="fail")]
    rows = []
    for measure in result["measures"]:
        verdict = {True: "pass", False: "fail", None: "none"}[measure["pass"]]
        note = measure.get("note", "")
        if verdict == "none" and measure["reference_kind"] == "solver":
            if measure.get("reference_solver") == result["solver"]:
                note = note or "is the reference"
            elif measure["reference"] is None:
                verdict, note = "missing", note or f"no result of {measure.get('reference_solver')} to compare with"
        source = measure["source"] or measure.get("reference_solver", "")
        rows.append(Row(*identity, measure["name"], measure["value"], measure["unit"], measure["reference"],
                        measure["reference_kind"], source, measure["error"], measure["metric"],
                        measure["tolerance"], verdict, note))
    return rows


def missing_row(case: str, solver: str, variant: str, note: str, verdict: str = "missing") -> Row:
    """A row that stands for a whole result that is not there or not good."""
    return Row(case, solver, variant, "run", None, "", None, None, "", None, None, None, verdict, note)


def power_trend_rows(results: list[dict]) -> list[Row]:
    """Rows that ask whether the melt pool's width rises with laser power, for each solver and variant.

    Cases belong together when their resolved settings have the same tier, spacing, speed and spot: a source that moves
    over metal which only conducts is no track. The value is the smallest growth from one power to the next [m]; it
    passes when every step is a growth.
    """
    groups: dict[tuple, dict[float, float]] = {}
    for result in results:
        laser = result["settings"].get("laser")
        widths = [m["value"] for m in result["measures"] if m["name"] == "melt_pool_width" and m["value"] is not None]
        if laser and widths and result["status"] == "completed":
            settings = result["settings"]
            key = (result["solver"], result["variant"], settings.get("tier"), settings.get("spacing"), laser.get("speed"),
                   laser.get("spot_radius"))
            groups.setdefault(key, {})[laser["power"]] = widths[0]
    rows = []
    for (solver, variant, *_), widths in sorted(groups.items(), key=lambda item: item[0][:2]):
        powers = sorted(widths)
        if len(powers) < 2:
            continue
        growth = min(widths[high] - widths[low] for low, high in zip(powers, powers[1:]))
        names = " → ".join(f"{power:g}" for power in powers)
        rows.append(Row(f"slm_tracks ({names} W)", solver, variant, "width_growth_with_power", growth, "m", None, "paper",
                        "width rises with power (the paper, figure 9)", None, None, None,
                        "pass" if growth > 0 else "fail", "smallest growth from one power to the next; must be above zero"))
    return rows
