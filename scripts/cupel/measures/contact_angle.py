"""Contact angle, base radius and apex height of a drop on the wall z = domain.lower z (physics.md, section 5).

The drop is the largest connected region of the primary material, wherever it has drifted. A circle (2-D) or sphere (3-D)
of centre height z_c and radius R is fitted by least squares of distance, per area, to its surface outside the
first two spacings above the wall; then

    contact angle  theta = arccos((z_wall - z_c)/R).

Base radius and apex height are taken from the interface itself, not from that fit, so that an angle cannot hide a
wrong shape; what the fit and what height and base say stand beside them in measures.csv, and the result's note says so
where they differ.

    base radius:  r(z) from the area of the level section (2-D: half its width) from 2 to 5 spacings above the wall,
                  r^2 + z^2 = a + b z  by least squares (exact for every circle), base radius sqrt(a) at z = 0;
    apex height:  top of a paraboloid fitted to the surface within 0.4 R (at least 3 spacings) of its highest point; for a
                  sphere that is exact to 0.001 R.

On a round wall the same circle meets the wall's circle at the angle between their radii (exact/drop_on_round_wall.py), the base
radius is half the chord between the points where both meet, and heights are distances from the wall:

    base radius:  with rho the distance from the wall's centre and alpha the angle from the drop's axis,
                  rho^2 = 2 D rho cos(alpha) + k  by least squares over the surface from 2 to 5 spacings from the wall (exact for
                  every circle), base radius R sin(alpha) at rho = R.

The resampling kernel moves a surface of radius R inward by s^2 (d - 1)/(2R), s^2 the variance of the kernel along an axis;
points are moved back by that much.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..exact.drop_on_round_wall import RoundCap, common_area
from ..exact.spherical_cap import Cap
from .fields import REACH, Resampled, active_axes, mirrored, subdivided
from .registry import MeasureError, Reading, measure_of_snapshot
from .round_walls import RoundWall, round_walls
from .snapshot import Snapshot, look_up, primary_bodies, primary_material
from .surface import SURFACE_DENSITY, cross_section, interface, largest_region

WALL_LAYER = 2.0        # spacings above the wall that the fit leaves out
BASE_LAYER = 5.0        # spacings above the wall up to which the base is extrapolated
APEX_REACH = 3.0        # spacings around the highest point, at least,
APEX_SHARE = 0.4        # and this share of the fitted radius
DIFFERENT_ANGLE = np.radians(2.0)
DIFFERENT_LENGTH = 0.03


@dataclass(frozen=True)
class DropShape:
    """A drop as measured; lengths m, angles rad; None where the drop does not allow it, `note` says why."""

    contact_angle: float | None
    base_radius: float | None
    apex_height: float | None
    angle_from_height_and_base: float | None
    base_radius_from_fit: float | None
    apex_height_from_fit: float | None
    fit_residual: float | None
    center: tuple[float, ...]
    note: str


def fit_sphere(points: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Centre (d), radius and root mean square distance of the circle or sphere nearest to points (n, d), weights (n).

    Algebraic fit (Kasa) first, then Gauss-Newton on the distances. Errors: MeasureError if the points lie in a plane.
    """
    d = points.shape[1]
    root = np.sqrt(weights)[:, None]
    middle = np.average(points, axis=0, weights=weights)
    scale = max(float(np.abs(points - middle).max()), 1e-300)
    p = (points - middle) / scale
    design = np.hstack([2.0 * p, np.ones((len(p), 1))])
    solution, _, rank, _ = np.linalg.lstsq(design * root, (p**2).sum(axis=1) * root[:, 0], rcond=1e-10)
    if rank <= d:
        raise MeasureError("the interface is flat: no circle or sphere fits it")
    center, radius = solution[:d], np.sqrt(solution[d] + (solution[:d]**2).sum())
    for _ in range(50):
        arm = p - center
        distance = np.linalg.norm(arm, axis=1)
        jacobian = np.hstack([-arm / distance[:, None], -np.ones((len(p), 1))])
        change = np.linalg.lstsq(jacobian * root, -(distance - radius) * root[:, 0], rcond=None)[0]
        center, radius = center + change[:d], radius + change[d]
        if np.abs(change).max() < 1e-12 * max(radius, 1.0):
            break
    distance = np.linalg.norm(p - center, axis=1) - radius
    residual = np.sqrt(np.average(distance**2, weights=weights))
    return middle + scale * center, float(scale * radius), float(scale * residual)


def drop_shape(snapshot: Snapshot) -> DropShape:
    """The shape of the drop in a snapshot."""
    case, spacing = snapshot.case, float(snapshot.case["spacing"])
    axes = active_axes(case["dimensions"])
    wall = float(case["domain"]["lower"][2])
    elements = subdivided(mirrored(snapshot.elements, case), spacing, case["dimensions"])
    own = snapshot.elements.position[snapshot.elements.fraction > 0.5][:, axes]
    if len(own) == 0:
        return _nothing("no primary material is left")
    lower, upper = own.min(axis=0) - 3.0 * spacing, own.max(axis=0) + 3.0 * spacing
    round_wall = min(round_walls(case), key=lambda wall: np.median(wall.distance(own)), default=None)
    if round_wall is None:
        lower[-1] = wall
    for k, axis in enumerate(axes):   # images beyond the domain are not the drop
        lower[k] = max(lower[k], case["domain"]["lower"][axis])
        upper[k] = min(upper[k], case["domain"]["upper"][axis])
    resampled = Resampled(elements, case, lower, upper)
    inside = resampled.density >= SURFACE_DENSITY
    for one in round_walls(case):
        nodes = np.stack(np.meshgrid(resampled.coordinates(0), resampled.coordinates(1), indexing="ij"), axis=-1)
        inside &= one.distance(nodes.reshape(-1, 2)).reshape(inside.shape) >= 0.0
    drop, share = largest_region(inside)
    if not drop.any():
        return _nothing("the primary material is nowhere dense enough to have a surface")
    notes = [] if share > 0.999 else [f"{100 * (1 - share):.1f} % of the primary material is apart from the drop"]

    surface = interface(resampled, drop)
    height = surface.points[:, -1] - wall if round_wall is None else round_wall.distance(surface.points)
    above = height > WALL_LAYER * spacing
    points, weights = surface.points[above], surface.weights[above]
    if len(points) < 4 * len(axes):
        return _nothing("the drop is not higher than the layer at the wall that the fit leaves out")
    try:
        center, radius, residual = fit_sphere(points, weights)
    except MeasureError as problem:
        return _nothing(str(problem))
    shift = resampled.surface_variance * (len(axes) - 1) / (2.0 * radius)
    nodes = resampled.origin + resampled.grid_spacing * np.argwhere(drop)
    hollow = round_wall is not None and np.linalg.norm(nodes.mean(axis=0) - center) > radius
    outward = (points - center) / np.linalg.norm(points - center, axis=1, keepdims=True)
    points, radius = points + shift * outward, radius + shift
    if round_wall is not None:
        return _on_round_wall(points, weights, center, radius, bool(hollow), residual, round_wall, spacing, notes)
    if abs(center[-1] - wall) >= radius:
        touching = "floats above" if center[-1] > wall else "is a sheet below"
        return _nothing(f"the fitted sphere {touching} the wall and does not meet it")

    angle = float(np.arccos((wall - center[-1]) / radius))
    base_of_fit = float(np.sqrt(radius**2 - (center[-1] - wall)**2))
    height_of_fit = float(center[-1] + radius - wall)
    base = _base_radius(resampled, drop, center, radius, shift, wall, case)
    height = _apex(points, max(APEX_REACH * spacing, APEX_SHARE * radius)) - wall
    if base is None:
        notes.append("the drop is too low for its base to be taken from the interface: from the fit instead")
        base = base_of_fit
    other = 2.0 * np.arctan2(height, base)
    if abs(other - angle) > DIFFERENT_ANGLE:
        notes.append(f"not a cap: the sphere fit gives {np.degrees(angle):.1f} degrees, "
                     f"height and base {np.degrees(other):.1f}")
    notes += _differences(base, base_of_fit, height, height_of_fit)
    return DropShape(angle, base, height, float(other), base_of_fit, height_of_fit, residual,
                     tuple(float(c) for c in center), "; ".join(notes))


def _differences(base: float, base_of_fit: float, height: float, height_of_fit: float) -> list[str]:
    """What to say where the interface and the fit do not agree."""
    return [f"{what} {of_interface:.4g} m from the interface, {of_fit:.4g} m from the sphere fit"
            for what, of_interface, of_fit in (("base radius", base, base_of_fit), ("height", height, height_of_fit))
            if abs(of_interface - of_fit) > DIFFERENT_LENGTH * of_fit]


def _on_round_wall(points: np.ndarray, weights: np.ndarray, center: np.ndarray, radius: float, hollow: bool, residual: float,
                   wall: RoundWall, spacing: float, notes: list[str]) -> DropShape:
    """The shape of a drop on a round wall, from its surface outside the layer that the wall disturbs and the circle fitted to it."""
    middle, sign = wall.center[[0, 2]], 1.0 if wall.inside else -1.0
    distance = float(np.linalg.norm(center - middle))
    if not abs(wall.radius - radius) < distance < wall.radius + radius:
        return _nothing("the fitted circle does not meet the wall's")
    cosine = sign * (distance**2 - wall.radius**2 - radius**2) / (2.0 * wall.radius * radius)
    fitted = RoundCap(radius, wall.radius, float(np.arccos(cosine)), wall.inside)
    angle, height_of_fit, axis = fitted.contact_angle, fitted.height, (center - middle) / distance
    if hollow:   # liquid around the circle: the rest of the vessel
        angle, height_of_fit, axis = np.pi - angle, 2.0 * wall.radius - fitted.height, -axis
    along, across = (points - middle) @ axis, (points - middle) @ [axis[1], -axis[0]]
    near = wall.distance(points) < BASE_LAYER * spacing
    base = None
    if np.count_nonzero(near) >= 6:
        root, rho = np.sqrt(weights[near]), np.hypot(along, across)[near]
        design = np.stack([2.0 * along[near], np.full(len(rho), spacing)], axis=1)
        solution, _, rank, _ = np.linalg.lstsq(design * root[:, None], rho**2 * root, rcond=1e-8)
        cosine = (wall.radius**2 - solution[1] * spacing) / (2.0 * solution[0] * wall.radius)
        if rank == 2 and abs(cosine) < 1.0:
            base = float(wall.radius * np.sqrt(1.0 - cosine**2))
    if base is None:
        notes.append("the drop is too low for its base to be taken from the interface: from the fit instead")
        base = fitted.base_radius
    height = sign * wall.radius + _apex(np.stack([across, -sign * along], axis=1), max(APEX_REACH * spacing, APEX_SHARE * radius))
    notes += _differences(base, fitted.base_radius, height, height_of_fit)
    return DropShape(float(angle), base, float(height), None, fitted.base_radius, float(height_of_fit), residual,
                     tuple(float(c) for c in center), "; ".join(notes))


def _nothing(why: str) -> DropShape:
    return DropShape(None, None, None, None, None, None, None, (), why)


def _base_radius(resampled: Resampled, drop: np.ndarray, center: np.ndarray, radius: float, shift: float,
                 wall: float, case: dict) -> float | None:
    """Radius at the wall, extrapolated from level sections just outside the layer that the wall disturbs."""
    heights = resampled.coordinates(drop.ndim - 1) - wall
    section = cross_section(resampled, drop) * _symmetry_factor(resampled, drop, case)
    r = section / 2.0 if drop.ndim == 2 else np.sqrt(section / np.pi)
    r = r + shift * radius / np.maximum(r, resampled.spacing)
    top = np.max(heights[drop.any(axis=tuple(range(drop.ndim - 1)))])
    spacing = resampled.spacing
    used = (heights > (REACH - 0.01) * spacing) & (heights < (BASE_LAYER + 0.01) * spacing)
    used &= heights < top - 0.75 * spacing
    if np.count_nonzero(used) < 3:
        return None
    z = heights[used] / spacing
    square = (r[used] / spacing)**2 + z**2
    _, intercept = np.polyfit(z, square, 1)
    return float(spacing * np.sqrt(intercept)) if intercept > 0.0 else 0.0


def _symmetry_factor(resampled: Resampled, drop: np.ndarray, case: dict) -> float:
    """How often symmetry planes that the drop touches repeat it."""
    factor = 1.0
    for k, name in list(enumerate(("x", "y", "z")[axis] for axis in resampled.axes))[:-1]:
        for side, index, corner in (("min", 0, "lower"), ("max", -1, "upper")):
            boundary = case["domain"]["boundaries"].get(f"{name}_{side}") or {}
            plane = case["domain"][corner][resampled.axes[k]]
            at_plane = abs(resampled.coordinates(k)[index] - plane) < resampled.grid_spacing
            if boundary.get("kind") == "symmetry" and at_plane and np.take(drop, index, axis=k).any():
                factor *= 2.0
    return factor


def _apex(points: np.ndarray, reach: float) -> float:
    """Greatest height of a paraboloid through the surface within `reach` (m) of its highest point."""
    highest = points[np.argmax(points[:, -1])]
    aside = points[:, :-1] - highest[:-1]
    near = (np.linalg.norm(aside, axis=1) < reach) & (points[:, -1] > highest[-1] - reach)
    x, z = aside[near] / reach, points[near, -1]
    columns = [np.ones(len(x)), *x.T, *(x[:, i] * x[:, j] for i in range(x.shape[1]) for j in range(i, x.shape[1]))]
    design = np.stack(columns, axis=1)
    if len(x) < 2 * design.shape[1]:
        return float(highest[-1])
    coefficients = np.linalg.lstsq(design, z, rcond=None)[0]
    return float((design @ coefficients).max())


def _reading(snapshot: Snapshot, value_of, beside_of) -> Reading:
    shape: DropShape = snapshot.once(drop_shape)
    return Reading(value_of(shape), beside=beside_of(shape), note=shape.note)


def _exact_cap(case: dict) -> Cap | RoundCap:
    """The cap that the drop of the case must become."""
    bodies, wall = primary_bodies(case), float(case["domain"]["lower"][2])
    if len(bodies) != 1 or bodies[0].get("shape") != "sphere":
        raise MeasureError("resolved case: the exact cap is known for one sphere as drop; "
                           "give the reference's value in the case file")
    drop = bodies[0]
    angle = _exact_angle(case)
    walls = round_walls(case)
    if walls:
        middle = np.array(drop["center"])[[0, 2]]
        wall = min(walls, key=lambda one: abs(float(one.distance(middle[None, :])[0])))
        shared = {one.inside: common_area(drop["radius"], one.radius, float(np.linalg.norm(middle - one.center[[0, 2]]))) for one in walls}
        area = shared.get(True, np.pi * drop["radius"]**2) - shared.get(False, 0.0)
        return RoundCap.of_content(area, wall.radius, angle, wall.inside)
    start = np.arccos(np.clip((wall - drop["center"][2]) / drop["radius"], -1.0, 1.0))
    content = Cap(drop["radius"], float(start), case["dimensions"]).content
    return Cap.of_content(content, angle, case["dimensions"])


def _exact_angle(case: dict) -> float:
    return float(look_up(primary_material(case, "contact_angle"), "contact_angle"))


@measure_of_snapshot("contact_angle", unit="rad", exact=_exact_angle)
def contact_angle(snapshot: Snapshot) -> Reading:
    def beside(s: DropShape) -> dict:
        place = {f"center_{axis}_m": value for axis, value in zip("xyz" if len(s.center) == 3 else "xz", s.center)}
        return {"from_height_and_base_rad": s.angle_from_height_and_base, "fit_residual_m": s.fit_residual} | place

    return _reading(snapshot, lambda s: s.contact_angle, beside)


@measure_of_snapshot("base_radius", unit="m", exact=lambda case: _exact_cap(case).base_radius)
def base_radius(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda s: s.base_radius, lambda s: {"from_fit_m": s.base_radius_from_fit})


@measure_of_snapshot("apex_height", unit="m", exact=lambda case: _exact_cap(case).height)
def apex_height(snapshot: Snapshot) -> Reading:
    return _reading(snapshot, lambda s: s.apex_height, lambda s: {"from_fit_m": s.apex_height_from_fit})
