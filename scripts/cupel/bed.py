"""`./cupel bed CASE`: makes the powder bed of a case with the discrete element method (LIGGGHTS).

Grains of a cut log-normal size distribution rain on the plate, settle under gravity (Hertz contact, sliding and rolling
friction, periodic sides), and a blade takes away every grain that stands out of the layer. What stays is written as a
small table of spheres that both solvers read. The same case and seed give the same table.

Source of the contact model: Hertz-Mindlin with history and a rolling-friction torque, as LIGGGHTS has it; the numbers
are the case's [powder] tables.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .cases import find_case, last_line
from .errors import CupelError, describe_system_error
from .layout import program

COLUMNS = "x_m,y_m,z_m,radius_m"
TIME_STEP_SHARE = 0.2  # of the Rayleigh time of the smallest grain
POUR_DEPTH = 1.7  # depth of the settled powder before the blade, in layer thicknesses
POUR_PACKING = 0.55  # packing fraction that this depth supposes
REST_SPEED = 5e-3  # m/s, root mean square: what is left would lift the grains by a thousandth of their size
CHUNK_TIME = 2e-4  # s of settling between two looks at the speed
LONGEST_SETTLING = 60  # chunks
# Grains this stiff pack alike under any weight as long as it hardly presses them together (here 400 Pa against 2 GPa);
# a hundred times the real one shortens fall and rebound, and so the computation, tenfold.
GRAVITY = 100 * 9.81  # m/s^2


@dataclass(frozen=True)
class Bed:
    """What makes a bed: plate area `lower` to `upper` (x, y) [m], `table` as the resolved case's `powder` (SI), `seed`."""

    lower: tuple[float, float]
    upper: tuple[float, float]
    table: dict
    seed: int

    @property
    def area(self) -> float:
        """Area of the plate under the powder [m^2]."""
        return (self.upper[0] - self.lower[0]) * (self.upper[1] - self.lower[1])

    @property
    def layer(self) -> float:
        """Height of the blade above the plate [m]."""
        return self.table["layer_thickness"]


def draw_diameters(count: int, table: dict, generator: np.random.Generator) -> np.ndarray:
    """`count` grain diameters [m]: log-normal about `median` with `spread`, cut at `minimum` and `maximum`."""
    kept = np.empty(0)
    while kept.size < count:
        drawn = table["median"] * np.exp(table["spread"] * generator.standard_normal(2 * count))
        kept = np.concatenate([kept, drawn[(drawn >= table["minimum"]) & (drawn <= table["maximum"])]])
    return kept[:count]


def rain(bed: Bed) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 3) [m] and diameters (n) [m] of the grains before they fall: jittered cells, none overlapping."""
    generator = np.random.Generator(np.random.PCG64(bed.seed))
    sizes = bed.table["diameter"]
    trial = draw_diameters(20000, sizes, np.random.Generator(np.random.PCG64(0)))
    grain_volume = np.pi / 6 * np.mean(trial**3)
    count = max(1, round(bed.area * POUR_DEPTH * bed.layer * POUR_PACKING / grain_volume))
    diameters = draw_diameters(count, sizes, generator)
    extent = np.subtract(bed.upper, bed.lower)
    across = np.floor(extent / (1.02 * sizes["maximum"])).astype(int)
    if across.min() < 2:
        raise CupelError("the plate is too narrow for a powder bed: it must hold two of the greatest grains side by side")
    cell = np.append(extent / across, 1.02 * sizes["maximum"])
    layers = -(-count // (across[0] * across[1]))
    places = np.stack(np.meshgrid(*(np.arange(n) for n in (*across, layers)), indexing="ij"), axis=-1).reshape(-1, 3)
    places = places[np.argsort(places[:, 2], kind="stable")][:count]
    room = cell - 1.01 * diameters[:, None]  # to move within the cell without touching the neighbours
    centers = (places + 0.5) * cell + (generator.random((count, 3)) - 0.5) * room
    centers[:, :2] += bed.lower
    return centers, diameters


def rayleigh_time(table: dict) -> float:
    """Time [s] in which a surface wave runs through the smallest grain; the contact time scale."""
    grain = table["grain"]
    shear_modulus = grain["young_modulus"] / (2 * (1 + grain["poisson_ratio"]))
    wave = (shear_modulus / grain["density"]) ** 0.5
    return np.pi * 0.5 * table["diameter"]["minimum"] / wave / (0.1631 * grain["poisson_ratio"] + 0.8766)


def data_file(bed: Bed, centers: np.ndarray, diameters: np.ndarray, height: float) -> str:
    """The grains in the format of LIGGGHTS's read_data (atom style granular)."""
    lines = ["grains of a powder bed", "", f"{len(diameters)} atoms", "2 atom types", ""]
    for axis, low, high in zip("xyz", (*bed.lower, 0.0), (*bed.upper, height)):
        lines.append(f"{low:.12e} {high:.12e} {axis}lo {axis}hi")
    lines += ["", "Atoms", ""]
    density = bed.table["grain"]["density"]
    for number, (center, diameter) in enumerate(zip(centers, diameters), 1):
        lines.append(f"{number} 1 {diameter:.12e} {density:.12e} " + " ".join(f"{value:.12e}" for value in center))
    return "\n".join(lines) + "\n"


def input_script(bed: Bed, height: float, rest_energy: float) -> str:
    """The LIGGGHTS script: type 1 is a grain, type 2 the plate; ends when the kinetic energy is below `rest_energy` [J]."""
    table = bed.table
    grain, plate = table["grain"], table["plate"]
    of_grain, of_plate = table["grain_contact"], table["plate_contact"]

    def pairs(key: str) -> str:
        return f"2 {of_grain[key]} {of_plate[key]} {of_plate[key]} {of_plate[key]}"

    step = TIME_STEP_SHARE * rayleigh_time(table)
    chunk = round(CHUNK_TIME / step)
    return f"""
atom_style granular
atom_modify map array
hard_particles yes
boundary p p f
newton off
communicate single vel yes
units si
read_data grains.data
neighbor {0.25 * table['diameter']['minimum']:.6e} bin
neigh_modify delay 0
fix elasticity all property/global youngsModulus peratomtype {grain['young_modulus']} {plate['young_modulus']}
fix compression all property/global poissonsRatio peratomtype {grain['poisson_ratio']} {plate['poisson_ratio']}
fix bounce all property/global coefficientRestitution peratomtypepair {pairs('restitution')}
fix sliding all property/global coefficientFriction peratomtypepair {pairs('friction')}
fix rolling all property/global coefficientRollingFriction peratomtypepair {pairs('rolling_friction')}
pair_style gran model hertz tangential history rolling_friction cdt
pair_coeff * *
fix plate all wall/gran model hertz tangential history rolling_friction cdt primitive type 2 zplane 0.0
fix lid all wall/gran model hertz tangential history rolling_friction cdt primitive type 2 zplane {height:.12e}
fix fall all gravity {GRAVITY} vector 0.0 0.0 -1.0
fix motion all nve/sphere
timestep {step:.9e}
thermo_style custom step atoms ke
thermo_modify lost error norm no
thermo {chunk}
variable round loop {LONGEST_SETTLING}
label settle
run {chunk}
variable energy equal ke
variable limit equal {rest_energy:.9e}
if "${{energy}} < ${{limit}}" then "jump SELF settled"
next round
jump SELF settle
label settled
write_dump all custom settled.dump id x y z radius vx vy vz modify sort id format "%d %.12e %.12e %.12e %.12e %.12e %.12e %.12e"
"""


def find_liggghts() -> str:
    """Path of the program; `CupelError` where it is not installed."""
    path = shutil.which("liggghts")
    if path is None:
        raise CupelError("LIGGGHTS is missing, which makes powder beds: install it with apt-get install liggghts")
    return path


def run_liggghts(script: str, data: str) -> np.ndarray:
    """Runs LIGGGHTS in a folder of its own; rows of x, y, z, radius, vx, vy, vz [SI] in the order of the grains."""
    liggghts = find_liggghts()
    with tempfile.TemporaryDirectory(prefix="cupel_bed_") as folder:
        Path(folder, "grains.data").write_text(data)
        Path(folder, "in.bed").write_text(script)
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        done = subprocess.run([liggghts, "-in", "in.bed", "-log", "none", "-nocite"], cwd=folder, env=environment,
                              capture_output=True, text=True)
        dump = Path(folder, "settled.dump")
        if done.returncode != 0 or not dump.is_file():
            said = [line for line in (done.stdout + done.stderr).splitlines() if "ERROR" in line]
            raise CupelError("LIGGGHTS failed: " + (said[0] if said else f"exit status {done.returncode}"))
        return np.loadtxt(dump, skiprows=9, ndmin=2)[:, 1:]


def settle(bed: Bed) -> np.ndarray:
    """Spheres (n, 4: x, y, z, radius) [m] at rest on the plate, before the blade. `CupelError` where they do not rest."""
    centers, diameters = rain(bed)
    height = centers[:, 2].max() + bed.table["diameter"]["maximum"]
    mass = bed.table["grain"]["density"] * np.pi / 6 * np.sum(diameters**3)
    rows = run_liggghts(input_script(bed, height, 0.5 * mass * REST_SPEED**2), data_file(bed, centers, diameters, height))
    if len(rows) != len(diameters):
        raise CupelError(f"LIGGGHTS lost {len(diameters) - len(rows)} grains of {len(diameters)}")
    speed = float(np.sqrt(np.average((rows[:, 4:7] ** 2).sum(axis=1), weights=rows[:, 3] ** 3)))
    if not speed < REST_SPEED:
        raise CupelError(f"the powder is not at rest after {LONGEST_SETTLING * CHUNK_TIME * 1e3:g} ms "
                         f"(speed {speed:.3g} m/s): take less restitution or more friction")
    spheres = rows[:, :4].copy()
    extent = np.subtract(bed.upper, bed.lower)
    spheres[:, :2] = bed.lower + np.mod(spheres[:, :2] - bed.lower, extent)
    return spheres


def rake(spheres: np.ndarray, layer: float) -> np.ndarray:
    """What a blade at height `layer` [m] leaves of the spheres: those that it does not touch, sorted by place."""
    left = spheres[spheres[:, 2] + spheres[:, 3] <= layer]
    return left[np.lexsort((left[:, 2], left[:, 1], left[:, 0]))]


def make_bed(bed: Bed) -> np.ndarray:
    """Spheres (n, 4: x, y, z, radius) [m] of the finished bed."""
    spheres = rake(settle(bed), bed.layer)
    if len(spheres) == 0:
        raise CupelError("the blade left no grain: the layer is thinner than the grains, raise powder.layer_thickness")
    return spheres


def packing_fraction(spheres: np.ndarray, bed: Bed) -> float:
    """Volume of the grains over the volume of the layer."""
    return float(4 / 3 * np.pi * np.sum(spheres[:, 3] ** 3) / (bed.area * bed.layer))


def liggghts_version() -> str:
    """How LIGGGHTS calls itself."""
    said = subprocess.run([find_liggghts(), "-help"], capture_output=True, text=True).stdout
    first = next((line for line in said.splitlines() if line.startswith("LIGGGHTS")), "LIGGGHTS")
    return first.split(",")[0].split("Version ")[-1]


def bed_text(bed: Bed, spheres: np.ndarray, case: str) -> str:
    """The table of spheres with a head that says how it was made."""
    head = [
        f"# Powder bed, made by ./cupel bed {case} --seed {bed.seed} (scripts/cupel/bed.py)",
        f"# code: {liggghts_version()}; seed: {bed.seed}; grains: {len(spheres)}; "
        f"packing fraction of the layer: {packing_fraction(spheres, bed):.3f}",
        f"# plate: x {bed.lower[0]:g} to {bed.upper[0]:g} m, y {bed.lower[1]:g} to {bed.upper[1]:g} m, surface at z = 0",
        "# table (SI): " + json.dumps(bed.table | {"seed": bed.seed}, sort_keys=True),
        COLUMNS,
    ]
    rows = [",".join(f"{value:.6e}" for value in row) for row in spheres]
    return "\n".join(head + rows) + "\n"


def read_bed(path: Path) -> np.ndarray:
    """Spheres (n, 4: x, y, z, radius) [m] of a bed file. `CupelError` where it is not one."""
    try:
        lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
        if not lines or lines[0] != COLUMNS:
            raise ValueError(f"the columns are not {COLUMNS}")
        return np.array([[float(value) for value in line.split(",")] for line in lines[1:]]).reshape(-1, 4)
    except OSError as error:
        raise describe_system_error(error, path) from None
    except ValueError as error:
        raise CupelError(f"{path}: no powder bed ({error}); make it again with ./cupel bed CASE") from None


def resolve_without_bed(case_file: Path, overrides: list[str]) -> dict:
    """The resolved case, of which the bed may still be missing. `CupelError` with the case reader's own line."""
    command = [str(program("cupel_case")), "resolve", str(case_file), "--without-files"]
    done = subprocess.run(command + [part for text in overrides for part in ("--set", text)], capture_output=True, text=True)
    if done.returncode != 0:
        raise CupelError(last_line(done.stderr) or f"{case_file}: the case reader failed", status=2)
    return json.loads(done.stdout)


def bed_of_case(resolved: dict, seed: int | None) -> tuple[Bed, Path]:
    """The bed that a resolved case asks for, and the file in which the case looks for it."""
    bodies = [body for body in resolved["bodies"] if body["shape"] == "powder_bed"]
    if not bodies or resolved["powder"] is None:
        raise CupelError(f"the case {resolved['name']} has no powder bed: it needs [powder] and a body of the shape powder_bed",
                         status=2)
    body, table = bodies[0], dict(resolved["powder"])
    if body["lower"][2] != 0.0:
        raise CupelError("a powder bed lies on the plate: lower z of its body must be 0", status=2)
    own_seed = table.pop("seed")
    return Bed(tuple(body["lower"][:2]), tuple(body["upper"][:2]), table, seed or own_seed), Path(body["file"])


def write_whole(path: Path, text: str) -> None:
    """Writes a file whole or not at all."""
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        beside.write_text(text)
        os.replace(beside, path)
    except OSError as error:
        raise describe_system_error(error, path) from None
    finally:
        beside.unlink(missing_ok=True)


def main(arguments: list[str]) -> int:
    """Command line of `./cupel bed`. Prints the path of the bed; raises `CupelError`."""
    parser = argparse.ArgumentParser(prog="cupel bed", description="Make the powder bed of a case with LIGGGHTS.")
    parser.add_argument("case", help="name of a case, or the path of a case file")
    parser.add_argument("--seed", type=int, help="seed of the random bed; default: the case's")
    parser.add_argument("--output", type=Path, help="file to write; default: the file that the case names")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override a value of the case")
    options = parser.parse_args(arguments)
    if options.seed is not None and options.seed < 1:
        raise CupelError("--seed must be 1 or more", status=2)
    resolved = resolve_without_bed(find_case(options.case), options.set)
    bed, path = bed_of_case(resolved, options.seed)
    print(f"{bed.table['layer_thickness'] * 1e6:g} um of powder on {bed.area * 1e6:g} mm^2, seed {bed.seed}: "
          "settling takes a minute or two", file=sys.stderr, flush=True)
    spheres = make_bed(bed)
    target = options.output or path
    write_whole(target, bed_text(bed, spheres, resolved["name"]))
    print(f"{len(spheres)} grains, packing fraction {packing_fraction(spheres, bed):.3f}", file=sys.stderr)
    print(target)
    return 0
