"""`./cupel test`: CTest, then pytest; the closing lines of both come last."""

from __future__ import annotations

import os
import subprocess
import sys

from .layout import PYTHON, ROOT


def run_all(pytest_arguments: list[str]) -> int:
    """Runs every test; 0 if all passed. The last two lines of output are the closing lines of CTest and pytest."""
    cores = str(len(os.sched_getaffinity(0)))
    ctest_status, ctest_lines = follow(["ctest", "--test-dir", str(ROOT / "build"), "--output-on-failure", "--parallel", cores,
                                        "--no-tests=error"])
    verdict = next((line for line in reversed(ctest_lines) if "tests passed" in line or "No tests" in line), "CTest gave no verdict")
    pytest_status, pytest_lines = follow([PYTHON, "-m", "pytest", "--color=no", *pytest_arguments], hold_last=True)
    print(f"ctest: {verdict}")
    print(pytest_lines[-1] if pytest_lines else "pytest gave no output", flush=True)
    return 1 if ctest_status or pytest_status else 0


def follow(command: list[str], hold_last: bool = False) -> tuple[int, list[str]]:
    """Runs a program and passes its output on as it comes; returns its status and its lines that are not empty.

    With `hold_last` the last of these lines is not printed.
    """
    process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    lines: list[str] = []
    held: list[str] = []
    for line in process.stdout:
        held.append(line)
        if line.strip():
            lines.append(line.rstrip("\n"))
            if hold_last:
                sys.stdout.write("".join(held[:-1]))
                held = held[-1:]
            else:
                sys.stdout.write("".join(held))
                held = []
            sys.stdout.flush()
    return process.wait(), lines
