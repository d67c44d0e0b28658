"""Exact end of the droplet wetting: the spherical cap with the drop's volume and contact angle.

A cap of radius a with contact angle theta has the height h = a (1 - cos theta), the base radius a sin theta and the
volume (pi a^3 / 3) (2 + cos theta) (1 - cos theta)^2. With the volume 4/3 pi R^3 of the drop,
a = R [4 / ((2 + cos theta) (1 - cos theta)^2)]^(1/3).
"""

from math import cos, radians, sin


def spherical_cap(drop_radius: float, contact_angle: float) -> tuple[float, float, float]:
    """Cap radius, base radius and apex height [unit of `drop_radius`] for a contact angle [rad] in (0, pi)."""
    cap_radius = drop_radius * (4 / ((2 + cos(contact_angle)) * (1 - cos(contact_angle)) ** 2)) ** (1 / 3)
    return cap_radius, cap_radius * sin(contact_angle), cap_radius * (1 - cos(contact_angle))


if __name__ == "__main__":
    cap_radius, base_radius, apex_height = spherical_cap(1.0, radians(45))
    print(f"cap radius {cap_radius:.4f} mm, base radius {base_radius:.4f} mm, apex height {apex_height:.4f} mm")
