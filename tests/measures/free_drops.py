"""Free drops with a known disturbance, pressure and velocity, as particles and as cells; spacing 1 unless said otherwise."""

from dataclasses import replace

import numpy as np
from cupel.measures import Elements
from tests.measures.exact_elements import cells, lattice, particles, scene

LIQUID = {"density": 1.0, "viscosity": 0.5, "surface_tension": 10.0}


def drop_scene(dimensions=2, radius=10.0, half=16.0, amplitude=0.01, mode=2, resolved=False, **more):
    """A resolved case of a drop around the origin."""
    lower, upper = [-half, -half if dimensions == 3 else 0.0, -half], [half, half if dimensions == 3 else 0.0, half]
    body = {"shape": "sphere", "material": "liquid", "state": "liquid", "center": [0.0, 0.0, 0.0], "radius": radius,
            "perturbation": {"mode": mode, "amplitude": amplitude}}
    return scene(1.0, dimensions, lower, upper, materials={"liquid": dict(LIQUID), "gas": {"density": 1e-3, "viscosity": 1e-5}},
                 surrounding={"material": "gas", "resolved": resolved}, bodies=[body]) | more


def shaped(form, dimensions=2, radius=10.0, amplitude=0.0, mode=2, time=0.0, center=(0.13, 0.0, -0.21), noise=0.2, seed=1) -> Elements:
    """Elements of a drop r < R [1 + a cos(n phi)] or R [1 + a P_n].

    Particles follow the shape by stretching a round drop cut out of a lattice ("lattice") or one with positions moved at random by
    up to `noise` ("jittered"); mode 2 only. Cells have the exact volume fractions, to 1/8 of a cell.
    """
    center = np.array(center) * ([1, 1, 1] if dimensions == 3 else [1, 0, 1])
    half = np.ceil(radius) + 6.0
    lower = np.array([-half, -half if dimensions == 3 else 0.0, -half])
    upper = -lower
    if form == "cells":
        def inside(points):
            arm = (points - center) * ([1, 1, 1] if dimensions == 3 else [1, 0, 1])
            r = np.linalg.norm(arm, axis=1)
            phi = np.arctan2(arm[:, 2], arm[:, 0])
            cosine = arm[:, 2] / np.maximum(r, 1e-12)
            shape = np.cos(mode * phi) if dimensions == 2 else 1.5 * cosine**2 - 0.5
            return r <= radius * (1.0 + amplitude * shape)

        return cells(inside, lower, upper, 1.0, dimensions, finer=8, time=time)
    points = lattice(lower, upper, 1.0, dimensions, offset=0.0)
    points = points[np.linalg.norm(points, axis=1) <= radius]
    if form == "jittered":
        points = points + np.random.default_rng(seed).uniform(-noise, noise, points.shape) * ([1, 1, 1] if dimensions == 3 else [1, 0, 1])
    stretch = [np.exp(amplitude), 1.0, np.exp(-amplitude)] if dimensions == 2 else \
        [np.exp(-0.5 * amplitude), np.exp(-0.5 * amplitude), np.exp(amplitude)]
    return particles(points * stretch + center, 1.0, dimensions, time=time)


def with_pressure(made: Elements, inside: float, outside: float = 0.0, noise: float = 0.0) -> Elements:
    """Elements with a uniform pressure on each side, scattered at random by `noise` (standard deviation)."""
    pressure = np.where(made.fraction > 0.5, inside, outside)
    return replace(made, pressure=pressure + np.random.default_rng(5).normal(0.0, noise or 1e-300, made.count))
