"""The launcher, with stand-ins for the machine's package manager and build programs."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest
from tests.conftest import ROOT

# Every stand-in notes that it was called. Installed packages are lines of the file `installed`.
PROGRAMS = {
    "dpkg-query": 'shift 2; for name in "$@"; do grep "^$name " "$MACHINE/installed"; done; true',
    "dpkg": 'echo "dpkg $*" >> "$MACHINE/calls"',
    "apt-get": 'echo "apt-get $*" >> "$MACHINE/calls"\n'
               'if [ -f "$MACHINE/apt_fails" ]; then echo "E: Unable to locate package"; exit 100; fi\n'
               'for word in "$@"; do case $word in -*|install|update|*=*) ;; *) echo "$word installed" >> "$MACHINE/installed";; esac; done',
    "id": 'cat "$MACHINE/user"',
    "cmake": 'echo "cmake" >> "$MACHINE/calls"; [ ! -f "$MACHINE/cmake_fails" ] || { printf "CMake Error at CMakeLists.txt:3:\\n  no compiler\\n"; exit 1; }',
    "ninja": 'echo "ninja start" >> "$MACHINE/calls"; sleep "$(cat "$MACHINE/build_time")"; echo "ninja end" >> "$MACHINE/calls"',
}


@pytest.fixture
def machine(tmp_path: Path):
    """A bare machine: `machine.run("cases")` calls the launcher of a copy of the repository on it."""
    root, programs = tmp_path / "clone", tmp_path / "programs"
    (root / "scripts" / "cupel").mkdir(parents=True)
    shutil.copy(ROOT / "cupel", root / "cupel")
    (root / "scripts" / "packages.txt").write_text("# comment\ncmake   # builds\nninja-build # too\n\nopenfoam\n")
    (root / "scripts" / "cupel" / "__main__.py").write_text("import sys; print('handed over', *sys.argv[1:])\n")
    (root / "scripts" / "cupel" / "__init__.py").write_text("")
    programs.mkdir()
    for name, text in PROGRAMS.items():
        (programs / name).write_text(f"#!/bin/bash\n{text}\n")
        (programs / name).chmod(0o755)
    for name, text in (("installed", "cmake installed\n"), ("user", "0\n"), ("build_time", "0\n"), ("calls", "")):
        (tmp_path / name).write_text(text)
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "MACHINE": str(tmp_path)}

    class Machine:
        folder = tmp_path

        @staticmethod
        def start(*arguments: str, program: Path = root / "cupel") -> subprocess.Popen:
            return subprocess.Popen([program, *arguments], cwd="/", env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    text=True)

        @classmethod
        def run(cls, *arguments: str, **more) -> subprocess.CompletedProcess:
            process = cls.start(*arguments, **more)
            output, messages = process.communicate(timeout=30)
            return subprocess.CompletedProcess(arguments, process.returncode, output, messages)

        @staticmethod
        def calls() -> list[str]:
            return (tmp_path / "calls").read_text().splitlines()

    return Machine


def test_a_bare_machine_gets_what_is_missing_and_no_more(machine):
    done = machine.run("cases", "--results", "x y")
    assert done.returncode == 0, done.stderr
    assert done.stdout == "handed over cases --results x y\n"
    install = next(call for call in machine.calls() if " install " in call)
    assert install.endswith("ninja-build openfoam") and "--yes" in install and " cmake" not in install
    assert "dpkg --configure -a" in machine.calls()  # an installation that was cut off is finished first


def test_the_second_time_nothing_is_installed_or_configured(machine):
    assert machine.run("cases").returncode == 0
    before = machine.calls()
    assert machine.run("cases").returncode == 0
    assert machine.calls()[len(before):] == ["ninja start", "ninja end"]


def test_without_root_the_one_line_to_run_is_printed(machine):
    (machine.folder / "user").write_text("1000\n")
    done = machine.run("cases")
    assert done.returncode == 1 and len(done.stderr.splitlines()) == 1
    assert "apt-get update && apt-get install --yes --no-install-recommends ninja-build openfoam'" in done.stderr
    assert not any("apt-get" in call for call in machine.calls())


def test_a_half_installed_package_counts_as_missing(machine):
    (machine.folder / "installed").write_text("cmake installed\nninja-build installed\nopenfoam half-configured\n")
    assert machine.run("cases").returncode == 0
    assert next(call for call in machine.calls() if " install " in call).endswith(" openfoam")


def test_a_failed_installation_is_one_line_and_is_tried_again(machine):
    (machine.folder / "apt_fails").write_text("")
    done = machine.run("cases")
    assert done.returncode == 1 and "E: Unable to locate package" in done.stderr.splitlines()[-1]
    (machine.folder / "apt_fails").unlink()
    assert machine.run("cases").returncode == 0


def test_a_failed_configuration_is_one_line_and_is_tried_again(machine):
    (machine.folder / "cmake_fails").write_text("")
    done = machine.run("cases")
    assert done.returncode == 1 and "CMake Error at CMakeLists.txt:3: no compiler" in done.stderr.splitlines()[-1]
    (machine.folder / "cmake_fails").unlink()
    assert machine.run("cases").returncode == 0
    assert machine.calls().count("cmake") == 2


def test_two_at_once_set_up_one_after_the_other(machine):
    assert machine.run("cases").returncode == 0
    before = len(machine.calls())
    (machine.folder / "build_time").write_text("1\n")
    first = machine.start("cases")
    time.sleep(0.4)
    second = machine.start("cases")
    messages = [process.communicate(timeout=30)[1] for process in (first, second)]
    assert first.returncode == second.returncode == 0
    assert machine.calls()[before:] == ["ninja start", "ninja end"] * 2
    assert "waiting for another set-up" in messages[1]


def test_it_is_found_through_a_link(machine):
    link = machine.folder / "link"
    link.symlink_to(machine.folder / "clone" / "cupel")
    assert machine.run("schema", program=link).stdout == "handed over schema\n"


def test_a_folder_that_cannot_be_written_is_one_line(machine):
    (machine.folder / "clone" / "build").write_text("a file where the build folder should be")
    done = machine.run("cases")
    assert done.returncode == 1 and len(done.stderr.splitlines()) == 1 and "cannot write" in done.stderr


def test_the_real_list_names_each_package_once_with_a_reason():
    lines = [line for line in (ROOT / "scripts" / "packages.txt").read_text().splitlines() if line and not line.startswith("#")]
    names = [line.split("#")[0].strip() for line in lines]
    assert len(names) == len(set(names)) > 20
    assert all("#" in line and len(line.split("#")[1].strip()) > 3 for line in lines)
