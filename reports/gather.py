"""What the page shows, gathered from the results folder: for each case the result, rows and snapshots of each solver."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from cupel.cases import Member, case_names, find_case, members
from cupel.comparison import Row, fill_solver_references, power_trend_rows
from cupel.errors import CupelError
from cupel.judging import judged_at
from cupel.layout import CANONICAL_CASES, SOLVERS, ResultPlace, places
from cupel.measures.elements import Series, read_series
from cupel.measures.registry import MeasureError
from cupel.results import kept_cases

VERIFICATION_TIERS = ("v0", "v1")


@dataclass
class Run:
    """One solver's part of a case; `result` is None where there is none that can be trusted."""

    place: ResultPlace
    result: dict | None
    rows: list[Row]
    series: Series | None = None
    kept: str = ""   # of a kept result that stands in for one that has not been run: its commit and age

    @property
    def solver(self) -> str:
        return self.place.solver

    @property
    def status(self) -> str:
        return self.result["status"] if self.result else "missing"


@dataclass
class Case:
    """A case of the page with its runs, in the order of solvers."""

    name: str
    runs: list[Run] = field(default_factory=list)
    member: Member | None = None   # what the case file says, where there may be no result that says it

    @property
    def tier(self) -> str | None:
        return self.settings.get("tier") or (self.member.tier if self.member else None)

    @property
    def family(self) -> str:
        """Name of the case file's folder: of all variations of a case the same."""
        variation = self.settings.get("variation") or (self.member.variation if self.member else None)
        return self.name.removesuffix(f"_{variation}") if variation else self.name

    @property
    def settings(self) -> dict:
        """The resolved case, from the first result that has it; empty if none has."""
        return next((run.result["settings"] for run in self.runs if run.result), {})

    @property
    def title(self) -> str:
        return self.settings.get("title") or (self.member.title if self.member else self.name)

    @property
    def shown(self) -> list[Run]:
        """Runs that have snapshots to show."""
        return [run for run in self.runs if run.series is not None]

    @property
    def assumed(self) -> list[dict]:
        return self.settings.get("assumed", [])

    @property
    def power(self) -> float | None:
        """Laser power [W], where the case has a place among the tracks of several powers: a long one repeats a power of theirs."""
        laser = self.settings.get("laser")
        return laser["power"] if laser and self.tier != "long" else None


def gather(root: Path, names: list[str] | None, variant: str) -> tuple[list[Case], list[Row]]:
    """Cases and the rows that compare several of them.

    `names` None: the canonical cases, every other that has a result of this variant or a kept one, and what a verification
    tier has besides, if anything of that tier is there.
    """
    found = places(root, variants=[variant])
    known: dict[str, Member] = {}
    if names is None:
        there = {place.case for place in found} | kept_cases(variant)
        known = known_cases(variant)
        begun = {known[name].tier for name in there & set(known)} & set(VERIFICATION_TIERS)
        names = [*CANONICAL_CASES, *(name for name, member in known.items() if member.tier in begun), *sorted(there)]
    cases = []
    for name in dict.fromkeys(names):
        fill_solver_references(root, name, variant)
        others = sorted({place.solver for place in found if place.case == name} - set(SOLVERS))
        case = Case(name, member=known.get(name))
        for solver in (*SOLVERS, *others):
            place = ResultPlace(root, name, solver, variant)
            judged = judged_at(place)
            case.runs.append(Run(place, judged.result, judged.rows, snapshots(place, judged.result), judged.kept))
        cases.append(case)
    results = [run.result for case in cases for run in case.runs if run.result]
    return cases, power_trend_rows(results)


def known_cases(level: str) -> dict[str, Member]:
    """Every case of the suite that has `level`, by name, in order of the case folders; empty where the build is missing."""
    try:
        return {member.name: member
                for name in case_names() for member in members(find_case(name)) if level in member.levels}
    except CupelError:
        return {}


def snapshots(place: ResultPlace, result: dict | None) -> Series | None:
    """The snapshots of a result; None if it has none that can be read."""
    if result is None or not (place.folder / "fields" / "fields.pvd").exists():
        return None
    resolved = (result["settings"].get("surrounding") or {}).get("resolved", "surrounding" not in result["settings"])
    try:
        return read_series(place.folder, fraction_when_absent=None if resolved else 1.0)
    except MeasureError:
        return None
