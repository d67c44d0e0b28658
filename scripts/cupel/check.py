"""`./cupel check`: the verdict on results, as lines, as an exit status, and as JUnit XML."""

from __future__ import annotations

import sys
from pathlib import Path
from xml.etree import ElementTree

from .comparison import Row, fill_solver_references, power_trend_rows, rows_at
from .layout import ResultPlace
from .results import write_whole


def check_results(root: Path, cases: list[str], solvers: tuple[str, ...], variant: str, junit: Path) -> int:
    """Judges every wanted result; writes `junit`; 0 if every row passes and none is missing, else 1."""
    rows = gather(root, cases, solvers, variant)
    for row in rows:
        print(f"{row.verdict:8} {row.case} {row.solver} {row.quantity}{describe(row)}")
    write_whole(junit, junit_xml(rows))
    bad = [row for row in rows if row.verdict in ("fail", "missing")]
    judged = [row for row in rows if row.verdict != "none"]
    print(f"{len(judged) - len(bad)} of {len(judged)} comparisons pass", file=sys.stderr)
    return 1 if bad or not judged else 0


def gather(root: Path, cases: list[str], solvers: tuple[str, ...], variant: str) -> list[Row]:
    """All rows of the wanted results, with the trends over them; a missing result gives a row that says so."""
    rows, results = [], []
    for case in cases:
        fill_solver_references(root, case, variant)
        for solver in solvers:
            result, of_result = rows_at(ResultPlace(root, case, solver, variant))
            rows += of_result
            if result is not None:
                results.append(result)
    return rows + power_trend_rows(results)


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
