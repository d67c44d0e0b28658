"""The table of measures: one decorator registers a function, everything else looks it up by name.

A measure of a snapshot is a function `(snapshot) -> Reading`; a measure of a run is a function
`(run) -> Reading` over the run.json that the solver wrote. Adding a measure is one file with one
decorated function, and one import of that file in `__init__.py`.
"""

from __future__ import annotations

import difflib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ..errors import CupelError


class MeasureError(CupelError):
    """What cannot be measured and why, as one line fit for a user: file or key, what is wrong, what to do."""


@dataclass(frozen=True)
class Reading:
    """What a measure found in one snapshot (or in one run), in SI units.

    value: None where the shape does not allow the measure; `note` then says why.
    uncertainty: the reading's own spread (None: the spread over snapshots is taken instead).
    beside: further columns of measures.csv, keyed by a name that carries its unit.
    note: one sentence for the reader of the result, empty where there is nothing to say.
    kept: what the measure's own `combine` needs of this snapshot.
    expected: the exact or tabulated reference at the time of the reading, where it changes with time.
    """

    value: float | None
    uncertainty: float | None = None
    beside: dict[str, float | None] = field(default_factory=dict)
    note: str = ""
    kept: Any = None
    expected: float | None = None


@dataclass(frozen=True)
class Measure:
    """A registered measure.

    unit: SI unit of the value ("1" where it has none).
    needs: fields of `Elements` that must be in the snapshot.
    summary: "mean" over the snapshots of `between`, "last" of them, or "run" (from run.json).
    exact: function of the resolved case that gives the exact reference where the case names none.
    combine: function that makes one reading of the readings of `between`, in place of their mean and spread.
    """

    name: str
    unit: str
    read: Callable[[Any], Reading]
    needs: tuple[str, ...]
    summary: str
    exact: Callable[[dict], float] | None
    combine: Callable[[list[Reading]], Reading] | None = None


_measures: dict[str, Measure] = {}


def _register(measure: Measure) -> None:
    if measure.name in _measures:
        raise ValueError(f"measure '{measure.name}' is registered twice")
    _measures[measure.name] = measure


def measure_of_snapshot(
    name: str,
    *,
    unit: str,
    needs: tuple[str, ...] = (),
    summary: str = "mean",
    exact: Callable[[dict], float] | None = None,
    combine: Callable[[list[Reading]], Reading] | None = None,
):
    """Register `function(snapshot) -> Reading` as the measure `name`; see `Measure` for the options."""
    if summary not in ("mean", "last"):
        raise ValueError(f"measure '{name}': summary is 'mean' or 'last', not '{summary}'")

    def decorate(function):
        _register(Measure(name, unit, function, tuple(needs), summary, exact, combine))
        return function

    return decorate


def measure_of_run(name: str, *, unit: str, exact: Callable[[dict], float] | None = None):
    """Register `function(run) -> Reading`, where run is the content of run.json, as the measure `name`."""

    def decorate(function):
        _register(Measure(name, unit, function, (), "run", exact))
        return function

    return decorate


def known_measures() -> dict[str, Measure]:
    """All registered measures by name (a copy)."""
    return dict(_measures)


def find_measure(name: str) -> Measure:
    """The measure of that name.

    Errors: MeasureError with the nearest known name.
    """
    if name in _measures:
        return _measures[name]
    near = difflib.get_close_matches(name, _measures, n=1)
    hint = f"did you mean '{near[0]}'?" if near else "known are " + ", ".join(sorted(_measures))
    raise MeasureError(f"measure '{name}' is unknown; {hint}")
