"""Results on disk: whole or not at all, in the schema, and never taken for something they are not."""

from __future__ import annotations

import errno
import json
import os

import pytest
from cupel import results
from cupel.errors import CupelError
from cupel.layout import ResultPlace, places, results_root
from tests import synthetic


def good_result(**changes) -> dict:
    """A result that keeps the schema."""
    return synthetic.run_record(synthetic.resolved_drop(), "sph") | {"measures": []} | changes


@pytest.fixture
def place(tmp_path) -> ResultPlace:
    place = ResultPlace(tmp_path, "droplet_wetting", "sph", "coarse")
    place.folder.mkdir(parents=True)
    return place


def test_what_is_written_is_what_is_read(place):
    results.write_result(place.folder, good_result())
    assert results.read_result(place) == good_result()


def test_a_full_disk_leaves_the_old_file_and_says_so(place, monkeypatch):
    results.write_result(place.folder, good_result())

    def full(descriptor):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(CupelError, match="result.json: the disk is full"):
        results.write_result(place.folder, good_result(diagnosis="new"))
    assert results.read_result(place)["diagnosis"] == ""
    assert [path.name for path in place.folder.iterdir()] == ["result.json"]


@pytest.mark.parametrize("changes, key", [
    ({"status": "fine"}, "status"), ({"schema": 2}, "schema"), ({"status": "stopped"}, "diagnosis"), ({"cost": {}}, "cost"),
    ({"measures": [{"name": "x"}]}, "measures/0"), ({"settings": {}}, "settings")])
def test_what_breaks_the_schema_is_not_written(place, changes, key):
    with pytest.raises(CupelError, match=f"result.json: {key}: "):
        results.write_result(place.folder, good_result(**changes))
    assert not (place.folder / "result.json").exists()


def test_numbers_that_are_not_finite_are_refused_both_ways(place):
    broken = good_result(cost={"wall_s": float("nan"), "steps": 1, "elements": 1})
    with pytest.raises(CupelError, match="not finite"):
        results.write_json(place.folder / "result.json", broken)
    (place.folder / "result.json").write_text(json.dumps(broken))
    with pytest.raises(CupelError, match="not a whole JSON file"):
        results.read_result(place)


def test_every_cut_of_a_result_is_noticed(place):
    text = json.dumps(good_result(), indent=1)
    for length in range(0, len(text), max(1, len(text) // 40)):
        (place.folder / "result.json").write_text(text[:length])
        with pytest.raises(CupelError):
            results.read_result(place)


def test_a_result_in_the_wrong_folder_is_refused(place):
    results.write_result(place.folder, good_result(solver="openfoam"))
    with pytest.raises(CupelError, match="solver is 'openfoam', but the folder says 'sph'"):
        results.read_result(place)


def test_moving_aside_keeps_the_last_good_result_out_of_sight(place):
    results.write_result(place.folder, good_result())
    results.move_aside(place)
    assert not place.folder.exists() and results.read_result(place) is None
    assert places(place.root) == []
    place.folder.mkdir(parents=True)
    (place.folder / "launch.json").write_text("{}")
    results.move_aside(place)  # an aborted run does not push the good result out
    assert (place.previous / "result.json").exists() and not place.folder.exists()
    results.drop_previous(place)
    assert not place.previous.exists()


def test_a_results_folder_that_is_a_file_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(CupelError, match="file"):
        results_root(tmp_path / "file")


def test_the_schema_itself_is_valid():
    import jsonschema

    jsonschema.Draft202012Validator.check_schema(results.result_schema())
