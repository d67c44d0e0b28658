"""A results folder with everything that a report meets: good results, one that stopped, one missing, one damaged."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from cupel.finish_result import finish
from tests import synthetic

BROWSER = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
           "--no-first-run", "--disable-extensions", "--disable-background-networking", "--host-resolver-rules=MAP * ~NOTFOUND"]


@pytest.fixture(scope="session")
def results(tmp_path_factory) -> Path:
    """Results of all canonical cases: the layer's OpenFOAM run is missing, the 200 W one stopped, its SPH result cut off."""
    root = tmp_path_factory.mktemp("results")
    cases = [synthetic.resolved_drop(3e-4), synthetic.resolved_layer(1e-4), *map(synthetic.resolved_track, (100, 150, 200))]
    for case in cases:
        for solver, bias in (("sph", 0.05), ("openfoam", 0.0)):
            if (case["name"], solver) == ("marangoni_layer", "openfoam"):
                continue
            folder = root / case["name"] / solver / "coarse"
            synthetic.write_run(folder, solver, case, bias)
            finish(folder)
    stopped = root / "slm_track_200w" / "openfoam" / "coarse" / "result.json"
    record = json.loads(stopped.read_text())
    stopped.write_text(json.dumps(record | {"status": "stopped", "diagnosis": "temperature 9000 K in cell 17", "measures": []}))
    damaged = root / "slm_track_200w" / "sph" / "coarse" / "result.json"
    damaged.write_text(damaged.read_text()[:500])
    return root


@pytest.fixture(scope="session")
def page(results, tmp_path_factory) -> Path:
    """The report over these results, where nothing is kept that could stand in for one of them."""
    from cupel import results as results_module
    from reports.page import write_page

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(results_module, "CASES", tmp_path_factory.mktemp("nothing_kept"))
        return write_page(results, None, "coarse")


@pytest.fixture(scope="session")
def browse(tmp_path_factory):
    """Runs headless Chromium on a page, without network: `browse(page, "--dump-dom")` gives its output."""

    def call(address: str, *options: str) -> str:
        profile = tmp_path_factory.mktemp("browser")
        done = subprocess.run([*BROWSER, f"--user-data-dir={profile}", *options, address], capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr[-2000:]
        return done.stdout

    return call
