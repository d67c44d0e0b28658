"""`./cupel check`: the verdict on results, as lines, as an exit status, and as JUnit XML."""

from __future__ import annotations

import sys
from collections.abc import Collection
from pathlib import Path
from xml.etree import ElementTree

from .comparison import Row, fill_solver_references, power_trend_rows
from .convergence import converge, lines_of, write_convergence
from .errors import CupelError
from .judging import Judged, judged_at
from .kept import age
from .layout import ResultPlace
from .results import read_kept, write_whole


def check_results(root: Path, cases: list[str], solvers: tuple[str, ...], variant: str, junit: Path,
                  refused: Collection[tuple[str, str]] = ()) -> int:
    """Judges every wanted result; writes `junit`; 0 if every row passes and none is missing, else 1.

    refused: cases and solvers (`solvers.refusal`) of which there can be no result.

    Orders and uncertainties of the cases are printed too and written to results/CASE/convergence.json; they are not judged.
    """
    rows, kept = gather(root, cases, solvers, variant, refused)
    for row in rows:
        print(f"{row.verdict:8} {row.case} {row.solver} {row.quantity}{describe(row)}")
    for case in cases:
        found = converge(root, case)
        write_convergence(root, found)
        for line in lines_of(found):
            print(line)
    for line in kept:
        print(line)
    write_whole(junit, junit_xml(rows))
    bad = [row for row in rows if row.verdict in ("fail", "missing")]
    judged = [row for row in rows if row.verdict != "none"]
    print(f"{len(judged) - len(bad)} of {len(judged)} comparisons pass", file=sys.stderr)
    return 1 if bad or not judged else 0


def gather(root: Path, cases: list[str], solvers: tuple[str, ...], variant: str,
           refused: Collection[tuple[str, str]] = ()) -> tuple[list[Row], list[str]]:
    """All rows of the wanted results, with the trends over them, and a line for each kept result that is used or outdated.

    A result that has not been run is stood in for by the kept one; a missing one gives a row that says so.
    """
    rows, results, lines = [], [], []
    for case in cases:
        fill_solver_references(root, case, variant)
        for solver in solvers:
            if (case, solver) in refused:
                continue
            place = ResultPlace(root, case, solver, variant)
            judged = judged_at(place)
            rows += judged.rows
            if judged.result is not None:
                results.append(judged.result)
            lines += kept_lines(place, judged)
    return rows + power_trend_rows(results), lines


def kept_lines(place: ResultPlace, judged: Judged) -> list[str]:
    """What to say of the kept result at `place`: that it stands in for a fresh one, or that the code has moved on since."""
    if judged.kept:
        return [f"kept     {place.case} {place.solver}: not run here, {judged.kept}"]
    try:
        kept = read_kept(place.case, place.solver, place.variant)
    except CupelError:
        return []   # said in a row already
    since = age(kept) if kept is not None else ""
    return [f"outdated {place.case} {place.solver}: kept result of {kept['code']['commit']}, {since}; ./cupel keep renews it"] if since else []


def describe(row: Row) -> str:
    """The numbers of a row in words, for a line of text."""
    words = []
    if row.value is not None:
        words.append(f"{row.value:.6g} {row.unit}".rstrip())
    if row.reference is not None:
        words.append(f"reference {row.reference:.6g}")
    if row.error is not None:
        words.append(f"error {row.error:+.2%}" if row.metric == "relative" else f"error {row.error:+.3g}")
    if row.tolerance is not None:
        words.append(f"tolerance {row.tolerance:.2%}" if row.metric == "relative" else f"tolerance {row.tolerance:.3g}")
    if row.note:
        words.append(row.note)
    return ": " + ", ".join(words) if words else ""


def junit_xml(rows: list[Row]) -> str:
    """JUnit XML with a test case a row: failures as failures, missing ones as errors, unjudged ones as skipped."""
    suite = ElementTree.Element("testsuite", {
        "name": "cupel check", "tests": str(len(rows)),
        "failures": str(sum(row.verdict == "fail" for row in rows)),
        "errors": str(sum(row.verdict == "missing" for row in rows)),
        "skipped": str(sum(row.verdict == "none" for row in rows)),
    })
    for row in rows:
        test = ElementTree.SubElement(suite, "testcase", {
            "classname": f"{row.case}.{row.solver}.{row.variant}", "name": row.quantity})
        tag = {"fail": "failure", "missing": "error", "none": "skipped"}.get(row.verdict)
        if tag:
            ElementTree.SubElement(test, tag, {"message": describe(row).removeprefix(": ")})
    suites = ElementTree.Element("testsuites")
    suites.append(suite)
    ElementTree.indent(suites)
    return ElementTree.tostring(suites, encoding="unicode", xml_declaration=True) + "\n"
