"""Fixtures that several folders of tests share."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PYTHON = "/usr/bin/python3"


@pytest.fixture
def cupel():
    """Runs the command line in a process of its own: `cupel("run", "x", env={...})` gives the completed process."""

    def call(*arguments: str, env: dict[str, str] | None = None, timeout: float = 120) -> subprocess.CompletedProcess:
        environment = os.environ | {"PYTHONPATH": f"{ROOT / 'scripts'}:{ROOT}", "PYTHONDONTWRITEBYTECODE": "1"} | (env or {})
        return subprocess.run([PYTHON, "-m", "cupel", *map(str, arguments)], env=environment, capture_output=True, text=True,
                              timeout=timeout)

    return call
