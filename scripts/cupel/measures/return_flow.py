"""Thermocapillary return flow: how far the velocity profile is from the exact one (physics.md, verification.md).

    u(eta) = (tau H/4 mu)(3 eta^2 - 2 eta),  eta = (z - z_bottom)/H,  tau = d(sigma)/dT dT/dx (with its sign)

Elements of the primary material (fraction > 1/2) in the middle third of the layer's length, each with its own velocity at
its own height:

    profile_error   sqrt( sum V (u_x - u)^2 / sum V ) / |tau H/4 mu|, of each snapshot, then the mean over snapshots
    mean_profile_error   the same of what is left of u_x - u after averaging over layers one spacing thick and over the
                    snapshots: waves and the scatter of particles drop out; never above profile_error
    surface_speed   velocity at eta = 1 in the direction that Marangoni stress drives, from a parabola fitted to eta > 1/2
    zero_crossing   the height eta where the layer-averaged velocity turns round (2/3 in the exact flow)

H is the depth that the liquid has at each place x, not that of the body in the case: the stress piles the liquid up at one end, by a
slope of 3 tau/(2 rho g H), 0.024 in the canonical layer, and a flow that is exact for its depth is then 3 eta^2 dH/H of the surface speed
away from one for a level surface (1.9 % over its middle third). The surface is taken as straight over the middle third,
H(x) = a + b (x - x_m), with a and b from the volume and the first moment of the liquid in it, both with the weight
w = cos^2(pi (x - x_m)/l), l the length of the third: it falls to zero at the third's ends, so that it does not matter between which
particles or cells they lie.

    a = 2 sum(V f w)/(B l),   b = sum(V f w (x - x_m)) / [B l^3 (1/24 - 1/(4 pi^2))],   B the breadth

Exact for lattices and cells; particles jittered at random by 0.2 spacings, ten to a depth, are 0.7 % of the depth off in places, which makes
a profile error of 0.5 %.

The surface speed is compared with tau/4 mu times the depth in the case, which is the depth at mid-length as long as none is lost.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..exact import return_flow as exact
from .elements import Elements
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up, primary_bodies, primary_material


@dataclass(frozen=True)
class Layer:
    """The layer of a case: bottom, depth, ends of its length (m), stress along x (N/m^2), viscosity (Pa s)."""

    bottom: float
    depth: float
    begin: float
    end: float
    stress: float
    viscosity: float

    @property
    def surface_velocity(self) -> float:
        return exact.surface_velocity(self.stress, self.depth, self.viscosity)


def layer_of(case: dict) -> Layer:
    """The liquid layer of a resolved case.

    Errors: MeasureError unless there is one box of primary material and a temperature gradient along x.
    """
    bodies = primary_bodies(case)
    if len(bodies) != 1 or bodies[0].get("shape") != "box":
        raise MeasureError("resolved case: the return flow is known for one box of liquid")
    material = primary_material(case, "viscosity", "surface_tension_slope")
    box, domain = bodies[0], case["domain"]
    bottom = max(box["lower"][2], domain["lower"][2])
    begin, end = max(box["lower"][0], domain["lower"][0]), min(box["upper"][0], domain["upper"][0])
    stress = material["surface_tension_slope"] * _gradient(case)
    if stress == 0.0:
        raise MeasureError("resolved case: no thermocapillary stress along x; there is no return flow to compare with")
    return Layer(bottom, min(box["upper"][2], domain["upper"][2]) - bottom, begin, end, stress, material["viscosity"])


def _gradient(case: dict) -> float:
    """dT/dx, K/m: of the end walls' temperatures where heat is solved for and both are given, else the initial one."""
    domain = case["domain"]
    walls = [(domain["boundaries"].get(name) or {}).get("temperature") for name in ("x_min", "x_max")]
    if "heat" in case["physics"] and None not in walls:
        return (walls[1] - walls[0]) / (domain["upper"][0] - domain["lower"][0])
    return look_up(case, "initial", "temperature_gradient")[0]


@dataclass(frozen=True)
class Profile:
    """Elements of the middle third: relative height, depth there (m), velocity along x (m/s), weight (their volumes); each (n)."""

    eta: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    weight: np.ndarray
    layer: Layer


def local_depth(elements: Elements, case: dict, layer: Layer) -> tuple[float, float]:
    """Depth of the liquid at mid-length (m) and its slope along x, of a straight surface over the middle third."""
    length = (layer.end - layer.begin) / 3.0
    offset = elements.position[:, 0] - 0.5 * (layer.begin + layer.end)
    within = np.abs(offset) < 0.5 * length
    content = elements.content(case["dimensions"], case["spacing"]) * elements.fraction
    moment = (content * np.cos(np.pi * offset / length)**2)[within]
    breadth = 1.0 if case["dimensions"] == 2 else case["domain"]["upper"][1] - case["domain"]["lower"][1]
    slope = (moment * offset[within]).sum() / (breadth * length**3 * (1.0 / 24.0 - 0.25 / np.pi**2))
    return float(2.0 * moment.sum() / (breadth * length)), float(slope)


def middle_profile(snapshot: Snapshot) -> Profile:
    """The velocity profile of the middle third. Errors: MeasureError if no liquid is there."""
    layer, elements = layer_of(snapshot.case), snapshot.elements
    x, z = elements.position[:, 0], elements.position[:, 2]
    third = (layer.end - layer.begin) / 3.0
    chosen = (elements.fraction > 0.5) & (x >= layer.begin + third) & (x <= layer.end - third)
    if not chosen.any():
        raise MeasureError(f"{elements.source}: no liquid in the middle third of the layer")
    depth, slope = local_depth(elements, snapshot.case, layer)
    depths = depth + slope * (x[chosen] - 0.5 * (layer.begin + layer.end))
    return Profile((z[chosen] - layer.bottom) / depths, depths, elements.velocity[chosen, 0],
                   (elements.volume * elements.fraction)[chosen], layer)


@measure_of_snapshot("profile_error", unit="1", needs=("velocity",), exact=lambda case: 0.0)
def profile_error(snapshot: Snapshot) -> Reading:
    profile = snapshot.once(middle_profile)
    layer = profile.layer
    expected = exact.velocity(profile.eta, layer.stress, profile.depth, layer.viscosity)
    square = np.average((profile.velocity - expected)**2, weights=profile.weight)
    flux = np.average(profile.velocity, weights=profile.weight) / abs(layer.surface_velocity)
    return Reading(float(np.sqrt(square) / abs(layer.surface_velocity)), beside={"net_flux_share": float(flux)})


def _layers(profile: Profile, spacing: float) -> tuple[np.ndarray, int]:
    """Number of the layer, one spacing thick, that each element is in, and how many layers there are."""
    count = max(int(round(profile.layer.depth / spacing)), 3)
    return np.clip((profile.eta * count).astype(int), 0, count - 1), count


def _of_mean_profile(readings: list[Reading]) -> Reading:
    """Root mean square over layers of the deviation averaged over elements and snapshots."""
    weight = sum(reading.kept[0] for reading in readings)
    deviation = sum(reading.kept[1] for reading in readings)
    filled = weight > 0.0
    mean = deviation[filled] / weight[filled]
    return Reading(float(np.sqrt(np.average(mean**2, weights=weight[filled]))))


@measure_of_snapshot("mean_profile_error", unit="1", needs=("velocity",), exact=lambda case: 0.0, combine=_of_mean_profile)
def mean_profile_error(snapshot: Snapshot) -> Reading:
    profile = snapshot.once(middle_profile)
    layer = profile.layer
    expected = exact.velocity(profile.eta, layer.stress, profile.depth, layer.viscosity)
    deviation = (profile.velocity - expected) / abs(layer.surface_velocity)
    place, count = _layers(profile, snapshot.case["spacing"])
    kept = (np.bincount(place, profile.weight, count), np.bincount(place, profile.weight * deviation, count))
    return Reading(_of_mean_profile([Reading(None, kept=kept)]).value, kept=kept)


@measure_of_snapshot("surface_speed", unit="m/s", needs=("velocity",),
                     exact=lambda case: abs(layer_of(case).surface_velocity))
def surface_speed(snapshot: Snapshot) -> Reading:
    profile = snapshot.once(middle_profile)
    upper = profile.eta > 0.5
    if len(np.unique(profile.eta[upper])) < 3:
        return Reading(None, note="fewer than three heights of elements in the upper half of the layer")
    eta = profile.eta[upper]
    design = np.stack([np.ones(len(eta)), eta - 1.0, (eta - 1.0)**2], axis=1)
    root = np.sqrt(profile.weight[upper])
    coefficients = np.linalg.lstsq(design * root[:, None], profile.velocity[upper] * root, rcond=None)[0]
    return Reading(float(coefficients[0] * np.sign(profile.layer.stress)))


@measure_of_snapshot("zero_crossing", unit="1", needs=("velocity",), exact=lambda case: 2.0 / 3.0)
def zero_crossing(snapshot: Snapshot) -> Reading:
    profile = snapshot.once(middle_profile)
    layer = profile.layer
    place, count = _layers(profile, snapshot.case["spacing"])
    weight = np.bincount(place, profile.weight, count)
    with np.errstate(invalid="ignore"):
        mean = np.bincount(place, profile.weight * profile.velocity, count) / weight * np.sign(layer.stress)
        height = np.bincount(place, profile.weight * profile.eta, count) / weight
    filled = weight > 0.0
    mean, height = mean[filled], height[filled]
    turns = np.flatnonzero((mean[:-1] < 0.0) & (mean[1:] >= 0.0))
    if len(turns) == 0:
        return Reading(None, note="the flow does not turn round over the depth")
    low = turns[-1]
    share = -mean[low] / (mean[low + 1] - mean[low])
    return Reading(float(height[low] + share * (height[low + 1] - height[low])))
