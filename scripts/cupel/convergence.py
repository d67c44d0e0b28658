"""Order and uncertainty of a case in a solver, from its results at three levels or more, and whether two solvers agree.

Levels h_1 < h_2 < h_3 (the three finest), values phi_1, phi_2, phi_3, ratios r_21 = h_2/h_1, r_32 = h_3/h_2, differences
e_21 = phi_2 - phi_1, e_32 = phi_3 - phi_2 (Celik et al. 2008, J. Fluids Eng. 130, 078001; Roache 1994; Stern et al. 2001):

    observed order     p = |ln|e_32/e_21| + q(p)| / ln r_21,   q = ln[(r_21^p - s)/(r_32^p - s)],   s = sign(e_32/e_21)
    Richardson         phi_1 + (phi_1 - phi_2)/(r_21^p - 1)
    uncertainty        GCI = 1.25 |phi_1 - phi_2|/(r_21^p - 1),  with p no greater than 2, the order that the methods can have

    monotone      e_32/e_21 > ln r_32/ln r_21 (1 for equal ratios), the limit of p -> 0
    oscillatory   e_32/e_21 < -1: the uncertainty is the greater of the GCI and half the range of the three values
    diverging     anything between: 1.25 times their range, no order and no Richardson value
    constant      e_21 = 0: 1.25 times their range

All in the unit of the measure. Beside it, where the reference is exact: the slope of ln|error| against ln h over all levels.
Two solvers agree when their finest values differ by less than sqrt(U_a^2 + U_b^2), U^2 = GCI^2 + (the measure's own uncertainty)^2.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace
from itertools import combinations
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from .errors import CupelError
from .layout import LEVELS, SOLVERS, ResultPlace, places
from .results import read_kept, read_result, write_json

SAFETY_FACTOR = 1.25
GREATEST_ORDER = 2.0      # in the uncertainty: a higher observed order is luck
HIGHEST_ORDER = 30.0      # that is told apart from more
SMALLEST_ORDER = 0.1      # below it Richardson's value is farther away than it is worth
FEWEST_LEVELS = 3


@dataclass(frozen=True)
class Point:
    """One level of a measure: its name, spacing m, value, own uncertainty, error against the reference; whether it is a kept result."""

    level: str
    spacing: float
    value: float
    uncertainty: float | None
    error: float | None
    kept: bool = False


@dataclass(frozen=True)
class Study:
    """A measure in a solver over its levels, finest first; order and Richardson value are None where there are none."""

    case: str
    solver: str
    measure: str
    unit: str
    kind: str                         # monotone, oscillatory, diverging or constant
    order: float | None
    richardson: float | None
    gci: float                        # in the measure's unit
    order_of_error: float | None
    reference: float | None
    points: tuple[Point, ...]
    note: str = ""

    @property
    def uncertainty(self) -> float:
        """Of the finest value: grid and scatter together."""
        return math.hypot(self.gci, self.points[0].uncertainty or 0.0)


@dataclass(frozen=True)
class Agreement:
    """Two solvers' finest values of a measure: difference and combined uncertainty in its unit."""

    case: str
    measure: str
    unit: str
    solvers: tuple[str, str]
    values: tuple[float, float]
    difference: float
    uncertainty: float
    agree: bool


@dataclass(frozen=True)
class Convergence:
    """All studies of a case, and the agreements between its solvers."""

    case: str
    studies: tuple[Study, ...] = ()
    agreements: tuple[Agreement, ...] = ()
    missing: tuple[str, ...] = ()   # why a solver has no study, a line each


def observed_order(coarse: float, fine: float, ratio_fine: float, ratio_coarse: float) -> float | None:
    """p > 0 of Celik et al. from e_32 = `coarse`, e_21 = `fine`, r_21, r_32; None where the differences do not shrink.

    Their iteration's fixed point, r_21^p (r_32^p - s)/(r_21^p - s) = |e_32/e_21|, rises with p, so it is bracketed instead.
    """
    if fine == 0.0 or coarse == 0.0:
        return None
    sign = math.copysign(1.0, coarse / fine)

    def excess(order: float) -> float:
        share = (ratio_coarse**order - sign) / (ratio_fine**order - sign)
        return order * math.log(ratio_fine) + math.log(share) - math.log(abs(coarse / fine))

    if excess(1e-6) >= 0.0:
        return None
    return float(brentq(excess, 1e-6, HIGHEST_ORDER, xtol=1e-12)) if excess(HIGHEST_ORDER) > 0.0 else HIGHEST_ORDER


def study_of(case: str, solver: str, measure: str, unit: str, points: list[Point], reference: float | None,
             reference_is_exact: bool) -> Study:
    """The study of a measure; `points` (at least three, of different spacing) in any order."""
    points = sorted(points, key=lambda point: point.spacing)
    first, second, third = (point.value for point in points[:3])
    ratio_fine, ratio_coarse = points[1].spacing / points[0].spacing, points[2].spacing / points[1].spacing
    fine, coarse = second - first, third - second
    span = max(first, second, third) - min(first, second, third)
    richardson, note = None, []
    order = observed_order(coarse, fine, ratio_fine, ratio_coarse)
    if span == 0.0:
        kind, gci = "constant", 0.0
    elif fine == 0.0:
        kind, gci = "constant", SAFETY_FACTOR * span
        note.append("the finest two are the same: no order")
    elif order is None:
        kind, gci = "diverging", SAFETY_FACTOR * span
    else:
        kind = "monotone" if coarse * fine > 0.0 else "oscillatory"
        gci = SAFETY_FACTOR * abs(fine) / (ratio_fine**min(order, GREATEST_ORDER) - 1.0)
        if order >= SMALLEST_ORDER:
            richardson = first - fine / (ratio_fine**order - 1.0)
        if kind == "oscillatory":
            gci = max(gci, 0.5 * span)
    scatter = math.hypot(points[0].uncertainty or 0.0, points[1].uncertainty or 0.0)
    if 0.0 < abs(fine) < scatter:
        note.append("the finest two differ by less than their scatter: the order says little")
    return Study(case, solver, measure, unit, kind, order, richardson, gci,
                 order_of_error(points) if reference_is_exact else None, reference, tuple(points), "; ".join(note))


def order_of_error(points: list[Point]) -> float | None:
    """Slope of ln|error| against ln h over all levels (least squares); None where an error is unknown or 0."""
    errors = [point.error for point in points]
    if any(error is None or error == 0.0 for error in errors):
        return None
    slope = np.polyfit(np.log([point.spacing for point in points]), np.log(np.abs(errors)), 1)[0]
    return float(slope)


def levels_of(root: Path, case: str, solver: str) -> dict[str, tuple[dict, bool]]:
    """Completed results by level, and whether each is a kept one; a fresh one goes before a kept one."""
    found = {}
    for level in LEVELS:
        for kept in (False, True):
            try:
                result = read_kept(case, solver, level) if kept else read_result(ResultPlace(root, case, solver, level))
            except CupelError:
                continue
            if result is not None and result["status"] == "completed":
                found[level] = (result, kept)
                break
    return found


def converge(root: Path, case: str) -> Convergence:
    """The studies of a case from fresh and kept results, and how its solvers agree."""
    others = sorted({place.solver for place in places(root, [case])} - set(SOLVERS))
    studies, missing = [], []
    for solver in (*SOLVERS, *others):
        levels = levels_of(root, case, solver)
        if len({result["settings"]["spacing"] for result, _ in levels.values()}) < FEWEST_LEVELS:
            have = ", ".join(levels) or "none"
            missing.append(f"{solver}: order and uncertainty need {FEWEST_LEVELS} levels, there are {len(levels)} ({have})")
            continue
        studies += _studies(case, solver, levels)
    return Convergence(case, tuple(studies), tuple(_agreements(case, studies)), tuple(missing))


def _studies(case: str, solver: str, levels: dict[str, tuple[dict, bool]]) -> list[Study]:
    by_measure: dict[str, list[tuple[Point, dict]]] = {}
    for level, (result, kept) in levels.items():
        for measure in result["measures"]:
            if measure["value"] is not None:
                point = Point(level, result["settings"]["spacing"], measure["value"], measure.get("uncertainty"), measure["error"], kept)
                by_measure.setdefault(measure["name"], []).append((point, measure))
    commits = {result["code"]["commit"] for result, _ in levels.values()}
    studies = []
    for name, found in by_measure.items():
        points = list({point.spacing: point for point, _ in found}.values())
        if len(points) < FEWEST_LEVELS or name.endswith("_closure") or name == "laser_absorbed_error":
            continue   # ledgers close to round-off or not at all: they have no order
        last = min(found, key=lambda each: each[0].spacing)[1]
        study = study_of(case, solver, name, last["unit"], points, last["reference"], last["reference_kind"] in ("exact", "tabulated"))
        if len(commits) > 1:
            note = f"levels of different commits: {', '.join(sorted(commits))}"
            study = replace(study, note="; ".join(filter(None, (study.note, note))))
        studies.append(study)
    return studies


def _agreements(case: str, studies: list[Study]) -> list[Agreement]:
    found = []
    for one, other in combinations(studies, 2):
        if one.measure != other.measure:
            continue
        difference = one.points[0].value - other.points[0].value
        combined = math.hypot(one.uncertainty, other.uncertainty)
        found.append(Agreement(case, one.measure, one.unit, (one.solver, other.solver), (one.points[0].value, other.points[0].value),
                               difference, combined, abs(difference) <= combined))
    return found


def write_convergence(root: Path, found: Convergence) -> None:
    """Writes results/CASE/convergence.json; nothing where there is no study. Raises `CupelError` on a full disk."""
    if not found.studies:
        return
    folder = root / found.case
    folder.mkdir(parents=True, exist_ok=True)
    write_json(folder / "convergence.json", {"schema": 1, "safety_factor": SAFETY_FACTOR} | asdict(found))


def lines_of(found: Convergence) -> list[str]:
    """The studies in words, a line each, as `./cupel check` prints them."""
    lines = []
    for study in found.studies:
        unit = "" if study.unit == "1" else f" {study.unit}"
        order = f"order {study.order:.2f}" if study.order is not None else "no order"
        words = [f"{study.kind}, {order}"]
        if study.order_of_error is not None:
            words.append(f"order of the error {study.order_of_error:.2f}")
        if study.richardson is not None:
            words.append(f"Richardson {study.richardson:.6g}{unit}")
        words.append(f"finest {study.points[0].value:.6g}{unit} ± {study.uncertainty:.3g} (grid {study.gci:.3g})")
        if study.note:
            words.append(study.note)
        lines.append(f"order    {study.case} {study.solver} {study.measure}: " + ", ".join(words))
    for one in found.agreements:
        verb = "agree" if one.agree else "differ"
        lines.append(f"{verb:8} {one.case} {one.solvers[0]} {one.solvers[1]} {one.measure}: difference {one.difference:+.4g}, "
                     f"combined uncertainty {one.uncertainty:.3g}")
    return lines
