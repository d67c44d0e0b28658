"""Measures that the solver keeps itself while it runs: its ledgers, as run.json has them.

    laser_absorbed_error   relative difference between the energy absorbed and A P of what the beam hit
    energy_closure         |stored_end - stored_start - (in - out)| / max(in, |stored change|)
    mass_closure           the same for mass
    volume_closure         the same for the volume of the phases
"""

from __future__ import annotations

import math

from .registry import MeasureError, Reading, measure_of_run

_ENTRIES = {
    "laser_absorbed_error": ("energy", "absorbed_error"),
    "energy_closure": ("energy", "closure"),
    "mass_closure": ("mass", "closure"),
    "volume_closure": ("volume", "closure"),
}


def _register(name: str, ledger: str, entry: str) -> None:
    @measure_of_run(name, unit="1", exact=lambda case: 0.0)
    def read(run: dict) -> Reading:
        value = ((run.get("ledgers") or {}).get(ledger) or {}).get(entry)
        if value is None:
            raise MeasureError(f"run.json: no ledgers.{ledger}.{entry}, which {name} needs")
        if not math.isfinite(value):
            return Reading(None, note=f"ledgers.{ledger}.{entry} is not finite")
        return Reading(float(value))


for _name, (_ledger, _entry) in _ENTRIES.items():
    _register(_name, _ledger, _entry)
