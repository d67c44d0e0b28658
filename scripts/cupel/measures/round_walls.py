"""Round walls of a case (domain.round_walls): where they are, and images of elements beyond them.

A wall is a circle of radius R about a centre, with liquid outside it (a cylinder) or inside (a vessel).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .elements import Elements


@dataclass(frozen=True)
class RoundWall:
    """center (3) and radius, m; inside: liquid lies inside the circle."""

    center: np.ndarray
    radius: float
    inside: bool

    def distance(self, points: np.ndarray) -> np.ndarray:
        """How far points (n, 2: x, z) lie from the wall on the liquid's side, m; negative beyond it."""
        beyond = np.linalg.norm(points - self.center[[0, 2]], axis=1) - self.radius
        return -beyond if self.inside else beyond


def round_walls(case: dict) -> list[RoundWall]:
    """The round walls of a resolved case; none where its walls are flat."""
    walls = case["domain"].get("round_walls") or {}
    return [RoundWall(np.array(walls["center"], float), float(walls[key]), key == "outer_radius")
            for key in ("inner_radius", "outer_radius") if walls.get(key) is not None]


def mirrored_in_round_walls(elements: Elements, case: dict, reach: float) -> Elements:
    """Elements with images beyond round walls, at r' = 2 R - r, r'/r of their volume; none without such walls."""
    for wall in round_walls(case):
        near = np.abs(wall.distance(elements.position[:, [0, 2]])) < reach
        image = elements.take(near)
        arm = (image.position - wall.center) * [1.0, 0.0, 1.0]
        scale = 2.0 * wall.radius / np.linalg.norm(arm, axis=1) - 1.0
        elements = Elements.joined([elements, replace(image, position=wall.center + scale[:, None] * arm, volume=scale * image.volume)])
    return elements
