"""From a folder of snapshots to the list of measures of the case, and measures.csv beside them."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..comparison import judge
from ..results import read_json, write_whole
from .elements import Series, read_series
from .registry import Measure, MeasureError, Reading, find_measure
from .snapshot import Snapshot

SAME_REFERENCE = 1e-3   # relative difference of two statements of an exact reference that is only rounding


def measure(result_folder: Path | str, resolved_case: dict) -> list[dict]:
    """The measures that the case names, in its order, each judged against its reference where it has one.

    result_folder: with fields/fields.pvd and, for ledgers, run.json; measures.csv (a row a snapshot) is written there.
    A measure of snapshots is the mean over those in `between` (the last one if not given) with the standard deviation
    as uncertainty, unless it has a way of its own. References of kind "solver" without a value stay open. A reference of kind "exact" or
    "tabulated" without a value is computed where the measure knows how; where the case file gives an exact one that differs, a note says so.
    Errors: MeasureError, one line, for unknown measures and for snapshots or ledgers that are missing or incomplete.
    """
    folder, requests = Path(result_folder), resolved_case.get("measures") or []
    measures = {request["name"]: find_measure(request["name"]) for request in requests}
    of_snapshots = [m for m in measures.values() if m.summary != "run"]
    run = read_json(folder / "run.json") if len(of_snapshots) < len(measures) else {}
    series, readings, finals = None, {}, {}
    if of_snapshots:
        resolved = (resolved_case.get("surrounding") or {}).get("resolved")
        series = read_series(folder, fraction_when_absent=None if resolved else 1.0)
        windows = {id(request): window(request, series, resolved_case) for request in requests}
        readings, finals = _read_all(series, resolved_case, requests, measures, windows)
        _write_table(folder / "measures.csv", series, readings, measures)
    results = []
    for request in requests:
        chosen = measures[request["name"]]
        if chosen.summary == "run":
            reading = chosen.read(run)
        elif chosen.summary == "last":
            reading = finals.get(id(request)) or _no_snapshot(request)
        else:
            found = windows[id(request)]
            reading = (chosen.combine or summary)([readings[chosen.name][index] for index in found]) \
                if found else _no_snapshot(request)
        results.append(_judged(request, chosen, reading, resolved_case))
    return results


def window(request: dict, series: Series, case: dict) -> list[int]:
    """Numbers of the snapshots in `between` (s, both ends in, to a hundredth of the output interval); without it, the last.

    Empty where the run ended before `between` begins.
    """
    between = request.get("between")
    if not between:
        return [len(series) - 1]
    slack = 0.01 * case["time"]["output_interval"]
    return [index for index, time in enumerate(series.times) if between[0] - slack <= time <= between[1] + slack]


def summary(readings: list[Reading]) -> Reading:
    """Mean of readings with their standard deviation as uncertainty; readings without a value are counted in the note."""
    values = [reading.value for reading in readings if reading.value is not None]
    missing = len(readings) - len(values)
    notes = list(dict.fromkeys(reading.note for reading in readings if reading.note))
    parts = [f"{missing} of {len(readings)} snapshots could not be measured"] if missing and len(readings) > 1 else []
    parts += notes[-1:] if missing == 0 or not values else notes[:1]
    if not values:
        return Reading(None, note="; ".join(parts))
    spread = float(np.std(values, ddof=1)) if len(values) > 1 else readings[0].uncertainty
    expected = [reading.expected for reading in readings if reading.value is not None and reading.expected is not None]
    return Reading(float(np.mean(values)), uncertainty=spread, note="; ".join(parts),
                   expected=float(np.mean(expected)) if len(expected) == len(values) else None)


def _no_snapshot(request: dict) -> Reading:
    begin, end = request["between"]
    return Reading(None, note=f"no snapshot between {begin:g} and {end:g} s")


def _read_all(series: Series, case: dict, requests: list[dict], measures: dict[str, Measure],
              windows: dict[int, list[int]]):
    """Readings of each per-snapshot measure (a list over snapshots), and the one of each request for the last snapshot."""
    every = [m for m in measures.values() if m.summary == "mean"]
    readings: dict[str, list[Reading]] = {m.name: [] for m in every}
    finals: dict[int, Reading] = {}
    first = None
    for index in range(len(series)):
        last = [r for r in requests
                if measures[r["name"]].summary == "last" and windows[id(r)][-1:] == [index]]
        if not every and not last:
            continue
        snapshot = Snapshot(series.load(index), case, first)
        first = first or snapshot
        for chosen in every:
            snapshot.elements.require(*chosen.needs, by=chosen.name)
            readings[chosen.name].append(chosen.read(snapshot))
        for request in last:
            chosen = measures[request["name"]]
            snapshot.elements.require(*chosen.needs, by=chosen.name)
            begin = (request.get("between") or [0.0])[0]
            finals[id(request)] = chosen.read(snapshot.within(begin, snapshot.elements.time))
    return readings, finals


def _judged(request: dict, chosen: Measure, reading: Reading, case: dict) -> dict:
    reference = request.get("reference") or {}
    kind, expected = reference.get("kind"), reference.get("value")
    if kind in ("exact", "tabulated") and expected is None:
        expected = reading.expected
        if expected is None and chosen.exact is None:
            raise MeasureError(f"resolved case: measure '{chosen.name}' has no exact reference of its own; "
                               "give its value in the case file")
        if expected is None:
            expected = chosen.exact(case)
    elif kind == "exact":
        reading = replace(reading, note=_and(reading.note, _disagreement(chosen, reading, expected, case)))
    row = {
        "name": chosen.name, "value": _number(reading.value), "unit": chosen.unit,
        "uncertainty": _number(reading.uncertainty), "reference": _number(expected), "reference_kind": kind,
        "source": reference.get("source") or "", "metric": request.get("metric"), "tolerance": _number(request.get("tolerance")),
    }
    if reference.get("solver"):
        row["reference_solver"] = reference["solver"]
    if reading.note:
        row["note"] = reading.note
    if row["metric"] == "relative" and row["reference"] == 0.0:
        raise MeasureError(f"resolved case: measure '{chosen.name}' has a reference of 0, which needs metric 'absolute'")
    return judge(row, is_reference=kind == "solver")


def _disagreement(chosen: Measure, reading: Reading, given: float, case: dict) -> str:
    """What to say where an exact reference in the case file is not the one that the measure itself computes."""
    try:
        computed = reading.expected if reading.expected is not None else chosen.exact(case) if chosen.exact else None
    except MeasureError:
        return ""   # the measure knows no exact value for such a case; its file gives one
    if computed is None or math.isclose(given, computed, rel_tol=SAME_REFERENCE, abs_tol=1e-12):
        return ""
    return f"the case file's exact reference is {given:.6g}, computed from the case it is {computed:.6g}"


def _and(*notes: str) -> str:
    return "; ".join(note for note in notes if note)


def _number(value) -> float | None:
    return float(value) if value is not None and math.isfinite(value) else None


def _write_table(path: Path, series: Series, readings: dict[str, list[Reading]], measures: dict[str, Measure]) -> None:
    """One row a snapshot: time_s, each measure with its unit, and what it puts beside."""
    columns: dict[str, list] = {"time_s": list(series.times)}
    for name, found in readings.items():
        columns[name + _suffix(measures[name].unit)] = [reading.value for reading in found]
        for key in dict.fromkeys(key for reading in found for key in reading.beside):
            columns[f"{name}_{key}"] = [reading.beside.get(key) for reading in found]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values()):
        writer.writerow("" if _number(value) is None else repr(float(value)) for value in row)
    write_whole(path, text.getvalue())


def _suffix(unit: str) -> str:
    return "" if unit == "1" else "_" + unit.replace("/", "_per_")
