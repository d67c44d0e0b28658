"""What each remedy of SPH does: the same measures of the same cases in each set of numerics, side by side."""

from __future__ import annotations

from pathlib import Path

from cupel.comparison import Row
from cupel.formulations import DEFAULT, FORMULATIONS, parts_of, variant_of
from cupel.judging import Judged, judged_at
from cupel.layout import ResultPlace

from .formatting import limit, number, percent, quantity, quantity_name, signed, signed_percent
from .gather import Case


def formulations_block(root: Path, cases: list[Case], variant: str) -> dict:
    """The table of a level: a row a measure, a column a formulation that any of `cases` has been run with; {"columns": []} if none has."""
    parts = parts_of(variant)
    if parts is None or parts[1] != DEFAULT:
        return {"columns": [], "rows": []}
    level = parts[0]
    results = {case.name: {name: found for name in FORMULATIONS
                           if (found := judged_at(ResultPlace(root, case.name, "sph", variant_of(level, name)))).result is not None}
               for case in cases}
    results = {name: found for name, found in results.items() if set(found) - {DEFAULT}}
    columns = [name for name in FORMULATIONS if any(name in found for found in results.values())]
    return {
        "columns": [{"name": name.replace("_", " "), "what": FORMULATIONS[name][0]} for name in columns],
        "rows": [line for case in cases if case.name in results for line in _lines(case, results[case.name], columns)],
    }


def _lines(case: Case, results: dict[str, Judged], columns: list[str]) -> list[dict]:
    """The rows of one case. A run that did not complete says so in the first row of its column."""
    rows = {name: {row.quantity: row for row in judged.rows if row.reference_kind != "kept"} for name, judged in results.items()}
    quantities = list(dict.fromkeys(quantity for found in rows.values() for quantity in found if quantity != "run"))
    lines = []
    for position, name in enumerate(quantities):
        known = next(found[name] for found in rows.values() if name in found)
        cells = [_cell(rows.get(column), name, position == 0) for column in columns]
        lines.append({"case": case.name, "title": case.title, "first": position == 0, "count": len(quantities), "quantity": quantity_name(name),
                      "tolerance": _tolerance(known), "cells": cells})
    return lines


def _cell(rows: dict[str, Row] | None, name: str, first: bool) -> dict:
    """One number: its error where there is one, else its value; with the verdict and what there is to say."""
    if rows is None:
        return {"text": "–", "verdict": "none", "title": "not run"}
    if name not in rows:
        stopped = rows.get("run")
        return {"text": "stopped" if stopped else "–", "verdict": "fail" if stopped else "none", "title": stopped.note if stopped and first else ""}
    row = rows[name]
    if row.value is None:
        return {"text": "none", "verdict": row.verdict, "title": row.note}
    if row.error is None:
        text = quantity(row.value, row.unit, digits=3)
    elif row.metric == "relative":
        text = signed_percent(row.error)
    else:
        text = number(row.error, 2) if row.reference == 0.0 and row.unit in ("1", "") else signed(quantity(row.error, row.unit, row.reference or row.value, 3))
    return {"text": text, "verdict": row.verdict, "title": row.note}


def _tolerance(row: Row) -> str:
    if row.tolerance is None:
        return "–"
    return f"± {percent(row.tolerance)}" if row.metric == "relative" else f"± {limit(row.tolerance, row.unit, row.reference or row.value)}"
