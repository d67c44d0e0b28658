"""The verification tiers, kept results and orders on the page."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from cupel import results as results_module
from cupel.cases import Member as CaseMember
from cupel.convergence import converge
from cupel.kept import keep
from cupel.results import kept_cases, read_result, write_result
from reports import gather as gather_module
from reports.gather import Case, Run
from reports.histories import history_picture, read_table
from reports.orders import order_row, orders_block
from reports.tiers import margin_text, tier_blocks
from tests.reports.test_page import Outline
from tests.scripts.made_results import made_result
from tests.scripts.test_kept import HEAD, Member, needs_git

LEVELS = (("coarse", 4e-5), ("medium", 2e-5), ("fine", 1e-5))


def tiered(root, case, solver, level, spacing, value, tier="v0", **more):
    """A made-up result of a case of a tier."""
    place = made_result(root, solver, level, spacing, value, case=case, **more)
    result = read_result(place)
    result["settings"] |= {"tier": tier, "title": f"A case, {case}", "dimensions": 2, "time": {"end": 1.0}, "assumed": []}
    write_result(place.folder, result)
    return place


def known_member(name, tier, variation=None):
    """A case as the case reader knows it."""
    return CaseMember(name, Path("case.toml"), variation, f"A case, {name}", ("coarse",), tier)


@pytest.fixture
def suite(tmp_path, monkeypatch):
    """Cases good (both solvers, three levels), bad (SPH only, far off) and table (tier v1); the case reader knows absent as well."""
    root, cases = tmp_path / "results", tmp_path / "validation_cases"
    for level, spacing in LEVELS:
        for solver, order in (("sph", 1), ("openfoam", 2)):
            tiered(root, "good", solver, level, spacing, 1.0 + 0.02 * (spacing / 4e-5)**order, commit=HEAD or "0123456789ab")
    tiered(root, "bad", "sph", "coarse", 4e-5, 1.5)
    tiered(root, "table", "sph", "coarse", 4e-5, 1.05, tier="v1", reference_kind="tabulated")
    for name in ("good", "bad", "table", "absent"):
        (cases / name).mkdir(parents=True)
        (cases / name / "case.toml").write_text("")
    monkeypatch.setattr(results_module, "CASES", cases)
    known = {name: known_member(name, tier) for name, tier in (("good", "v0"), ("bad", "v0"), ("absent", "v0"), ("table", "v1"))}
    monkeypatch.setattr(gather_module, "known_cases", lambda level: known)
    return root


def page_text(root, browse):
    from reports.page import write_page

    return Outline(browse(write_page(root, None, "coarse").as_uri(), "--dump-dom"))


@pytest.mark.browser
def test_each_tier_has_its_table_with_missing_cases_and_the_orders_follow(suite, browse):
    outline = page_text(suite, browse)
    assert {"tier-v0", "tier-v1", "orders", "margins-v0", "tier-case-absent"} <= set(outline.identities)
    assert "tier V0: 2 of 6 comparisons pass, 1 fail, 3 missing" in outline.text     # bad in OpenFOAM and absent in both
    assert "absent A case, absent missing not run yet in SPH, OpenFOAM" in outline.text
    assert re.search(r"good A case, good; spacing 40.0 μm SPH Melt-pool width .* \+2\.00 % ± 10 % 0\.20 pass", outline.text)
    assert re.search(r"SPH Melt-pool width 10 / 20 / 40 μm monotone 1\.00 1\.00", outline.text)
    assert "Do the solvers agree?" in outline.text
    assert (suite / "good" / "convergence.json").exists() and not (suite / "bad" / "convergence.json").exists()


@needs_git
@pytest.mark.browser
def test_a_kept_result_is_shown_as_kept_with_its_commit_and_links_that_lead_to_it(suite, browse, tmp_path):
    place = tiered(suite, "droplet", "sph", "coarse", 4e-5, 1.01, tier="canonical", commit=HEAD)
    (tmp_path / "validation_cases" / "droplet").mkdir()
    (tmp_path / "validation_cases" / "droplet" / "case.toml").write_text("")
    for case in ("droplet", "good"):
        keep(suite, [Member(tmp_path / "validation_cases", case)], ("sph",), "coarse")
        subprocess.run(["rm", "-r", str(suite / case / "sph" / "coarse")], check=True)
    assert kept_cases("coarse") == {"droplet", "good"} and not place.folder.exists()
    outline = page_text(suite, browse)
    assert f"not run here: kept result of {HEAD}" in outline.text
    assert f"kept result of {HEAD}" in outline.text.split("tier V0:")[1]
    link = next(link for link in outline.links if "kept/sph/coarse/result.json" in link)
    assert (suite / link).is_file()
    assert "10 / 20 / 40* μm" in outline.text


def test_a_suite_of_which_nothing_has_run_does_not_fill_the_page_with_missing_cases(tmp_path, monkeypatch):
    monkeypatch.setattr(results_module, "CASES", tmp_path / "validation_cases")  # where nothing is kept either
    monkeypatch.setattr(gather_module, "known_cases", lambda level: {"good": known_member("good", "v0")})
    cases, _ = gather_module.gather(tmp_path, None, "coarse")
    assert not tier_blocks(cases)


def test_variations_of_a_case_share_a_line_and_a_panel():
    assert gather_module.Case("drop_la_12", member=known_member("drop_la_12", "v0", "la_12")).family == "drop"
    assert gather_module.Case("drop").family == "drop"


def test_margins_and_orders_in_print(suite):
    cases, _ = gather_module.gather(suite, ["good", "bad"], "coarse")
    block, = tier_blocks(cases)
    assert [(line["solver"], line["passed"], line["failed"], line["missing"]) for line in block["solvers"]] == \
        [("SPH", 1, 1, 0), ("OpenFOAM", 1, 0, 1)]
    assert block["figure"].image.startswith("data:image/png")
    assert margin_text(cases[1].runs[0].rows[0]) == "5.00"
    row = next(order_row(study) for study in converge(suite, "good").studies if study.solver == "openfoam")
    assert (row["order"], row["error_order"], row["kind"], row["levels"]) == ("2.00", "2.00", "monotone", "10 / 20 / 40 μm")
    assert row["richardson"] == "1000 mm" and row["value"] == "1001.2 ± 1.6 mm", row
    assert orders_block(suite, cases)["picture"].image




def test_histories_stand_beside_the_exact_ones(suite, tmp_path):
    place = tiered(suite, "wave", "sph", "coarse", 4e-5, 1.0)
    result = read_result(place)
    result["measures"][0] |= {"name": "wave_error"}
    write_result(place.folder, result)
    (place.folder / "measures.csv").write_text("time_s,wave_error,wave_error_amplitude_m,wave_error_exact_amplitude_m\n"
                                               + "".join(f"{0.1 * n},0.1,{1.0 - 0.1 * n},{'' if n == 2 else 1.0 - 0.09 * n}\n" for n in range(9)))
    table = read_table(place.folder / "measures.csv")
    assert np.isnan(table["wave_error_exact_amplitude_m"][2]) and table["wave_error_amplitude_m"][2] == pytest.approx(0.8)
    cases, _ = gather_module.gather(suite, ["wave", "good"], "coarse")
    assert history_picture("v0", "Exact", cases).image.startswith("data:image/png")
    assert "no result" in history_picture("v0", "Exact", cases[1:]).missing


def test_a_long_track_has_no_place_among_those_of_several_powers():
    def power(**settings):
        return Case("track", runs=[Run(None, {"settings": settings}, [])]).power

    assert power(laser={"power": 150.0}) == 150.0 and power() is None
    assert power(laser={"power": 150.0}, tier="long") is None
