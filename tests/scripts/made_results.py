"""Results made up from a value, without a run: what comes after a result needs no more."""

from __future__ import annotations

from pathlib import Path

from cupel.comparison import judge
from cupel.layout import ResultPlace
from cupel.results import write_result


def made_result(root: Path, solver: str, level: str, spacing: float, value: float, status: str = "completed", case: str = "made",
                commit: str = "0123456789ab", case_hash: str = "h", **measure) -> ResultPlace:
    """Writes a result of one measure, melt_pool_width; returns its place. `measure` overrides keys of the measure."""
    row = judge({"name": "melt_pool_width", "value": value, "unit": "m", "uncertainty": None, "reference": 1.0, "reference_kind": "exact",
                 "source": "made", "metric": "relative", "tolerance": 0.1} | measure)
    place = ResultPlace(root, case, solver, level)
    place.folder.mkdir(parents=True, exist_ok=True)
    settings = {"name": case, "hash": case_hash, "spacing": spacing, "physics": [], "laser": None}
    write_result(place.folder, {
        "schema": 1, "case": case, "solver": solver, "variant": level, "status": status,
        "diagnosis": "" if status == "completed" else "too hot", "code": {"version": "0.1.0", "commit": commit},
        "host": {"name": "made"}, "settings": settings, "measures": [row], "ledgers": {},
        "cost": {"wall_s": 1.0, "steps": 1, "elements": 1},
    })
    return place
