"""Where headers and libraries come from: fetch_headers.sh says in one line why it cannot and does nothing when the headers are
there; another OpenFOAM that is sourced is taken in its place."""

from __future__ import annotations

import os
import shutil
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


def without_foam(tmp_path, **programs):
    """fetch_headers.sh on a machine that has the usual programs, and of Debian's only those given (name: script)."""
    folder = tmp_path/"bin"
    folder.mkdir()
    for name in ("sh", "mkdir", "mktemp", "rm", "find", "ls", "cat", "dirname", "basename"):
        (folder/name).symlink_to(shutil.which(name))
    for name, script in programs.items():
        (folder/name.replace("_", "-")).write_text(f"#!/bin/sh\n{script}\n")
        (folder/name.replace("_", "-")).chmod(0o755)
    return subprocess.run([str(SCRIPT), str(tmp_path/"cache")], capture_output=True, text=True, env={"PATH": str(folder)})


def test_on_another_system_one_line_says_what_to_source(tmp_path):
    result = without_foam(tmp_path)
    assert result.returncode == 1 and result.stderr.count("\n") == 1
    assert "no Debian machine" in result.stderr and "source its etc/bashrc" in result.stderr


def test_without_the_package_one_line_says_what_to_install(tmp_path):
    result = without_foam(tmp_path, dpkg_query="exit 1")
    assert result.returncode == 1 and result.stderr.count("\n") == 1 and "apt-get install openfoam" in result.stderr


def configured(tmp_path, **sourced):
    """cmake's output, and the compiler's and linker's command lines, in a shell in which another OpenFOAM is sourced. Its folders
    are there and empty: what such an installation holds could not be tried, only that it is looked for where it is."""
    source = tmp_path/"other"/"src"
    for library in ("OpenFOAM", "OSspecific/POSIX", "finiteVolume", "meshTools", "surfMesh", "fileFormats", "transportModels"):
        (source/library/"lnInclude").mkdir(parents=True)
    (source/"finiteVolume"/"lnInclude"/"fvCFD.H").write_text("")
    environment = os.environ | {"WM_PROJECT_VERSION": "v2112", "FOAM_SRC": str(source), "FOAM_LIBBIN": str(tmp_path/"other"/"lib"),
                                "FOAM_MPI": "sys-openmpi", "WM_LABEL_SIZE": "64"} | sourced
    build = tmp_path/"build"
    result = subprocess.run(["cmake", "-G", "Ninja", "-S", str(small_cases.ROOT/"reference_openfoam"), "-B", str(build)],
                            env=environment, capture_output=True, text=True)
    lines = subprocess.run(["ninja", "-C", str(build), "-t", "commands"], capture_output=True, text=True).stdout
    return result, lines, source


def test_another_openfoam_that_is_sourced_gives_headers_and_libraries(tmp_path):
    result, lines, source = configured(tmp_path)
    assert result.returncode == 0 and "OpenFOAM 2112" in result.stdout, result.stderr
    assert f"{source}/finiteVolume/lnInclude" in lines and f"-L{tmp_path}/other/lib/sys-openmpi" in lines
    assert "-DOPENFOAM=2112" in lines and "-DWM_LABEL_SIZE=64" in lines and "-std=c++14" in lines
    assert str(CACHE) not in lines and "-Werror" not in lines


@pytest.mark.parametrize("version", ["dev", "10"])          # openfoam.org counts otherwise, and its headers are others
def test_an_openfoam_that_is_not_of_openfoam_com_is_refused_in_a_clear_line(version, tmp_path):
    result, _, _ = configured(tmp_path, WM_PROJECT_VERSION=version)
    assert result.returncode != 0 and "names no version of openfoam.com" in result.stderr
