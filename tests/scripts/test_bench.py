"""The benchmarks run and say what they should; how fast they are is not judged here."""

import json
import subprocess

from cupel import bench, savings
from cupel.layout import ROOT


def test_quick_benchmarks_give_every_key():
    done = subprocess.run([str(ROOT / "cupel"), "bench", "--quick", "--json", "--repetitions", "1"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    table = json.loads(done.stdout)
    for key in ("plain_float", "plain_double", "full_step", "full_step_one_rate", "naive_plain"):
        assert table[key]["1e4"] > 0
    assert table["float_error"]["1e4"] < 1e-5
    assert table["models"]["flow"]["bytes"] > 0
    assert {"host", "commit", "command"} <= table.keys()


def test_a_model_is_charged_what_it_adds():
    def row(name, rate, size):
        return {"name": f"model_double/{name}/100000/1/process_time", "updates_per_core_s": rate, "bytes_per_particle": size}

    models = bench.arrange([row("flow", 1e6, 400.0), row("heat", 5e5, 450.0)])["models"]
    assert models == {"flow": {"time_ns": 1000.0, "bytes": 400.0}, "heat": {"time_ns": 1000.0, "bytes": 50.0}}


def test_two_threads_are_compared_with_one_by_medians():
    def row(threads, seconds):
        return {"name": f"plain_double/100000/{threads}/process_time", "real_time": seconds, "updates_per_core_s": 1e6,
                "bytes_per_particle": 265.0}

    rows = [row(1, 9.0), row(1, 2.0), row(1, 1.9), row(2, 1.0), row(2, 8.0), row(2, 1.1)]
    assert bench.arrange(rows)["thread_scaling"] == {"1e5": round(2.0 / 1.1, 3)}


def test_savings_change_the_cost_and_not_the_pool():
    table = savings.run_savings(end_ms=0.3, overrides=("resolution.coarse=40 um",))
    assert set(table) == {"none", *savings.SAVINGS}
    assert table["none"]["width"] > 0
    for row in table.values():
        assert row["cpu_s"] > 0 and abs(row["width_change"]) < 0.05
