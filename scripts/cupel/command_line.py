"""The commands. Each reads as the list of what it does; the work is in the modules beside this one."""

from __future__ import annotations

import hashlib
import os
import re
import sys
from enum import Enum
from pathlib import Path
from typing import List, Optional

import typer

from . import cases as case_files
from . import testing
from .comparison import fill_solver_references
from .display import make_display
from .errors import CupelError
from .formulations import DEFAULT, FORMULATIONS, overrides_of, variant_of
from .jobs import Job
from .layout import LEVELS, SOLVERS, TIERS, ResultPlace, places, results_root
from .runner import Runner
from .solvers import refusal

app = typer.Typer(
    name="cupel", no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None,
    help="Verification and benchmark suite for SPH melt-pool simulation. `cupel run` does the main job.",
)

Level = Enum("Level", {level: level for level in LEVELS}, type=str)
Tier = Enum("Tier", {tier: tier for tier in TIERS}, type=str)
Formulation = Enum("Formulation", {name: name for name in FORMULATIONS}, type=str)
Solver = Enum("Solver", {name: name for name in (*SOLVERS, "both", "external")}, type=str)

CASES = typer.Argument(None, metavar="[CASE]...",
                       help="Cases (all variations), single variations, or paths of case files; none: the canonical ones.")
TIER = typer.Option(None, help="All cases of a tier instead of named ones.")
LEVEL = typer.Option(Level.coarse, help="How fine: what it means is in each case file.")
SOLVER = typer.Option(Solver.both, help="Which solver.")
RESULTS = typer.Option(None, "--results", metavar="DIR", help="Folder of results; default: results in the repository.")
QUIET = typer.Option(False, "--quiet", help="Only a line when a run starts and when it ends.")
FORMULATION = typer.Option(DEFAULT, help="Set of SPH numerics; results go to the variant LEVEL-FORMULATION, beside the default ones.")
VARIANT = typer.Option(None, metavar="NAME", help="Name of the variant; default: the level, with a tag for --set.")


@app.command()
def run(
    names: Optional[List[str]] = CASES,
    level: Level = LEVEL,
    tier: Optional[Tier] = TIER,
    solver: Solver = SOLVER,
    formulation: Formulation = FORMULATION,
    resume: bool = typer.Option(False, "--resume", help="Go on: keep finished runs, continue from checkpoints."),
    quiet: bool = QUIET,
    jobs: Optional[int] = typer.Option(None, min=1, help="Runs side by side; default: one a core."),
    threads: Optional[int] = typer.Option(None, min=1, help="Threads of each run; default: the cores shared out."),
    overrides: Optional[List[str]] = typer.Option(None, "--set", metavar="KEY=VALUE", help="Override a value of the case file."),
    variant: Optional[str] = VARIANT,
    results: Optional[Path] = RESULTS,
    external: Optional[Path] = typer.Option(None, "--from", metavar="DIR", help="With --solver external: results to take in."),
    report: bool = typer.Option(True, help="Write the report at the end."),
) -> int:
    """Run cases, measure, compare, and write the report."""
    root = results_root(results)
    if solver is Solver.external:
        from .external import take_in

        count = take_in(external, root)
        print(f"{count} results taken in from {external}", file=sys.stderr)
        return write_report(root) if report else 0
    variant = variant_name(variant_of(level.value, formulation.value), list(overrides or []), variant)
    overrides = overrides_of(formulation.value) + list(overrides or [])
    chosen = case_files.select_members(names, tier and tier.value, level.value)
    resolved = [member.resolve(level.value, overrides) for member in chosen]
    solvers = solvers_of(solver, formulation)
    cores = len(os.sched_getaffinity(0))
    wanted = [(case, name) for case in resolved for name in solvers if not left_out(name, case)]
    if not wanted:
        raise CupelError("nothing is left to run", status=2)
    slots = min(jobs or cores, len(wanted))
    work = [
        Job(ResultPlace(root, case["name"], name, variant), case, threads=threads or max(1, cores // slots), resume=resume)
        for case, name in wanted
    ]
    interrupted = Runner(work, slots, make_display(quiet)).run()
    for case in resolved:
        fill_solver_references(root, case["name"], variant)
    if interrupted:
        print("cupel: interrupted; go on with --resume", file=sys.stderr)
        return 130
    bad = [job for job in work if not job.good]
    if report:
        shown = variant if formulation.value == DEFAULT else level.value   # formulations stand beside the default
        write_report(root, [job.place.case for job in work] + [place.case for place in places(root, variants=[shown])], shown)
    if bad:
        raise CupelError(f"{len(bad)} of {len(work)} runs did not complete: {', '.join(str(job.place) for job in bad)}")
    return 0


def left_out(solver: str, case: dict) -> bool:
    """Whether a solver cannot run a resolved case, which is then said."""
    why = refusal(solver, case)
    if why:
        print(f"cupel: {case['name']}: left out of {solver}: {why}", file=sys.stderr)
    return why is not None


@app.command(context_settings={"allow_extra_args": True, "ignore_unknown_options": True})
def test(context: typer.Context) -> int:
    """Run every test: the C++ ones, then the Python ones (further arguments go to pytest)."""
    return testing.run_all(context.args)


@app.command()
def check(
    names: Optional[List[str]] = CASES,
    level: Level = LEVEL,
    tier: Optional[Tier] = TIER,
    solver: Solver = SOLVER,
    formulation: Formulation = FORMULATION,
    variant: Optional[str] = VARIANT,
    results: Optional[Path] = RESULTS,
    junit: Optional[Path] = typer.Option(None, metavar="FILE", help="JUnit XML; default: check.xml in the results folder."),
) -> int:
    """Judge results against their references; the exit status says whether all is well."""
    from .check import check_results

    root = results_root(results)
    members = case_files.select_members(names, tier and tier.value, level.value)
    solvers = solvers_of(solver, formulation)
    refused = {(member.name, name) for member in members for name in solvers if refusal(name, member.resolve(level.value))}
    return check_results(root, [member.name for member in members], solvers, variant or variant_of(level.value, formulation.value),
                         junit or root / "check.xml", refused)


@app.command()
def keep(
    names: Optional[List[str]] = CASES,
    level: Level = LEVEL,
    tier: Optional[Tier] = TIER,
    solver: Solver = SOLVER,
    formulation: Formulation = FORMULATION,
    results: Optional[Path] = RESULTS,
) -> int:
    """Keep completed results as data beside their cases, for what is too long to run each time."""
    from .kept import keep as keep_results

    if not names and tier is None:
        raise CupelError("name the cases to keep, or give --tier", status=2)
    chosen = case_files.select_members(names, tier and tier.value, level.value)
    solvers = solvers_of(solver, formulation)
    for folder in keep_results(results_root(results), chosen, solvers, level.value, formulation.value):
        print(folder)
    return 0


@app.command()
def report(
    names: Optional[List[str]] = typer.Argument(None, metavar="[CASE]...", help="Cases; none: all that have results."),
    variant: Optional[str] = typer.Option(None, metavar="NAME", help="Variant; default: coarse."),
    results: Optional[Path] = RESULTS,
) -> int:
    """Write the report again from results; prints its path."""
    root = results_root(results)
    return write_report(root, list(names) if names else None, variant or "coarse")


@app.command("cases")
def list_cases(tier: Optional[Tier] = TIER, results: Optional[Path] = RESULTS) -> int:
    """List the cases: what each is, its variations, its tolerances, its cost."""
    from .listing import print_cases

    print_cases(results, tier and tier.value)
    return 0


@app.command(context_settings={"allow_extra_args": True, "ignore_unknown_options": True}, add_help_option=False)
def bed(context: typer.Context) -> int:
    """Make the powder bed of a case again from its table of grains (./cupel bed --help)."""
    from . import bed as powder_bed

    return powder_bed.main(context.args) or 0


@app.command()
def bench(
    as_json: bool = typer.Option(False, "--json", help="JSON instead of a table."),
    quick: bool = typer.Option(False, "--quick", help="Small scenes only: seconds, to see that all works."),
    everything: bool = typer.Option(False, "--all", help="Up to ten million particles: minutes, several GiB."),
    savings: bool = typer.Option(False, "--savings", help="What computing only what moves is worth: minutes."),
    repetitions: int = typer.Option(3, min=1, help="Of each benchmark; the median counts."),
) -> int:
    """Time the SPH engine: updates a second, memory, and what each model costs."""
    from . import bench as benchmarks

    mode = "savings" if savings else "quick" if quick else "all" if everything else "default"
    return benchmarks.main(mode, repetitions, as_json)


@app.command()
def schema(
    of_result: bool = typer.Option(False, "--result", help="The schema of result.json instead of case files."),
) -> int:
    """Print the JSON schema of case files or of results."""
    from .results import SCHEMA_FILE

    print(SCHEMA_FILE.read_text().rstrip() if of_result else case_files.case_schema().rstrip())
    return 0


def solvers_of(solver: Solver, formulation: Formulation) -> tuple[str, ...]:
    """The solvers that are meant; a formulation is one of SPH's, and the reference has none."""
    if formulation.value != DEFAULT and solver is not Solver.sph:
        raise CupelError("--formulation is for SPH: give --solver sph", status=2)
    return SOLVERS if solver is Solver.both else (solver.value,)


def variant_name(level: str, overrides: list[str], choice: str | None) -> str:
    """The variant's name: the choice, or the level, with a tag that tells different overrides apart."""
    if choice is not None:
        if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_.+-]*", choice):
            raise CupelError(f"--variant '{choice}': use letters, digits, and _ . + - after the first", status=2)
        return choice
    if not overrides:
        return level
    return f"{level}-{hashlib.sha256(chr(10).join(sorted(overrides)).encode()).hexdigest()[:6]}"


def write_report(root: Path, names: list[str] | None = None, variant: str = "coarse") -> int:
    """Writes the report page and prints its path."""
    from reports.page import write_page

    page = write_page(root, None if names is None else list(dict.fromkeys(names)), variant)
    print(page)
    return 0
