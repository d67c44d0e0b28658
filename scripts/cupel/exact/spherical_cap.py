"""Geometry of a drop on a plane: cap of a sphere (3-D) or segment of a circle (2-D) that meets the plane at theta.

    base radius  a = R sin(theta)          height  h = R (1 - cos(theta))
    3-D volume   V = pi R^3 (2 - 3 cos(theta) + cos^3(theta))/3
    2-D area     A = R^2 (theta - sin(theta) cos(theta))
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Cap:
    """radius: of the sphere or circle, m; contact_angle: rad, 0 < theta <= pi, inside the drop; dimensions: 2 or 3.

    Errors: ValueError outside those bounds.
    """

    radius: float
    contact_angle: float
    dimensions: int = 3

    def __post_init__(self):
        if not (self.radius > 0.0 and 0.0 < self.contact_angle <= np.pi and self.dimensions in (2, 3)):
            raise ValueError(f"no cap has radius {self.radius} m and angle {self.contact_angle} rad "
                             f"in {self.dimensions} dimensions")

    @staticmethod
    def of_content(content: float, contact_angle: float, dimensions: int = 3) -> Cap:
        """The cap of that volume (m^3) or, in 2-D, area (m^2)."""
        unit = Cap(1.0, contact_angle, dimensions).content
        return Cap((content / unit)**(1.0 / dimensions), contact_angle, dimensions)

    @property
    def content(self) -> float:
        """Volume (m^3) in 3-D, area (m^2) in 2-D."""
        theta, c = self.contact_angle, np.cos(self.contact_angle)
        if self.dimensions == 2:
            return float(self.radius**2 * (theta - np.sin(theta) * c))
        return float(np.pi * self.radius**3 * (2.0 - 3.0 * c + c**3) / 3.0)

    @property
    def base_radius(self) -> float:
        return float(self.radius * np.sin(self.contact_angle))

    @property
    def height(self) -> float:
        return float(self.radius * (1.0 - np.cos(self.contact_angle)))
