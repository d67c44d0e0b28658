"""Each canonical case, tiny, in both solvers: from the case file to a judged result that others can read."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import time

import numpy as np
import pytest
from cupel.comparison import LEDGER_LIMITS
from cupel.layout import ResultPlace
from cupel.measures.elements import read_series
from cupel.results import read_result
from tests.conftest import PYTHON, ROOT
from tests.end_to_end.conftest import INTERRUPTED, TINY, tiny_arguments

pytestmark = pytest.mark.end_to_end
BOTH = pytest.mark.parametrize("solver", ["sph", "openfoam"])
EACH = pytest.mark.parametrize("case", list(TINY))


@EACH
@BOTH
def test_it_completes_with_a_result_in_the_schema(tiny_runs, case, solver):
    result = read_result(ResultPlace(tiny_runs.results, case, solver, "tiny"))
    assert result is not None, tiny_runs.ended[case].stderr
    assert result["status"] == "completed", result["diagnosis"]
    declared = {measure["name"] for measure in result["settings"]["measures"]}
    assert declared <= {measure["name"] for measure in result["measures"]}
    assert result["cost"]["wall_s"] > 0 and result["cost"]["steps"] > 0 and result["cost"]["elements"] > 100
    assert result["cost"]["peak_bytes"] > 1e6 and result["cost"]["updates_per_core_s"] > 0


@EACH
@BOTH
def test_its_ledgers_close(tiny_runs, case, solver):
    result = read_result(ResultPlace(tiny_runs.results, case, solver, "tiny"))
    assert "mass" in result["ledgers"]
    for ledger, entry, _, limits, _ in LEDGER_LIMITS:
        # Mechanical energy is judged in the results: steps of finite length leave more than its limit in a track.
        if ledger == "energy" and "heat" in result["settings"]["physics"] and (entry == "closure" or result["settings"]["laser"]):
            assert abs(result["ledgers"][ledger][entry]) <= limits[solver]


@EACH
@BOTH
def test_its_snapshots_are_at_the_agreed_times_with_finite_fields(tiny_runs, case, solver):
    folder = tiny_runs.folder(case, solver)
    settings = json.loads((folder / "case.json").read_text())
    series = read_series(folder, fraction_when_absent=None if settings["surrounding"]["resolved"] else 1.0)
    interval, end = settings["time"]["output_interval"], settings["time"]["end"]
    assert np.allclose(series.times, np.arange(round(end / interval) + 1) * interval, atol=1e-3 * interval)
    for elements in (series.load(0), series.load(len(series) - 1)):
        elements.require("velocity")
        assert (elements.volume > 0).all() and elements.fraction.min() > -1e-3 and elements.fraction.max() < 1 + 1e-3
    if "heat" in settings["physics"]:
        last = series.load(len(series) - 1)
        assert last.temperature.max() > 1000 and last.temperature.min() > 290
        metal = last.fraction > 0.5
        assert (last.peak_temperature >= 0.999 * last.temperature)[metal].all()


@EACH
@BOTH
def test_its_history_goes_to_the_end(tiny_runs, case, solver):
    folder = tiny_runs.folder(case, solver)
    with open(folder / "series.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0][0] == "time_s" and len(rows) >= 3 and len({len(row) for row in rows}) == 1
    times = [float(row[0]) for row in rows[1:]]
    assert times == sorted(times) and times[-1] == pytest.approx(json.loads((folder / "case.json").read_text())["time"]["end"], rel=1e-3)


@BOTH
def test_the_laser_melts_steel(tiny_runs, solver):
    series = read_series(tiny_runs.folder("slm_track_150w", solver), fraction_when_absent=1.0)
    last = series.load(len(series) - 1)
    melt = (last.liquid_fraction > 0.5) & (last.fraction > 0.5)
    assert melt.sum() > 3
    # Under the beam's path, and nowhere else; of what lies on the metal one particle, at 40 μm a drop, may be thrown off.
    beside = melt & (np.abs(last.position[:, 1]) >= 2e-4)
    assert not (beside & (last.position[:, 2] <= series.load(0).position[:, 2].max())).any()
    assert beside.sum() <= 1


def test_both_solvers_start_from_the_same_amount_of_metal(tiny_runs):
    contents = []
    for solver in ("sph", "openfoam"):
        first = read_series(tiny_runs.folder("slm_track_150w", solver), fraction_when_absent=1.0).load(0)
        contents.append(float((first.volume * first.fraction).sum()))
    assert contents[0] == pytest.approx(contents[1], rel=0.03)  # particles of 40 μm against grains of 15 to 45 μm


def run_again(case: str, results, *more: str, settings=None) -> subprocess.CompletedProcess:
    environment = os.environ | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}", "PYTHONDONTWRITEBYTECODE": "1"}
    arguments = tiny_arguments(case, results, *more, settings=settings)
    return subprocess.run([PYTHON, "-m", "cupel", *arguments], env=environment, capture_output=True, text=True, timeout=600)


def last_fields(results, case: str, solver: str):
    series = read_series(results / case / solver / "tiny", fraction_when_absent=1.0)
    return series.load(len(series) - 1)


@BOTH
def test_running_twice_gives_the_same_numbers(tiny_runs, tmp_path, solver):
    done = run_again("marangoni_layer", tmp_path, "--solver", solver, "--threads", "1", "--jobs", "1")
    assert done.returncode == 0, done.stderr
    first, second = (last_fields(root, "marangoni_layer", solver) for root in (tiny_runs.results, tmp_path))
    assert np.array_equal(first.position, second.position) and np.array_equal(first.velocity, second.velocity)


@pytest.mark.parametrize("solver, case", list(INTERRUPTED))
def test_interrupted_and_resumed_is_the_same_as_unbroken(tmp_path, solver, case):
    settings, more = INTERRUPTED[solver, case], ("--solver", solver, "--threads", "1", "--jobs", "1")
    assert run_again(case, tmp_path / "whole", *more, settings=settings).returncode == 0

    environment = os.environ | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}", "PYTHONDONTWRITEBYTECODE": "1"}
    arguments = tiny_arguments(case, tmp_path / "broken", *more, settings=settings)
    process = subprocess.Popen([PYTHON, "-m", "cupel", *arguments], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True)
    folder = tmp_path / "broken" / case / solver / "tiny"
    series, deadline = folder / "fields" / "fields.pvd", time.monotonic() + 120
    while not (series.exists() and series.read_text().count("<DataSet") >= 2):
        assert process.poll() is None and time.monotonic() < deadline, "no second snapshot"
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, messages = process.communicate(timeout=130)
    assert process.returncode == 130 and "Traceback" not in messages, messages
    assert not (folder / "result.json").exists()

    done = run_again(case, tmp_path / "broken", *more, "--resume", settings=settings)
    assert done.returncode == 0 and "resumed" in done.stderr, done.stderr
    whole, broken = (last_fields(tmp_path / name, case, solver) for name in ("whole", "broken"))
    assert whole.count == broken.count
    # Bit for bit with the same number of threads.
    assert np.array_equal(whole.position, broken.position) and np.array_equal(whole.velocity, broken.velocity)
    assert whole.temperature is None or np.array_equal(whole.temperature, broken.temperature)


def test_a_case_with_an_error_is_refused_before_anything_runs(tmp_path):
    case = tmp_path / "odd" / "case.toml"
    case.parent.mkdir()
    text = (ROOT / "validation_cases" / "marangoni_layer" / "case.toml").read_text()
    for broken, words in ((text.replace("viscosity ", "viscocity ", 1), "did you mean 'viscosity'"),
                          (text.replace('"1000 kg/m^3"', '"-1000 kg/m^3"'), "density"),
                          (text.replace('"1000 kg/m^3"', '"1000 kg/m"'), "density")):
        assert broken != text
        case.write_text(broken)
        done = subprocess.run([PYTHON, "-m", "cupel", "run", str(case), "--results", str(tmp_path / "results")],
                              env=os.environ | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}"}, capture_output=True, text=True, timeout=60)
        assert done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr
        assert "case.toml:" in done.stderr and words in done.stderr and not (tmp_path / "results" / "odd").exists()


def test_a_missing_powder_bed_is_named(tmp_path):
    case = tmp_path / "odd" / "case.toml"
    case.parent.mkdir()
    base = ROOT / "validation_cases" / "common" / "slm_track.toml"
    case.write_text((base.parents[1] / "slm_track_150w" / "case.toml").read_text().replace("../common/slm_track.toml", "base.toml"))
    (case.parent / "base.toml").write_text(base.read_text())
    done = subprocess.run([PYTHON, "-m", "cupel", "run", str(case), "--results", str(tmp_path / "results"), "--no-report"],
                          env=os.environ | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}"}, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "bed_seed1.csv" in done.stderr and len(done.stderr.strip().splitlines()) == 1, done.stderr


@pytest.mark.browser
def test_the_report_of_these_runs_opens_with_its_pictures(tiny_runs, tmp_path):
    """Real snapshots of both solvers through the whole report, down to the pictures that a browser decodes."""
    import re

    from reports.page import write_page

    page = write_page(tiny_runs.results, list(TINY), "tiny")
    text = page.read_text()
    assert "class=\"nopicture\"" not in text, re.findall(r'class="nopicture">([^<]*)', text)
    probe = ("<script>addEventListener('load', () => { document.body.dataset.broken = [...document.images]"
             ".filter(i => !i.complete || i.naturalWidth < 50).length; });</script></body>")
    copy = tmp_path / "probe.html"
    copy.write_text(text.replace("</body>", probe))
    done = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                           "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={tmp_path / 'profile'}",
                           "--virtual-time-budget=20000", "--dump-dom", copy.as_uri()], capture_output=True, text=True, timeout=120)
    assert 'data-broken="0"' in done.stdout
