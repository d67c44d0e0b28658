"""A snapshot: elements and the resolved case, with a memory for what several measures share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .elements import Elements
from .registry import MeasureError


class Snapshot:
    """What a measure of a snapshot is given.

    elements: `Elements`; case: the resolved case (a dict, SI); first: the first snapshot of the run;
    window: begin and end (s) of the time that the measure is asked for.
    """

    def __init__(self, elements: Elements, case: dict, first: Snapshot | None = None):
        self.elements, self.case = elements, case
        self.first = first if first is not None else self
        self.window = (0.0, elements.time)
        self._kept: dict[Callable, Any] = {}
        self._windowed: dict[tuple[float, float], Snapshot] = {}

    def within(self, begin: float, end: float) -> Snapshot:
        """The same snapshot for another window (the same object for the same window)."""
        if (begin, end) not in self._windowed:
            other = Snapshot(self.elements, self.case, self.first)
            other.window = (begin, end)
            self._windowed[begin, end] = other
        return self._windowed[begin, end]

    def once(self, function: Callable[[Snapshot], Any]) -> Any:
        """function(snapshot), computed at the first call only."""
        if function not in self._kept:
            self._kept[function] = function(self)
        return self._kept[function]


def look_up(case: dict, *keys: str) -> Any:
    """case[key][key]...; errors: MeasureError that names the missing key."""
    value: Any = case
    for depth, key in enumerate(keys):
        if not isinstance(value, dict) or value.get(key) is None:
            raise MeasureError(f"resolved case: no '{'.'.join(keys[:depth + 1])}', which the measure needs")
        value = value[key]
    return value


def primary_bodies(case: dict) -> list[dict]:
    """Bodies that are not of the surrounding's material."""
    surrounding = (case.get("surrounding") or {}).get("material")
    return [body for body in case.get("bodies", []) if body.get("material") != surrounding]


def primary_material(case: dict, *needed: str) -> dict:
    """Properties of the primary material; it must have the `needed` ones.

    Errors: MeasureError if there is none, or if primary bodies differ in a needed property.
    """
    names = list(dict.fromkeys(body["material"] for body in primary_bodies(case)))
    if not names:
        raise MeasureError("resolved case: no body that is not of the surrounding's material; nothing to measure")
    chosen = {name: tuple(look_up(case, "materials", name, key) for key in needed) for name in names}
    if len(set(chosen.values())) > 1:
        raise MeasureError(f"resolved case: materials {', '.join(names)} differ in {', '.join(needed)}; "
                           "a measure needs one value")
    return case["materials"][names[0]]
