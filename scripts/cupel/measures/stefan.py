"""Melting from a hot wall into solid at its melting temperature (one-phase Stefan problem).

    front_position   m, distance of the front from the hot wall: the share of the body that is liquid times the body's length along
                     the wall's normal, L sum V f f_l / sum V f; last snapshot of `between`

Reference 2 beta sqrt(alpha t) at that snapshot's time, with the liquid's properties. Being a sum over f_l, the front moves smoothly
through elements that are partly molten.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..exact import stefan as exact
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, primary_bodies, primary_material

AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Melting:
    """length of the body along the hot wall's normal m, front coefficient beta, diffusivity of the liquid m^2/s."""

    length: float
    beta: float
    diffusivity: float

    def front(self, time: float) -> float:
        """Exact position of the front, m."""
        return float(exact.front(np.array(time), self.beta, self.diffusivity))


def melting_of(case: dict) -> Melting:
    """The melting of a resolved case. Errors: MeasureError unless one wall is hotter than the melting temperature of one body."""
    material = primary_material(case, "density", "specific_heat", "conductivity", "latent_heat", "melting_temperature")
    hot = {name: wall["temperature"] for name, wall in case["domain"]["boundaries"].items()
           if wall and wall.get("temperature") is not None and wall["temperature"] > material["melting_temperature"]}
    bodies = primary_bodies(case)
    if len(hot) != 1 or len(bodies) != 1 or bodies[0].get("shape") != "box":
        raise MeasureError("resolved case: the front is known for one box with one wall above its melting temperature")
    (name, temperature), = hot.items()
    axis, box, domain = AXES[name[0]], bodies[0], case["domain"]
    length = min(box["upper"][axis], domain["upper"][axis]) - max(box["lower"][axis], domain["lower"][axis])
    stefan = material["specific_heat"] * (temperature - material["melting_temperature"]) / material["latent_heat"]
    diffusivity = material["conductivity"] / (material["density"] * material["specific_heat"])
    return Melting(float(length), exact.front_coefficient(stefan), diffusivity)


@measure_of_snapshot("front_position", unit="m", needs=("liquid_fraction",), summary="last",
                     exact=lambda case: melting_of(case).front(case["time"]["end"]))
def front_position(snapshot: Snapshot) -> Reading:
    elements, melting = snapshot.elements, melting_of(snapshot.case)
    weight = elements.volume * elements.fraction
    share = float((weight * elements.liquid_fraction).sum() / weight.sum())
    expected = melting.front(elements.time)
    note = ""
    if expected > 0.9 * melting.length:
        note = f"the exact front is at {expected / melting.length:.0%} of the body's length: its end is no longer far away"
    return Reading(share * melting.length, expected=expected, note=note)
