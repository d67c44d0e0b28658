"""fetch_headers.sh: one line when it cannot, nothing to do when the headers are there."""

from __future__ import annotations

import subprocess

import pytest

from tests.reference_openfoam import small_cases

SCRIPT = small_cases.ROOT/"reference_openfoam"/"fetch_headers.sh"
CACHE = small_cases.ROOT/".cache"


def test_without_a_cache_folder_it_says_how_to_call_it():
    result = subprocess.run([str(SCRIPT)], capture_output=True, text=True)
    assert result.returncode == 1 and result.stderr.count("\n") == 1 and "usage" in result.stderr


def test_a_cache_that_cannot_be_written_ends_in_a_clear_line(tmp_path):
    (tmp_path/"file").write_text("")
    result = subprocess.run([str(SCRIPT), str(tmp_path/"file"/"cache")], capture_output=True, text=True)
    assert result.returncode == 1 and "cannot make the cache folder" in result.stderr


@pytest.mark.skipif(not list(CACHE.glob("openfoam-*/complete")), reason="the headers have not been fetched; a build does it")
def test_headers_that_are_there_are_not_fetched_again():
    result = subprocess.run([str(SCRIPT), str(CACHE)], capture_output=True, text=True)
    assert result.returncode == 0 and result.stderr == ""
    assert result.stdout.strip().startswith(str(CACHE/"openfoam-"))
