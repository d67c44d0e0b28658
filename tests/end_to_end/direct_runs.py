"""Runs of cupel_sph itself, without the command line around it, and what they leave."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
from cupel import cases
from cupel.layout import program

# Every thermal and every surface model at some 15 000 steps a second: a melt of 238 particles under a beam that makes it
# splash, so that particles melt, freeze, fly as spray and leave the domain.
SMALL_MELT = """
title      = "A small melt under a beam"
dimensions = 2
physics    = ["flow", "surface_tension", "wetting", "marangoni", "recoil", "evaporation", "radiation", "laser", "heat", "melting"]

[resolution]
coarse = "20 um"

[material.steel]
use = "304L"

[material.argon]
use = "argon"

[surrounding]
material    = "argon"
resolved    = false
temperature = "300 K"

[domain]
lower = ["0 mm", "0 mm", "-0.1 mm"]
upper = ["0.4 mm", "0 mm", "0.1 mm"]

[domain.boundaries]
x_min = { kind = "wall" }
x_max = { kind = "wall" }
z_min = { kind = "wall" }
z_max = { kind = "open" }

[initial]
temperature = "1700 K"

[[body]]
shape    = "box"
material = "steel"
state    = "liquid"
lower    = ["0 mm", "0 mm", "-0.1 mm"]
upper    = ["0.4 mm", "0 mm", "0 mm"]

[laser]
power         = "10 W"
speed         = "0.01 m/s"
spot_diameter = "100 um"
path          = { from = ["0.1 mm", "0 mm"], to = ["0.3 mm", "0 mm"] }

[time]
end             = "2 ms"
output_interval = "0.02 ms"
"""


def small_melt(folder: Path, *overrides: str) -> Path:
    """The resolved small melt, below `folder`."""
    return resolved(write_case(folder, "small_melt", SMALL_MELT), folder, *overrides)


def write_case(folder: Path, name: str, text: str) -> Path:
    path = folder / name / "case.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def resolved(case: Path, folder: Path, *overrides: str) -> Path:
    """Writes what `case` says at level coarse, with `overrides`, to a file below `folder`."""
    target = folder / f"{case.parent.name}.json"
    target.write_text(json.dumps(cases.resolve(case, "coarse", overrides)))
    return target


def command(case: Path, folder: Path, *more: str) -> list[str]:
    return [str(program("cupel_sph")), "run", str(case), "--output", str(folder), "--threads", "1", *more]


def solve(case: Path, folder: Path, *more: str, timeout: float = 300) -> subprocess.CompletedProcess:
    return subprocess.run(command(case, folder, *more), capture_output=True, text=True, timeout=timeout)


def one_line(errors: str, *words: str) -> str:
    """The text, which has to be one line with all `words` in it."""
    assert len(errors.strip().splitlines()) == 1, errors
    assert all(word in errors for word in words), errors
    return errors.strip()


def record(folder: Path) -> dict:
    return json.loads((folder / "run.json").read_text())


def step_of(checkpoint: Path) -> int:
    return int(checkpoint.stem.removeprefix("checkpoint_"))


def newest_checkpoint(folder: Path) -> Path | None:
    return max((folder / "checkpoints").glob("checkpoint_*.h5"), key=step_of, default=None)


def snapshots(folder: Path) -> list[Path]:
    return sorted((folder / "fields").glob("fields_*.vtp"))


def listed_snapshots(folder: Path) -> list[str]:
    """Names in fields.pvd, which lists whole snapshots only."""
    series = folder / "fields" / "fields.pvd"
    return [line.split('file="')[1].split('"')[0] for line in series.read_text().splitlines() if "<DataSet" in line] if series.exists() else []


def assert_same_run(one: Path, other: Path) -> None:
    """Every snapshot and every row of history of two runs are the same, byte for byte."""
    assert [path.name for path in snapshots(one)] == [path.name for path in snapshots(other)]
    assert (one / "fields" / "fields.pvd").read_bytes() == (other / "fields" / "fields.pvd").read_bytes()
    assert (one / "history.csv").read_bytes() == (other / "history.csv").read_bytes()
    different = [a.name for a, b in zip(snapshots(one), snapshots(other)) if a.read_bytes() != b.read_bytes()]
    assert not different, f"snapshots differ: {different[:5]}"


def assert_nothing_half_written(folder: Path) -> None:
    """No file that was being prepared is left, none is empty, and the series lists exactly the snapshots that are there."""
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert not [path for path in files if path.name.endswith(".beside")]
    assert all(path.stat().st_size > 0 for path in files), [path for path in files if path.stat().st_size == 0]
    assert set(listed_snapshots(folder)) <= {path.name for path in snapshots(folder)}
    assert not (folder / "run.json").exists(), "a run that did not end well must not look finished"


def checkpoint_fields(checkpoint: Path) -> dict[str, np.ndarray]:
    """All arrays of a checkpoint by their path, without the clocks, which no two runs have alike."""
    import h5py

    arrays = {}
    with h5py.File(checkpoint) as file:
        file.visititems(lambda name, item: arrays.update({name: item[()]}) if isinstance(item, h5py.Dataset) and item.shape else None)
        arrays["step"], arrays["time"] = file.attrs["step"], file.attrs["time"]
        clocks = {"recorder.wall_s", "recorder.cpu_s", "recorder.output_s", "recorder.guards_s"}
        arrays |= {name: value for name, value in file["numbers"].attrs.items() if name not in clocks}
    return arrays
