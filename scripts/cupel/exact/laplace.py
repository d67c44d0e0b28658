"""Pressure jump across the surface of a drop at rest (Young, Laplace):  delta p = (d - 1) sigma / R."""


def laplace_pressure(surface_tension: float, radius: float, dimensions: int) -> float:
    """Pressure inside less outside, Pa; surface_tension N/m, radius m, dimensions 2 or 3."""
    if dimensions not in (2, 3) or radius <= 0.0:
        raise ValueError(f"no drop has radius {radius} m in {dimensions} dimensions")
    return (dimensions - 1) * surface_tension / radius
