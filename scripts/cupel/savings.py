"""`./cupel bench --savings`: what "only what moves" is worth, each saving against the full computation.

A short 20 um track on powder (150 W, 0.8 ms) is computed with every saving and then without each of them in turn
(`numerics.without_saving`): CPU seconds, and width and depth of the melt pool, means over the second half.

The melt is a hundred times as viscous as steel. Steel's is chaotic: the order of sums alone, which is all that lists
made anew everywhere change, moves width and depth by some per cent in half a millisecond, so that a single pair of runs
cannot tell a per cent. Melt that creeps does all the same things (it melts, flows, is pressed down, drawn along and
freezes) and forgets what round-off did.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

from . import cases
from .errors import CupelError
from .measures import measure
from .results import read_json
from .solvers import command, environment

CASE, LEVEL, END_MS = "slm_track_150w", "coarse", 0.8
#: Times the melt's own viscosity.
VISCOSITY_FACTOR = 100.0
SAVINGS = ("moving_momentum", "thermal_clock", "local_lists", "kept_sums")


def run_savings(end_ms: float = END_MS, case: str = CASE, overrides: tuple[str, ...] = ()) -> dict:
    """CPU seconds, width and depth (m) with all savings, and for each what leaving it out costs and changes.

    Errors: CupelError where a run does not end well.
    """
    with tempfile.TemporaryDirectory() as folder:
        table = {"none": _run(Path(folder), "none", case, end_ms, overrides)}
        for saving in SAVINGS:
            table[saving] = _run(Path(folder), saving, case, end_ms, overrides)
    base = table["none"]
    for row in table.values():
        row["times_slower"] = round(row["cpu_s"] / base["cpu_s"], 2)
        for size in ("width", "depth"):
            row[f"{size}_change"] = round(row[size] / base[size] - 1.0, 5) if base[size] else None
    return table


def _run(folder: Path, without: str, case: str, end_ms: float, overrides: tuple[str, ...]) -> dict:
    resolved = cases.resolve(cases.find_case(case), LEVEL,
                             [f"time.end={end_ms} ms", "time.output_interval=0.05 ms", *overrides,
                              f'numerics.without_saving="{without}"'])
    for material in resolved["materials"].values():
        if material.get("viscosity") is not None:
            material["viscosity"] *= VISCOSITY_FACTOR
    names = ("melt_pool_width", "melt_pool_depth")
    half = [0.5e-3 * end_ms, 1e-3 * end_ms]
    resolved["measures"] = [request | {"between": half} for request in resolved["measures"] if request["name"] in names]
    case_file = folder / f"{without}.json"
    case_file.write_text(json.dumps(resolved))
    result = folder / without
    done = subprocess.run(command("sph", case_file, result, threads=1, resume=False), env=environment(1),
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise CupelError(f"the run without {without} ended with status {done.returncode}: {done.stderr.strip()}")
    sizes = {reading["name"]: reading["value"] for reading in measure(result, resolved)}
    return {"cpu_s": round(read_json(result / "run.json")["cost"]["cpu_s"], 2),
            "width": sizes["melt_pool_width"], "depth": sizes["melt_pool_depth"]}


def print_savings(table: dict) -> None:
    """The table for a reader."""
    print(f"{CASE} at {LEVEL}, {END_MS} ms, melt {VISCOSITY_FACTOR:.0f} times as viscous: without the saving")
    for name, row in table.items():
        print(f"  {name:18}{row['cpu_s']:9.1f} CPU s{row['times_slower']:8.2f} times"
              f"   width {1e6 * row['width']:6.1f} um ({row['width_change']:+.2%})"
              f"   depth {1e6 * row['depth']:5.1f} um ({row['depth_change']:+.2%})")
