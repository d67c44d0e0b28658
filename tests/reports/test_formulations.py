"""The table of what each remedy does."""

from __future__ import annotations

import pytest
from cupel import results as results_module
from reports.formulations import formulations_block
from reports.gather import Case
from tests.scripts.made_results import made_result


@pytest.fixture
def root(tmp_path, monkeypatch):
    cases = tmp_path / "validation_cases"
    for name in ("good", "plain"):
        (cases / name).mkdir(parents=True)
        (cases / name / "case.toml").write_text("")
    monkeypatch.setattr(results_module, "CASES", cases)
    root = tmp_path / "results"
    made_result(root, "sph", "coarse", 4e-5, 1.01, case="good")
    made_result(root, "sph", "coarse-paper", 4e-5, 1.5, case="good")
    made_result(root, "sph", "coarse", 4e-5, 1.01, case="plain")
    return root


def test_default_and_paper_stand_side_by_side(root):
    block = formulations_block(root, [Case("good"), Case("plain")], "coarse")
    assert [column["name"] for column in block["columns"]] == ["default", "paper"]
    assert {row["case"] for row in block["rows"]} == {"good"}      # the other has been run in one formulation only
    default, paper = block["rows"][0]["cells"]
    assert default["verdict"] == "pass" and default["text"] == "+1.00 %"
    assert paper["verdict"] == "fail" and paper["text"] == "+50.00 %"


def test_a_run_that_stopped_says_so(root):
    made_result(root, "sph", "coarse-no_shifting", 4e-5, 1.0, case="good", status="stopped")
    block = formulations_block(root, [Case("good")], "coarse")
    *_, stopped = block["rows"][0]["cells"]
    assert stopped["text"] == "stopped" and stopped["verdict"] == "fail"


def test_a_page_of_another_variant_has_none(root):
    assert formulations_block(root, [Case("good")], "tiny")["columns"] == []
    assert formulations_block(root, [Case("good")], "medium")["columns"] == []
