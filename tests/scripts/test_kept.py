"""Kept results: what gets in, what they stand in for, and what a fresh result is compared with."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from cupel import kept as kept_module
from cupel import results as results_module
from cupel.check import check_results, gather
from cupel.comparison import fill_solver_references
from cupel.convergence import converge
from cupel.errors import CupelError
from cupel.judging import judged_at
from cupel.kept import age, keep, regression_rows, same_case
from cupel.layout import ROOT, ResultPlace
from cupel.results import kept_folder, read_kept, read_result
from tests.scripts.made_results import made_result

HEAD = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short=12", "HEAD"], capture_output=True, text=True).stdout.strip()
needs_git = pytest.mark.skipif(not HEAD, reason="the sources are not in a git repository")


class Member:
    """A case as `keep` sees it."""

    def __init__(self, cases: Path, name: str = "made", case_hash: str = "h", variation: str | None = None):
        self.name, self.case_hash = name, case_hash
        owner = name.removesuffix(f"_{variation}") if variation else name
        self.kept = cases / owner / "kept" / (variation or "")

    def resolve(self, level, overrides=()):
        return {"hash": self.case_hash + "".join(overrides)}


@pytest.fixture
def cases(tmp_path, monkeypatch):
    """A folder of cases of its own, with one case, `made`."""
    folder = tmp_path / "validation_cases"
    (folder / "made").mkdir(parents=True)
    (folder / "made" / "case.toml").write_text("title = 'made'\n")
    monkeypatch.setattr(results_module, "CASES", folder)
    return folder


@pytest.fixture
def root(tmp_path):
    return tmp_path / "results"


def kept_sph(cases, root, value=1.02, commit=HEAD, **more):
    """A kept SPH result at coarse; the fresh one it came from is removed."""
    place = made_result(root, "sph", "coarse", 4e-5, value, commit=commit, **more)
    (place.folder / "series.csv").write_text("time_s\n0\n")
    keep(root, [Member(cases)], ("sph",), "coarse")
    for path in place.folder.iterdir():
        path.unlink()
    place.folder.rmdir()
    return place


@needs_git
def test_a_result_is_kept_whole_with_its_history_and_nothing_else(cases, root):
    place = made_result(root, "sph", "coarse", 4e-5, 1.02, commit=HEAD)
    (place.folder / "series.csv").write_text("time_s\n0\n")
    (place.folder / "fields").mkdir()
    folder, = keep(root, [Member(cases)], ("sph",), "coarse")
    assert sorted(path.name for path in folder.iterdir()) == ["result.json", "series.csv"]
    assert folder == cases / "made" / "kept" / "sph" / "coarse"
    assert read_kept("made", "sph", "coarse") == read_result(place)


@needs_git
def test_a_formulation_is_kept_beside_the_default(cases, root):
    made_result(root, "sph", "coarse-no_density_diffusion", 4e-5, 1.5, commit=HEAD, case_hash="hnumerics.density_diffusion=0")
    folder, = keep(root, [Member(cases)], ("sph",), "coarse", "no_density_diffusion")
    assert folder == cases / "made" / "kept" / "sph" / "coarse-no_density_diffusion"
    assert read_kept("made", "sph", "coarse-no_density_diffusion")["variant"] == "coarse-no_density_diffusion"
    assert read_kept("made", "sph", "coarse") is None


@needs_git
def test_a_variation_is_kept_under_its_case(cases, root):
    made_result(root, "sph", "fine", 1e-5, 1.02, case="made_la_12", commit=HEAD)
    keep(root, [Member(cases, "made_la_12", variation="la_12")], ("sph",), "fine")
    assert kept_folder("made_la_12") == cases / "made" / "kept" / "la_12"
    assert read_kept("made_la_12", "sph", "fine")["case"] == "made_la_12"


@needs_git
@pytest.mark.parametrize("change, words", [
    ({"status": "stopped"}, "only completed results"), ({"commit": HEAD + "+changes"}, "commit the changes"),
    ({"commit": "unknown"}, "does not have"), ({"commit": "badc0ffee000"}, "not in this repository"),
    ({"case_hash": "other"}, "its hash differs")])
def test_what_could_not_be_made_again_is_refused_and_nothing_is_kept(cases, root, change, words):
    made_result(root, "openfoam", "coarse", 4e-5, 1.0, commit=HEAD)
    made_result(root, "sph", "coarse", 4e-5, 1.0, **({"commit": HEAD} | change))
    with pytest.raises(CupelError, match=words):
        keep(root, [Member(cases)], ("openfoam", "sph"), "coarse")
    assert not list(cases.rglob("result.json"))


def test_nothing_to_keep_says_how_to_run_it(cases, root):
    with pytest.raises(CupelError, match="./cupel run made --solver sph --level fine"):
        keep(root, [Member(cases)], ("sph",), "fine")


@needs_git
def test_keep_refuses_by_one_line_on_the_command_line(cupel, tmp_path):
    done = cupel("keep", "--results", tmp_path)
    assert done.returncode == 2 and "name the cases to keep" in done.stderr and done.stderr.count("\n") == 1


@needs_git
def test_a_kept_result_stands_in_for_one_that_has_not_been_run_and_says_so(cases, root):
    place = kept_sph(cases, root)
    judged = judged_at(place)
    assert judged.kept.startswith(f"kept result of {HEAD}")
    row, = judged.rows
    assert row.verdict == "pass" and row.value == 1.02 and "kept result" in row.note
    _, lines = gather(root, ["made"], ("sph",), "coarse")
    assert len(lines) == 1 and "not run here, kept result of" in lines[0]


@needs_git
def test_a_run_that_did_not_end_is_not_covered_by_a_kept_result(cases, root):
    place = kept_sph(cases, root)
    place.folder.mkdir()
    (place.folder / "launch.json").write_text("{}")
    row, = judged_at(place).rows
    assert row.verdict == "missing" and "not finished" in row.note


@needs_git
@pytest.mark.parametrize("value, uncertainty, verdict", [
    (1.029, None, "pass"),      # within a tenth of the tolerance of 10 %
    (1.031, None, "fail"), (1.009, None, "fail"),
    (1.05, 0.04, "pass"),       # within its uncertainty
    (1.07, 0.04, "fail")])
def test_a_fresh_result_that_has_moved_is_a_regression(cases, root, value, uncertainty, verdict):
    kept_sph(cases, root)
    place = made_result(root, "sph", "coarse", 4e-5, value, uncertainty=uncertainty, commit=HEAD)
    row, = regression_rows(read_result(place))
    assert row.quantity == "melt_pool_width, against kept" and row.verdict == verdict
    assert row.reference == 1.02 and row.error == pytest.approx(value - 1.02)
    assert row in judged_at(place).rows


@needs_git
def test_a_regression_fails_the_check(cases, root, tmp_path):
    kept_sph(cases, root)
    made_result(root, "sph", "coarse", 4e-5, 1.05, commit=HEAD)      # still within the tolerance of its reference
    assert check_results(root, ["made"], ("sph",), "coarse", tmp_path / "check.xml") == 1
    assert "melt_pool_width, against kept" in (tmp_path / "check.xml").read_text()


@needs_git
def test_a_measure_that_can_no_longer_be_taken_is_a_regression(cases, root):
    kept_sph(cases, root)
    row, = regression_rows(read_result(made_result(root, "sph", "coarse", 4e-5, None, commit=HEAD)))
    assert row.verdict == "fail" and "in one of the two only" in row.note


@needs_git
def test_other_settings_are_not_compared(cases, root):
    kept_sph(cases, root)
    row, = regression_rows(read_result(made_result(root, "sph", "coarse", 4e-5, 9.0, commit=HEAD, case_hash="new")))
    assert row.verdict == "none" and "other settings" in row.note


def test_without_a_kept_result_there_is_nothing_to_compare(cases, root):
    assert regression_rows(read_result(made_result(root, "sph", "coarse", 4e-5, 1.0))) == []


@needs_git
def test_a_damaged_kept_result_fails(cases, root):
    place = kept_sph(cases, root)
    path = cases / "made" / "kept" / "sph" / "coarse" / "result.json"
    path.write_text(path.read_text()[:200])
    row, = judged_at(place).rows
    assert row.verdict == "fail" and "not a whole JSON file" in row.note


@needs_git
def test_a_kept_reference_solver_is_a_reference(cases, root):
    made_result(root, "openfoam", "coarse", 4e-5, 1.25, commit=HEAD)
    keep(root, [Member(cases)], ("openfoam",), "coarse")
    for path in (root / "made" / "openfoam" / "coarse").iterdir():
        path.unlink()
    (root / "made" / "openfoam" / "coarse").rmdir()
    place = made_result(root, "sph", "coarse", 4e-5, 1.0, reference_kind="solver", reference_solver="openfoam", reference=None)
    fill_solver_references(root, "made", "coarse")
    measure, = read_result(place)["measures"]
    assert measure["reference"] == 1.25 and measure["pass"] is False


@needs_git
def test_kept_levels_complete_a_study_and_are_marked(cases, root):
    kept_sph(cases, root, value=1.08)
    made_result(root, "sph", "medium", 2e-5, 1.04, commit=HEAD)
    made_result(root, "sph", "fine", 1e-5, 1.02, commit=HEAD)
    study, = converge(root, "made").studies
    assert study.order == pytest.approx(1.0) and [point.kept for point in study.points] == [False, False, True]


@needs_git
class TestAge:
    """In a small repository of its own."""

    @pytest.fixture
    def repository(self, tmp_path, monkeypatch):
        folder = tmp_path / "repository"
        for name in ("sph_solver/models", "reference_openfoam", "scripts/cupel/measures"):
            (folder / name).mkdir(parents=True)
        monkeypatch.setattr(kept_module, "ROOT", folder)
        kept_module._git.cache_clear()
        self.git(folder, "init", "-q")
        self.commit(folder, "sph_solver/models/a.hpp")
        yield folder
        kept_module._git.cache_clear()

    def git(self, folder, *arguments):
        return subprocess.run(["git", "-C", str(folder), "-c", "user.name=t", "-c", "user.email=t@t", *arguments], check=True,
                              capture_output=True, text=True).stdout.strip()

    def commit(self, folder, name):
        path = folder / name
        path.write_text((path.read_text() if path.exists() else "") + "x")
        self.git(folder, "add", ".")
        self.git(folder, "commit", "-qm", name)
        kept_module._git.cache_clear()
        return self.git(folder, "rev-parse", "--short=12", "HEAD")

    def result(self, solver, commit):
        return {"case": "made", "solver": solver, "variant": "coarse", "code": {"commit": commit}, "settings": {"hash": "h"}}

    def test_only_what_it_depends_on_makes_a_result_older(self, repository):
        made = self.commit(repository, "scripts/cupel/measures/m.py")
        self.commit(repository, "reference_openfoam/x.py")
        self.commit(repository, "sph_solver/README.md")
        assert age(self.result("sph", made)) == ""
        assert age(self.result("openfoam", made)) == "1 commit to the solver since"
        self.commit(repository, "sph_solver/models/a.hpp")
        self.commit(repository, "sph_solver/models/a.hpp")
        self.commit(repository, "scripts/cupel/measures/m.py")
        assert age(self.result("sph", made)) == "2 commits to the solver since, 1 commit to the measures since"

    def test_changes_that_are_not_committed_are_said(self, repository):
        made = self.commit(repository, "sph_solver/models/a.hpp")
        (repository / "sph_solver/models/a.hpp").write_text("changed")
        kept_module._git.cache_clear()
        assert age(self.result("sph", made)) == "the solver has changes that are not committed"

    def test_an_unknown_commit_has_no_age(self, repository):
        assert "cannot be told" in age(self.result("sph", "badc0ffee000"))

    def test_a_case_that_resolves_to_something_else_is_said(self, repository, monkeypatch):
        made = self.commit(repository, "sph_solver/models/a.hpp")
        monkeypatch.setattr(kept_module, "present_case", lambda case, level: {"hash": "new"})
        assert age(self.result("sph", made)) == "the case resolves to something else now"


def test_kept_results_in_the_repository_are_whole():
    """Every kept result of the suite can be read, is completed, and lies where it says."""
    for path in ROOT.glob("validation_cases/*/kept/**/result.json"):
        result = json.loads(path.read_text())
        read = read_kept(result["case"], result["solver"], result["variant"])
        assert read is not None and read["status"] == "completed", path
        assert kept_folder(result["case"]) / result["solver"] / result["variant"] == path.parent
        assert (path.parent / "series.csv").exists(), path
        assert ResultPlace(Path("."), result["case"], result["solver"], result["variant"]), path


def test_a_case_is_the_same_to_a_solver_whatever_only_the_other_one_reads():
    def case(**numerics):
        return {"hash": str(numerics), "case_file": str(numerics), "spacing": 1.0, "bodies": [{"file": str(numerics), "shape": "box"}],
                "numerics": {"time_step_factor": 1.0, "shifting": 1.0, "openfoam": {"mesh": "following"}} | numerics}

    assert same_case("openfoam", case(), case(shifting=0.5)) and not same_case("sph", case(), case(shifting=0.5))
    assert same_case("openfoam", case(), case(new_key=1)) and not same_case("sph", case(), case(new_key=1))
    static = {"mesh": "static"}
    assert same_case("sph", case(skin=0.3), case(skin=0.15)) and same_case("sph", case(), case(skin=0.15))  # the order of sums only
    assert same_case("sph", case(), case(openfoam=static)) and not same_case("openfoam", case(), case(openfoam=static))
    for solver in ("sph", "openfoam"):
        assert not same_case(solver, case(), case(time_step_factor=0.5))
        assert not same_case(solver, case(), case(shifting=0.5) | {"spacing": 2.0})
        assert not same_case(solver, {"hash": "a"}, {"hash": "b"}) and same_case(solver, {"hash": "a"}, {"hash": "a"})


@pytest.mark.parametrize(("now", "steps_of_sound", "binding", "same"), [
    (6, 3900, {"capillary": 1000}, True),                  # sound never bound: more steps of it could not have been taken
    (6, 3000, {"acoustic": 990, "output": 10}, True),      # three and no more would fit, whatever is allowed
    (6, 3990, {"acoustic": 990, "output": 10}, False),
    (6, 3990, {"force": 1, "capillary": 999}, False),
    (2, 3900, {"capillary": 1000}, False),                 # fewer than it took
    (2, 1000, {"acoustic": 1000}, True)])
def test_a_limit_that_a_run_did_not_come_to_makes_no_other_case(now, steps_of_sound, binding, same):
    before, after = ({"hash": str(steps), "numerics": {"acoustic_substeps": steps}} for steps in (4, now))
    cost = {"steps": 1000, "acoustic_steps": steps_of_sound, "time_step_binding": binding}
    assert same_case("sph", before, after, cost) == same
    assert not same_case("sph", before, after) and not same_case("sph", before, after, {"steps": 1000})


def test_files_of_a_kept_case_are_named_as_the_repository_sees_them():
    table = ROOT / "validation_cases" / "common" / "bed_seed1.csv"
    settings = {"case_file": str(ROOT / "validation_cases" / "made" / "case.toml"), "bodies": [{"file": str(table)}, {"shape": "box"}]}
    named = kept_module._without_places(settings)
    assert named["case_file"] == "validation_cases/made/case.toml"
    assert named["bodies"] == [{"file": "validation_cases/common/bed_seed1.csv"}, {"shape": "box"}]
    assert kept_module._without_places({"hash": "h"}) == {"hash": "h"}
