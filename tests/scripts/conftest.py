"""Stand-ins for the programs that the build makes, to test what the orchestration does with their every behaviour."""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

# Prints a resolved case; `--set behaviour=...` and `--set steps=...` become settings that the stand-in solver follows.
CASE_READER = """#!/usr/bin/python3
import sys
sys.path[:0] = [{root!r}]
import json
from tests import synthetic
if sys.argv[1] == "schema":
    print(json.dumps({{"title": "case"}}))
    sys.exit(0)
name = sys.argv[2].split("/")[-2]
if sys.argv[1] == "summary":
    member = {{"name": name, "variation": None, "title": "stand-in", "levels": ["coarse", "medium", "fine"]}}
    print(json.dumps({{"tier": "v0", "members": [member]}}))
    sys.exit(0)
settings = dict(text.split("=", 1) for text in sys.argv[3:] if "=" in text)
if "bad" in settings:
    print(f"{{sys.argv[2]}}:3:1: laser.pwoer: unknown key; did you mean 'laser.power'?", file=sys.stderr)
    sys.exit(2)
case = synthetic.resolved_drop(4e-4) | {{"name": name, "numerics": settings}}
case["time"] = {{"end": 0.02, "output_interval": 0.01}}
print(json.dumps(synthetic.with_hash(case)))
"""

# Behaviours: good, crash, stop, refuse, silent, slow (interruptible, leaves a checkpoint), full (of its disk, the first
# time), vanish (waits until its folder is not there any more).
SOLVER = """#!/usr/bin/python3
import sys
sys.path[:0] = [{root!r}]
import json, os, pathlib, signal, time
from tests import synthetic
case, folder, resume = json.load(open(sys.argv[2])), pathlib.Path(sys.argv[4]), "--resume" in sys.argv
behaviour = case["numerics"].get("behaviour", "good")
started = folder / "started.txt"
started.write_text((started.read_text() if started.exists() else "") + ("resumed" if resume else "fresh") + "\\n")
if behaviour == "crash":
    print("thread 0: out of memory", file=sys.stderr)
    os.kill(os.getpid(), signal.SIGKILL)
if behaviour == "refuse":
    print("case.json: laser.power: must be positive", file=sys.stderr)
    sys.exit(2)
def leave_checkpoint():
    (folder / "checkpoints").mkdir(exist_ok=True)
    (folder / "checkpoints" / "checkpoint_000001.h5").write_text("state")
def interrupted(number, frame):
    leave_checkpoint()
    sys.exit(130)
if behaviour == "full" and not resume:
    leave_checkpoint()
    print("cupel_sph: fields_000007.vtp: cannot be written: the disk is full; free some space, then go on with --resume", file=sys.stderr)
    sys.exit(1)
if behaviour == "missing" and not resume:
    leave_checkpoint()
    print("cupel_sph: case.json: bodies[1].file: there is no bed bed_seed1.csv; make it with: ./cupel bed odd_drop", file=sys.stderr)
    sys.exit(2)
while behaviour == "vanish":
    if not folder.exists():
        print(f"cupel_sph: {{folder}}/history.csv: cannot be written: the folder or file is not there", file=sys.stderr)
        sys.exit(1)
    time.sleep(0.01)
signal.signal(signal.SIGINT, interrupted)
signal.signal(signal.SIGTERM, interrupted)
if behaviour == "slow" and not resume:
    for step in range(200):
        print(json.dumps({{"progress": {{"time": 1e-4 * step, "end": 0.02, "step": step, "wall_s": 0.05 * step}}}}), flush=True)
        time.sleep(0.05)
print(json.dumps({{"progress": {{"time": 0.02, "end": 0.02, "step": 200, "wall_s": 1.0}}}}), flush=True)
if behaviour == "silent":
    sys.exit(0)
if behaviour == "stop":
    account = synthetic.run_record(case, "sph") | {{"status": "stopped", "diagnosis": "particle 7 left the domain; reduce the time step"}}
    (folder / "run.json").write_text(json.dumps(account))
    print(account["diagnosis"], file=sys.stderr)
    sys.exit(1)
synthetic.write_fields(folder, "sph", case, 0.0)
(folder / "history.csv").write_text("time_s,kinetic_energy_J\\n0,0\\n")
(folder / "run.json").write_text(json.dumps(synthetic.run_record(case, "sph")))
"""


@pytest.fixture
def stand_ins(tmp_path: Path) -> dict[str, str]:
    """Environment whose programs are the stand-ins."""
    root, folder = str(Path(__file__).resolve().parents[2]), tmp_path / "build" / "bin"
    folder.mkdir(parents=True)
    for name, text in (("cupel_case", CASE_READER), ("cupel_sph", SOLVER)):
        path = folder / name
        path.write_text(text.format(root=root))
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return {"CUPEL_BUILD": str(folder.parent)}


@pytest.fixture
def run_case(cupel, stand_ins, tmp_path):
    """Runs a case file of its own in the stand-in solver: `run_case("--set", "behaviour=stop")`."""
    case = tmp_path / "odd_drop" / "case.toml"
    case.parent.mkdir()
    case.write_text("title = 'stand-in'\n")

    def call(*arguments, **more):
        return cupel("run", case, "--solver", "sph", "--variant", "v", "--quiet", "--no-report",
                     "--results", tmp_path / "results", *arguments, env=stand_ins, **more)

    call.case, call.folder = case, tmp_path / "results" / "odd_drop" / "sph" / "v"
    call.results, call.environment = tmp_path / "results", stand_ins
    return call
