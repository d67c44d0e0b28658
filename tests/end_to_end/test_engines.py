"""One program carries the solver for several instruction sets and two precisions; their results must agree."""

from __future__ import annotations

import os
import subprocess

import numpy as np
import pytest
from cupel.measures import read_series
from scipy.spatial import cKDTree
from tests.conftest import PYTHON, ROOT
from tests.end_to_end.conftest import tiny_arguments

CASE, LENGTH, SPEED = "marangoni_layer", 1e-3, 0.01  # the layer's depth (m) and the speed of its surface (m/s)


def run(results, instructions: str, *settings: str) -> subprocess.CompletedProcess:
    environment = os.environ | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}", "PYTHONDONTWRITEBYTECODE": "1",
                                "CUPEL_INSTRUCTIONS": instructions}
    overrides = ("resolution.coarse=100 um", "time.end=5 ms", "time.output_interval=5 ms", *settings)
    arguments = tiny_arguments(CASE, results, "--solver", "sph", "--threads", "1", "--jobs", "1", settings=overrides)
    return subprocess.run([PYTHON, "-m", "cupel", *arguments], env=environment, capture_output=True, text=True, timeout=300)


def end(results):
    series = read_series(results / CASE / "sph" / "tiny", fraction_when_absent=1.0)
    return series.load(len(series) - 1)


@pytest.fixture(scope="module")
def portable(tmp_path_factory):
    results = tmp_path_factory.mktemp("portable")
    done = run(results, "portable")
    assert done.returncode == 0, done.stderr
    assert "engine portable_double" in (results / CASE / "sph" / "tiny" / "log.txt").read_text()
    return end(results)


@pytest.mark.parametrize("instructions", ["avx2", "avx512"])
def test_instruction_sets_agree_to_round_off(portable, tmp_path, instructions):
    done = run(tmp_path, instructions)
    if "it has" in done.stderr:
        pytest.skip(f"this machine has no {instructions}")
    assert done.returncode == 0, done.stderr
    other = end(tmp_path)
    assert np.abs(other.position - portable.position).max() < 1e-9 * LENGTH
    assert np.abs(other.velocity - portable.velocity).max() < 1e-7 * SPEED


def test_single_precision_is_near_double(portable, tmp_path):
    done = run(tmp_path, "portable", 'numerics.precision="float"')
    assert done.returncode == 0, done.stderr
    other = end(tmp_path)
    # Clusters are larger in float, and so particles come in another order: each is compared with the nearest.
    distance, nearest = cKDTree(portable.position).query(other.position)
    assert len(set(nearest)) == len(nearest) and distance.max() < 1e-3 * LENGTH
    difference = np.abs(other.velocity - portable.velocity[nearest]).max()
    assert 0 < difference < 0.02 * SPEED


def test_unknown_instructions_are_refused_by_name(tmp_path):
    done = run(tmp_path, "sse9")
    assert done.returncode != 0
    assert "sse9" in done.stderr and "it has" in done.stderr and "portable" in done.stderr
