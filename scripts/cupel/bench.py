"""`./cupel bench`: runs the benchmarks of the engine and makes one table of them.

Rates are million particle updates a second of one core (CPU seconds of all threads), medians of repetitions of several
steps each; `tests/benchmarks/README.md` says what each scene is.
"""

from __future__ import annotations

import json
import subprocess
import sys

from reference_openfoam.run_record import code_commit, host

from .errors import CupelError
from .layout import program

#: Counts of particles of each mode: a look (`quick`, seconds), the default, and all (minutes, 10 GiB).
COUNTS = {"quick": ("10000",), "default": ("100000", "1000000"), "all": ("100000", "1000000", "10000000")}
EXPONENT = {"10000": "1e4", "100000": "1e5", "1000000": "1e6", "10000000": "1e7"}


def run_benchmarks(mode: str, repetitions: int) -> dict:
    """Runs the benchmarks and returns the table that `as_table` prints and `--json` writes."""
    counts = COUNTS[mode]
    largest_model = "10000" if mode == "quick" else "100000"
    pattern = (f"^((plain|full|one_rate|naive)_[a-z]+/({'|'.join(counts)})/"
               f"|model_double/[a-z_]+/{largest_model}/|float_error/{largest_model})")
    command = [str(program("cupel_benchmarks")), f"--benchmark_filter={pattern}", "--benchmark_format=json",
               f"--benchmark_repetitions={repetitions}"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise CupelError(f"the benchmarks ended with status {done.returncode}: {done.stderr.strip() or 'no message'}")
    report = json.loads(done.stdout)
    table = arrange(report["benchmarks"])
    options = f"--{mode} " if mode != "default" else ""
    return table | origin(f"./cupel bench {options}--repetitions {repetitions}") | {
        "instructions": report["context"]["instructions"], "mhz": report["context"]["mhz_per_cpu"]}


def origin(command: str) -> dict:
    """Where a table comes from: host, commit of the code, command."""
    return {"host": {"cpu": host()["cpu"], "cores": host()["cores"]}, "commit": code_commit(), "command": command}


def arrange(rows: list[dict]) -> dict:
    """The benchmarks' rows as the table of keys: rates in million updates a second a core, bytes and ns a particle."""
    rows = [row for row in rows if row.get("run_type") != "aggregate"]
    names = list(dict.fromkeys(row["name"].split("/process_time")[0].split("/iterations")[0].split("/repeats")[0] for row in rows))

    def median(name: str, counter: str) -> float:
        found = sorted(row[counter] for row in rows if row["name"].startswith(name) and counter in row)
        return found[len(found) // 2]

    table: dict = {key: {} for key in ("plain_float", "plain_double", "full_step", "full_step_float", "full_step_one_rate",
                                       "full_step_one_rate_float", "thread_scaling", "bytes_per_particle", "naive_plain",
                                       "float_error", "models")}
    previous: tuple[float, float] | None = None
    for name in names:
        kind, *rest = name.split("/")
        if kind == "float_error":
            table["float_error"][EXPONENT[rest[0]]] = median(name, "relative_error")
            continue
        rate = median(name, "updates_per_core_s") / 1e6
        if kind.startswith("model_"):
            time, size = 1e3 / rate, median(name, "bytes_per_particle")
            before = previous or (0.0, 0.0)
            table["models"][rest[0]] = {"time_ns": round(time - before[0], 1), "bytes": round(size - before[1], 1)}
            previous = (time, size)
            continue
        count, threads = EXPONENT[rest[0]], rest[1]
        key = {"plain_float": "plain_float", "plain_double": "plain_double", "full_double": "full_step",
               "full_float": "full_step_float", "one_rate_double": "full_step_one_rate",
               "one_rate_float": "full_step_one_rate_float", "naive_double": "naive_plain"}[kind]
        if threads == "1":
            table[key][count] = round(rate, 3)
            if kind == "plain_double":
                table["bytes_per_particle"][count] = round(median(name, "bytes_per_particle"), 1)
        elif kind == "plain_double":
            one, two = (median(f"{kind}/{rest[0]}/{threads}/", "real_time") for threads in (1, 2))
            table["thread_scaling"][count] = round(one / two, 3)
    return table


def print_table(table: dict) -> None:
    """The table for a reader."""
    print(f"{table['host']['cpu']}, {table['instructions']}; million particle updates a second a core")
    for key in ("plain_double", "plain_float", "full_step", "full_step_float", "full_step_one_rate", "full_step_one_rate_float",
                "naive_plain"):
        print(f"  {key:24}" + "".join(f"{count:>6}: {rate:7.3f}" for count, rate in table[key].items()))
    print(f"  {'two threads / one':24}" + "".join(f"{count:>6}: {x:7.3f}" for count, x in table["thread_scaling"].items()))
    print(f"  {'bytes a particle':24}" + "".join(f"{count:>6}: {x:7.1f}" for count, x in table["bytes_per_particle"].items()))
    print("what each model adds, ns and bytes a particle and step")
    for name, cost in table["models"].items():
        print(f"  {name:22}{cost['time_ns']:9.1f} ns{cost['bytes']:9.1f} B")


def main(mode: str, repetitions: int, as_json: bool) -> int:
    """mode: a key of COUNTS, or "savings"."""
    if mode == "savings":
        from .savings import print_savings, run_savings

        table = {"savings": run_savings()} | origin("./cupel bench --savings")
        show = lambda whole: print_savings(whole["savings"])
    else:
        table, show = run_benchmarks(mode, repetitions), print_table
    if as_json:
        json.dump(table, sys.stdout, indent=1)
        print()
    else:
        show(table)
    return 0
