"""Measures: the same code for particles and for cells. README.md defines each; a new one is imported here."""

from . import (
    channel_flow, contact_angle, film, fused_section, ledgers, melt_pool, migration, oscillation, recoil, return_flow, static_drop, stefan,
    taylor_green, volume, wave,
)
from .elements import Elements, Series, read_elements, read_series
from .measuring import measure
from .registry import MeasureError, Reading, known_measures, measure_of_run, measure_of_snapshot
from .snapshot import Snapshot

__all__ = [
    "Elements", "MeasureError", "Reading", "Series", "Snapshot", "known_measures", "measure", "measure_of_run",
    "measure_of_snapshot", "read_elements", "read_series",
    "channel_flow", "contact_angle", "film", "fused_section", "ledgers", "melt_pool", "migration", "oscillation", "recoil", "return_flow",
    "static_drop", "stefan", "taylor_green", "volume", "wave",
]
