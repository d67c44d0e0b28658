"""A free drop: its centre, its size, and how far it is from round.

Elements of the primary material count with V f; a drop that symmetry planes cut is made whole by reflection. What is farther than
2.5 radii from the centre is not the drop. Mode n of the shape comes from a moment over the volume, not from a fitted contour:

    2-D  R(phi) = R [1 + a cos(n phi)], phi from x    a = sum V f r^n cos(n phi)/(A R^n),           A = sum V f = pi R^2
    3-D  R(theta) = R [1 + a P_n(cos theta)]          a = (2 n + 1)/3 sum V f r^n P_n/(V R^n),      V = sum V f = 4/3 pi R^3

to first order in a; n = 2 in 2-D is sum V f (x^2 - z^2)/(A R^2). Elements inside a drop cancel, so a sees shapes far below the spacing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.special import eval_legendre

from .elements import Elements
from .fields import active_axes
from .registry import MeasureError
from .snapshot import Snapshot, primary_bodies, primary_material

REACH = 2.5   # radii around the centre that can be the drop


@dataclass(frozen=True)
class FreeDrop:
    """The drop as the case has it: radius m, centre (3) m, dimensions, mode and amplitude of its disturbance (2 and 0 without)."""

    radius: float
    center: np.ndarray
    dimensions: int
    mode: int
    amplitude: float
    material: dict


def drop_of(case: dict, *needed: str) -> FreeDrop:
    """The one sphere of primary material of a resolved case, whose material must have the `needed` properties.

    Errors: MeasureError if there is not exactly one.
    """
    bodies = primary_bodies(case)
    if len(bodies) != 1 or bodies[0].get("shape") != "sphere":
        raise MeasureError("resolved case: this measure is for one drop, a body of shape sphere")
    disturbance = bodies[0].get("perturbation") or {}
    return FreeDrop(float(bodies[0]["radius"]), np.array(bodies[0]["center"], float), int(case["dimensions"]),
                    int(disturbance.get("mode", 2)), float(disturbance.get("amplitude", 0.0)), primary_material(case, *needed))


@dataclass(frozen=True)
class DropState:
    """A drop in a snapshot: the elements (whole), their weights V f (area in 2-D), centroid (3) m, radius of equal volume m."""

    elements: Elements
    weight: np.ndarray
    center: np.ndarray
    radius: float

    @property
    def distance(self) -> np.ndarray:
        """Distance (n) m of each element from the centroid."""
        return np.linalg.norm(self.elements.position - self.center, axis=1)


def drop_state(snapshot: Snapshot) -> DropState:
    """The drop of a snapshot. Errors: MeasureError if nothing of it is left."""
    case, drop = snapshot.case, drop_of(snapshot.case)
    elements = whole(snapshot.elements, case, drop)
    weight = elements.content(drop.dimensions, case["spacing"]) * elements.fraction
    if drop.dimensions == 2:
        flat = elements.position * [1.0, 0.0, 1.0]
        elements = replace(elements, position=flat)
    total = weight.sum()
    if total <= 0.0:
        raise MeasureError(f"{elements.source}: no primary material is left")
    center = (weight[:, None] * elements.position).sum(axis=0) / total
    for _ in range(2):   # the centre again, without what lies apart
        near = np.linalg.norm(elements.position - center, axis=1) < REACH * drop.radius
        if not near.any() or weight[near].sum() <= 0.0:
            raise MeasureError(f"{elements.source}: the primary material is not one drop")
        center = (weight[near, None] * elements.position[near]).sum(axis=0) / weight[near].sum()
    content = weight[near].sum()
    radius = np.sqrt(content / np.pi) if drop.dimensions == 2 else np.cbrt(0.75 * content / np.pi)
    return DropState(elements, np.where(near, weight, 0.0), center, float(radius))


def whole(elements: Elements, case: dict, drop: FreeDrop) -> Elements:
    """Elements with their mirror images across symmetry planes that go through the drop's centre."""
    for axis in active_axes(case["dimensions"]):
        for side, corner in (("min", "lower"), ("max", "upper")):
            boundary = case["domain"]["boundaries"].get(f"{'xyz'[axis]}_{side}") or {}
            plane = float(case["domain"][corner][axis])
            if boundary.get("kind") != "symmetry" or abs(drop.center[axis] - plane) > 1e-6 * drop.radius:
                continue
            position = elements.position.copy()
            position[:, axis] = 2.0 * plane - position[:, axis]
            velocity = None
            if elements.velocity is not None:
                velocity = elements.velocity.copy()
                velocity[:, axis] *= -1.0
            elements = Elements.joined([elements, replace(elements, position=position, velocity=velocity)])
    return elements


def shape_amplitude(state: DropState, mode: int, dimensions: int) -> float:
    """Amplitude a of a mode of the shape, as a share of the radius."""
    arm = state.elements.position - state.center
    if dimensions == 2:
        moment = (state.weight * ((arm[:, 0] + 1j * arm[:, 2]) / state.radius)**mode).sum().real
        return float(moment / state.weight.sum())
    r = np.maximum(np.linalg.norm(arm, axis=1), 1e-300)
    moment = (state.weight * (r / state.radius)**mode * eval_legendre(mode, arm[:, 2] / r)).sum()
    return float((2 * mode + 1) / 3.0 * moment / state.weight.sum())
