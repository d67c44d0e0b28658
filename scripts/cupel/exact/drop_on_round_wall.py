"""Geometry of a drop on a round wall in two dimensions: an arc of radius r that meets a circle of radius R at the contact angle.

Without gravity a drop's surface has one curvature, so that drop and wall are two circles. Their radii to the point where they meet
enclose the contact angle theta (measured in the liquid) if the liquid lies outside the wall's circle, and pi - theta if inside:

    distance of the centres   D^2 = R^2 + r^2 - 2 R r cos(theta)   on a cylinder,   R^2 + r^2 + 2 R r cos(theta)   in a vessel
    half the wetted arc       cos(beta) = (R^2 + D^2 - r^2)/(2 R D),   half the wetted chord   a = R sin(beta)
    height over the wall      D + r - R   on a cylinder,   R + r - D   in a vessel
    area                      pi r^2 less what both discs share,       what both discs share

(law of cosines; own derivation). R to infinity is the segment on a plane of `spherical_cap`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


def common_area(a: float, b: float, distance: float) -> float:
    """Area (m^2) that two discs of radius a and b (m) have in common, their centres `distance` (m) apart."""
    if distance >= a + b:
        return 0.0
    if distance <= abs(a - b):
        return float(np.pi * min(a, b)**2)

    def segment(r: float, other: float) -> float:
        angle = np.arccos(np.clip((distance**2 + r**2 - other**2) / (2.0 * distance * r), -1.0, 1.0))
        return r**2 * (angle - np.sin(angle) * np.cos(angle))
    return float(segment(a, b) + segment(b, a))


@dataclass(frozen=True)
class RoundCap:
    """radius: of the drop's arc, m; wall_radius: m; contact_angle: rad, inside the drop; inside: in a vessel, not on a cylinder."""

    radius: float
    wall_radius: float
    contact_angle: float
    inside: bool

    @staticmethod
    def of_content(content: float, wall_radius: float, contact_angle: float, inside: bool) -> RoundCap:
        """The drop of that area (m^2). Errors: ValueError where no arc that bulges out of the liquid holds it."""
        def excess(log_radius: float) -> float:
            return RoundCap(float(np.exp(log_radius)), wall_radius, contact_angle, inside).content - content
        small, great = np.log(1e-3 * np.sqrt(content)), np.log(1e3 * (np.sqrt(content) + wall_radius))
        if excess(small) * excess(great) > 0.0:
            raise ValueError(f"no drop of {content} m^2 that bulges meets a round wall of radius {wall_radius} m at {contact_angle} rad")
        return RoundCap(float(np.exp(brentq(excess, small, great, xtol=1e-13))), wall_radius, contact_angle, inside)

    @property
    def distance(self) -> float:
        """Between the centres of wall and arc, m."""
        sign = 1.0 if self.inside else -1.0
        return float(np.sqrt(self.wall_radius**2 + self.radius**2 + 2.0 * sign * self.wall_radius * self.radius * np.cos(self.contact_angle)))

    @property
    def content(self) -> float:
        """Area, m^2."""
        shared = common_area(self.radius, self.wall_radius, self.distance)
        return shared if self.inside else float(np.pi * self.radius**2 - shared)

    @property
    def base_radius(self) -> float:
        """Half the chord between the contact points, m."""
        cosine = (self.wall_radius**2 + self.distance**2 - self.radius**2) / (2.0 * self.wall_radius * self.distance)
        return float(self.wall_radius * np.sqrt(max(0.0, 1.0 - cosine**2)))

    @property
    def height(self) -> float:
        """Greatest distance of the drop from its wall, m."""
        return self.wall_radius + self.radius - self.distance if self.inside else self.distance + self.radius - self.wall_radius
