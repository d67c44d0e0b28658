"""Snapshots whose every measure is known: lattices of particles and volume-fraction cells made from formulas."""

from dataclasses import replace

import numpy as np
from cupel.exact.spherical_cap import Cap
from cupel.measures import Elements


def scene(spacing, dimensions, lower, upper, **more):
    """A resolved case with walls all round, one drop of 'liquid' unless `more` says otherwise."""
    names = [f"{axis}_{side}" for axis in ("xyz" if dimensions == 3 else "xz") for side in ("min", "max")]
    case = {
        "schema": 1, "name": "made", "spacing": spacing, "dimensions": dimensions, "physics": ["flow"],
        "materials": {"liquid": {"density": 1000.0, "viscosity": 1e-3}},
        "surrounding": {"material": "gas", "resolved": False},
        "domain": {"lower": list(lower), "upper": list(upper), "boundaries": {name: {"kind": "wall"} for name in names}},
        "initial": {"temperature": 300.0, "temperature_gradient": [0.0, 0.0, 0.0]},
        "bodies": [], "laser": None, "time": {"end": 1.0, "output_interval": 0.1}, "measures": [],
    }
    return case | more


def lattice(lower, upper, spacing, dimensions=3, offset=0.0):
    """Points (n, 3) of a lattice between two corners, the first half a spacing (plus offset) inside."""
    axes = (0, 1, 2) if dimensions == 3 else (0, 2)
    lines = [lower[k] + spacing * (0.5 + offset + np.arange(int(np.ceil((upper[k] - lower[k]) / spacing - 1e-9))))
             if k in axes else np.zeros(1) for k in range(3)]
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)


def particles(position, spacing, dimensions=3, **fields):
    """Particles of spacing^d at given points; fields as for Elements."""
    n = len(position)
    return Elements(position, np.full(n, spacing**dimensions), fields.pop("fraction", np.ones(n)), **fields)


def cells(inside, lower, upper, spacing, dimensions=3, finer=6, **fields):
    """Cubic cells with fraction = share of a cell where inside(points) holds, by finer^d points in mixed cells."""
    position = lattice(lower, upper, spacing, dimensions)
    axes = (0, 1, 2) if dimensions == 3 else (0, 2)
    steps = (np.arange(finer) + 0.5) / finer - 0.5
    sub = np.zeros((finer**dimensions, 3))
    sub[:, axes] = np.stack(np.meshgrid(*[steps] * dimensions, indexing="ij"), axis=-1).reshape(-1, dimensions)
    corners = np.zeros((2**dimensions, 3))
    corners[:, axes] = np.stack(np.meshgrid(*[(-0.5, 0.5)] * dimensions, indexing="ij"), axis=-1).reshape(-1, dimensions)
    seen = np.stack([inside(position + spacing * shift) for shift in (*corners, np.zeros(3))])
    fraction = seen[-1].astype(float)
    mixed = np.flatnonzero(seen.any(axis=0) & ~seen.all(axis=0))
    points = position[mixed, None, :] + spacing * sub
    fraction[mixed] = inside(points.reshape(-1, 3)).reshape(len(mixed), len(sub)).mean(axis=1)
    n = len(position)
    fields = {name: value(position) if callable(value) else value for name, value in fields.items()}
    return Elements(position, np.full(n, spacing**3), fraction, extent=np.full((n, 3), spacing), **fields)


def in_cap(cap, center=(0.0, 0.0)):
    """inside(points) of a cap on z = 0 whose axis is at `center`; a 2-D cap ignores y."""
    middle = np.array([center[0], center[1], cap.height - cap.radius])

    def inside(points):
        arm = points - middle
        if cap.dimensions == 2:
            arm = arm * [1.0, 0.0, 1.0]
        return (np.linalg.norm(arm, axis=1) <= cap.radius) & (points[:, 2] >= 0.0)

    return inside


def drop(angle_degrees, form, diameter=20.0, dimensions=3, center=(0.13, -0.21), seed=1, noise=0.15, room=None):
    """Elements and case of a cap of the volume of a ball of `diameter` spacings (spacing 1).

    form: "lattice", "jittered" (each particle moved by up to `noise` along each axis), "two_phase" or "cells".
    room: half width and height of the domain, in spacings; 4 more than the drop if None.
    """
    ball = np.pi * diameter**3 / 6.0 if dimensions == 3 else np.pi * diameter**2 / 4.0
    cap = Cap.of_content(ball, np.radians(angle_degrees), dimensions)
    widest = cap.radius if angle_degrees > 90 else cap.base_radius
    half, top = room or (np.ceil(widest) + 4.0, np.ceil(cap.height) + 4.0)
    lower = [-half, -half if dimensions == 3 else 0.0, 0.0]
    upper = [half, half if dimensions == 3 else 0.0, top]
    lower, upper = np.array(lower), np.array(upper)
    inside = in_cap(cap, center)
    case = scene(1.0, dimensions, lower, upper)
    if form == "cells":
        return cells(inside, lower, upper, 1.0, dimensions), case, cap
    points = lattice(lower, upper, 1.0, dimensions)
    chosen = inside(points)
    if form == "two_phase":
        return particles(points, 1.0, dimensions, fraction=chosen.astype(float)), case, cap
    points = points[chosen]
    if form == "jittered":
        shift = np.random.default_rng(seed).uniform(-noise, noise, points.shape)
        points = points + shift * ([1, 1, 1] if dimensions == 3 else [1, 0, 1])
    return particles(points, 1.0, dimensions), case, cap


def track_scene(spacing=20e-6, begin=(-6e-4, 0.0), end=(0.0, 0.0), lower=(-8e-4, -2.4e-4, -2e-4),
                upper=(2e-4, 2.4e-4, 1e-4), **more):
    """A resolved case of a laser on a steel plate with its surface at z = 0; the beam is at `end` at t = 4 ms."""
    steel = {"density": 6900.0, "specific_heat": 780.0, "conductivity": 25.0, "melting_temperature": 1723.0}
    names = ["x_min", "x_max", "y_min", "y_max", "z_min", "z_max"]
    case = scene(spacing, 3, lower, upper, physics=["heat", "laser"], materials={"steel": steel},
                 bodies=[{"shape": "box", "material": "steel", "state": "solid",
                          "lower": list(lower), "upper": [upper[0], upper[1], 0.0]}],
                 laser={"power": 150.0, "speed": 0.15, "spot_radius": 8e-5, "absorptivity": 0.35,
                        "path": {"from": list(begin), "to": list(end)}, "start": 0.0},
                 time={"end": 4e-3, "output_interval": 1e-3})
    case["domain"]["boundaries"] = {name: {"kind": "wall"} for name in names[:5]} | {"z_max": {"kind": "open"}}
    return case | more


def plate(case, temperature, form, time=4e-3, offset=(0.0, 0.0), noise=0.15, seed=1, **fields):
    """The plate z <= 0 of a track scene in a given form, temperature(position) in metal, 300 K in gas cells.

    offset: shift of the lattice in x and y, in spacings. Fields that are functions are taken at the positions.
    """
    spacing, lower, upper = case["spacing"], np.array(case["domain"]["lower"]), np.array(case["domain"]["upper"])
    if form == "cells":
        made = cells(lambda p: p[:, 2] <= 0.0, lower, upper, spacing, time=time)
    else:
        points = lattice(lower, [upper[0], upper[1], 0.0], spacing)
        points += spacing * np.array([*offset, 0.0])
        if form == "jittered":
            points += spacing * np.random.default_rng(seed).uniform(-noise, noise, points.shape)
        made = particles(points, spacing, time=time)
    return with_fields(made, temperature=temperature, **fields)


def with_fields(made, **fields):
    """Elements with further fields from functions of position; gas (fraction < 1/2) stays at 300 K."""
    values = {name: np.where(made.fraction >= 0.5, function(made.position), 300.0) for name, function in fields.items()}
    return replace(made, **values)
