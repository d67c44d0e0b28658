"""Balance of recoil pressure, liquid pressure and surface tension on a surface at rest under a hot spot.

The balance of forces along z (exact/recoil.py), weighted with w(r) = cos^2(pi r/2b) over the footprint r < b, b the spot's radius:

    recoil_balance_error   | integral of w (p_r(T) - p) dA - S | / integral of w p_r dA
    S                      - integral of t . grad(w sigma(T)) dA, the push of sigma kappa along the normal, or, where Marangoni stress
                           is among the physics and pulls along the surface too, - integral of sigma(T) t . grad(w) dA

    p       mean pressure of the liquid 3 to 6 spacings under the surface, less that of the surrounding's elements (0 without)
    T       on the surface density = 1/2, column by column of the resampling grid (fields.py)
    t       grad(z)/sqrt(1 + grad(z)^2), slope of the surface; its height z from the contents of each column 3 spacings around it

The imbalance, signed, is averaged over the n snapshots of `between`: waves and sound cancel, a lasting imbalance does not. The value is
sqrt(mean^2 + spread^2/n), since a balance cannot be said to hold better than its mean is known.
By parts, so that nothing is fitted to a curvature; w spreads the slope over the footprint, where steps of single elements cancel.
Reference 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..exact.recoil import recoil_pressure
from .fields import Resampled, active_axes, mirrored, subdivided
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up, primary_material
from .surface import SURFACE_DENSITY, ends, largest_region

BAND = 3.0           # spacings below and above the surface whose contents give its height
LAYER = (3.0, 6.0)   # spacings under the surface between which the liquid's pressure is taken


@dataclass(frozen=True)
class Surface:
    """Columns of the grid over the hot spot: place aside (..., d - 1) m from the axis, height (...) m and temperature (...) K of the
    surface (nan without liquid), slope (..., d - 1); area of a column m^2 (m in 2-D)."""

    aside: np.ndarray
    height: np.ndarray
    temperature: np.ndarray
    slope: np.ndarray
    column: float

    @property
    def distance(self) -> np.ndarray:
        """Distance (...) m from the axis."""
        return np.linalg.norm(self.aside, axis=-1)


def surface_of(snapshot: Snapshot) -> Surface:
    """The liquid's surface around the hot spot of the case. Errors: MeasureError if no liquid is there."""
    case, spacing = snapshot.case, float(snapshot.case["spacing"])
    axes = active_axes(case["dimensions"])
    spot = look_up(case, "initial", "hot_spot")
    reach = float(spot["radius"]) + 4.0 * spacing
    elements = subdivided(mirrored(snapshot.elements, case), spacing, case["dimensions"])
    lower, upper = (np.array(case["domain"][corner], float)[list(axes)] for corner in ("lower", "upper"))
    center = np.array(spot["center"], float)[list(axes[:-1])]
    lower[:-1], upper[:-1] = np.maximum(lower[:-1], center - reach), np.minimum(upper[:-1], center + reach)
    resampled = Resampled(elements, case, lower, upper)
    liquid, _ = largest_region(resampled.density >= SURFACE_DENSITY)
    if not liquid.any():
        raise MeasureError(f"{snapshot.elements.source}: no liquid under the hot spot")
    tops = ends(resampled, liquid.ndim - 1, +1, liquid)
    height = np.max(np.where(np.isfinite(tops), tops, -np.inf), axis=-1)
    height = np.where(np.isfinite(height), height, np.nan)
    values = resampled.values(elements.temperature)
    place = (height - resampled.origin[-1]) / resampled.grid_spacing
    low = np.clip(np.floor(np.nan_to_num(place)).astype(int), 1, liquid.shape[-1] - 2)
    # from inside the liquid up to the surface: the node above may have no material
    here, below = (np.take_along_axis(values, (low - step)[..., None], axis=-1)[..., 0] for step in (0, 1))
    height = _from_contents(resampled, height, low)
    slope = np.stack([np.gradient(height, resampled.grid_spacing, axis=k) for k in range(height.ndim)], axis=-1)
    aside = np.stack(np.meshgrid(*(resampled.coordinates(k) - center[k] for k in range(len(center))), indexing="ij"), axis=-1)
    return Surface(aside, height, here + (here - below) * (place - low), slope, resampled.grid_spacing**len(center))


def _from_contents(resampled: Resampled, height: np.ndarray, low: np.ndarray) -> np.ndarray:
    """Heights from the density summed over 3 spacings below and above the surface, which steps of single elements do not disturb."""
    reach = int(BAND / 0.5)
    bottom, top = np.maximum(low - reach, 0), np.minimum(low + reach, resampled.shape[-1] - 1)
    summed = np.concatenate([np.zeros((*low.shape, 1)), np.cumsum(0.5 * (resampled.density[..., 1:] + resampled.density[..., :-1]), axis=-1)],
                            axis=-1)
    content = (np.take_along_axis(summed, top[..., None], axis=-1) - np.take_along_axis(summed, bottom[..., None], axis=-1))[..., 0]
    return np.where(np.isfinite(height), resampled.origin[-1] + (bottom + content) * resampled.grid_spacing, np.nan)


def _of_mean_imbalance(readings: list[Reading]) -> Reading:
    """sqrt(mean^2 + spread^2/n) of the signed imbalance: ringing cancels, but a balance is not better than its mean is known."""
    known = [reading.kept for reading in readings if reading.kept is not None]
    if not known:
        return Reading(None, note=readings[-1].note)
    mean = float(np.mean(known))
    if len(known) == 1:
        return Reading(abs(mean))
    spread = float(np.std(known, ddof=1))
    return Reading(float(np.hypot(mean, spread / np.sqrt(len(known)))), uncertainty=spread,
                   note=f"mean imbalance {mean:+.3g}, spread {spread:.2g} over {len(known)} snapshots")


@measure_of_snapshot("recoil_balance_error", unit="1", needs=("temperature", "pressure"), exact=lambda case: 0.0,
                     combine=_of_mean_imbalance)
def recoil_balance_error(snapshot: Snapshot) -> Reading:
    case = snapshot.case
    material = primary_material(case, "surface_tension", "boiling_temperature", "vaporization_heat", "molar_mass")
    radius = float(look_up(case, "initial", "hot_spot", "radius"))
    ambient = float((case.get("surrounding") or {}).get("pressure") or 101325.0)
    surface = surface_of(snapshot)
    r = surface.distance
    inside = r < radius
    if not (np.isfinite(surface.height[inside]) & np.isfinite(surface.slope[inside]).all(axis=-1)).all():
        return Reading(None, note="the surface does not reach to the hot spot's radius all round")
    pressure = _pressure_under(snapshot, surface, radius)
    if pressure is None:
        return Reading(None, note="the liquid under the hot spot is not three spacings deep")
    weight = np.where(inside, np.cos(0.5 * np.pi * np.minimum(r / radius, 1.0))**2, 0.0)
    recoil = recoil_pressure(surface.temperature[inside], material["boiling_temperature"], material["vaporization_heat"],
                             material["molar_mass"], ambient)
    push, bear = float((weight[inside] * recoil).sum()) * surface.column, pressure * float(weight.sum()) * surface.column
    hold = _held(surface, weight, _tension(material, surface.temperature), "marangoni" in case["physics"])
    imbalance = (push - bear - hold) / push
    return Reading(abs(imbalance), kept=imbalance,
                   beside={"recoil_N": push, "liquid_pressure_N": bear, "surface_tension_N": hold,
                           "greatest_temperature_K": float(surface.temperature[inside].max())})


def _held(surface: Surface, weight: np.ndarray, tension: np.ndarray, pulls_along: bool) -> float:
    """Force of surface tension along z, weighted, on the columns of the footprint (N; N/m in 2-D)."""
    step = surface.column**(1.0 / surface.height.ndim)
    sine = surface.slope / np.sqrt(1.0 + (surface.slope**2).sum(axis=-1, keepdims=True))
    weighted = weight if pulls_along else weight * tension
    total = 0.0
    for k in range(surface.height.ndim):
        change = np.gradient(np.where(weight > 0.0, weighted, 0.0), step, axis=k) * (tension if pulls_along else 1.0)
        used = change != 0.0
        total -= float((sine[..., k][used] * change[used]).sum()) * surface.column
    return total


def _tension(material: dict, temperature: np.ndarray) -> np.ndarray:
    """Surface tension (n) N/m at temperatures (n) K."""
    slope, reference = material.get("surface_tension_slope"), material.get("surface_tension_reference_temperature")
    if not slope or reference is None:
        return np.full(temperature.shape, float(material["surface_tension"]))
    return np.maximum(material["surface_tension"] + slope * (temperature - reference), material.get("surface_tension_minimum") or 0.0)


def _pressure_under(snapshot: Snapshot, surface: Surface, radius: float) -> float | None:
    """Mean pressure (Pa) of the liquid under the footprint, less that of the surrounding's elements; None without enough liquid."""
    case, elements = snapshot.case, snapshot.elements
    axes = list(active_axes(case["dimensions"]))
    center = np.array(look_up(case, "initial", "hot_spot", "center"), float)[axes[:-1]]
    of_element = elements.position[:, axes[:-1]] - center
    known = np.isfinite(surface.height)
    _, column = cKDTree(surface.aside[known]).query(of_element)
    depth = (surface.height[known][column] - elements.position[:, 2]) / case["spacing"]
    near = np.linalg.norm(of_element, axis=1) < radius
    under = near & (elements.fraction > 0.5) & (depth > LAYER[0]) & (depth < LAYER[1])
    above = near & (elements.fraction < 0.5) & (depth < -LAYER[0])
    if not under.any():
        return None
    outside = float(np.average(elements.pressure[above], weights=elements.volume[above])) if above.any() else 0.0
    return float(np.average(elements.pressure[under], weights=elements.volume[under])) - outside
