"""Thermocapillary return flow in a long shallow layer with closed ends (Birikh 1966; Sen and Davis 1982).

    u(eta) = (tau H / 4 mu) (3 eta^2 - 2 eta),  eta = z/H,  tau = d(sigma)/dT dT/dx

No net flux; zero at eta = 2/3; surface speed tau H/4 mu. For d(sigma)/dT < 0 the surface runs to the cold side.
"""

from __future__ import annotations

import numpy as np


def surface_velocity(stress: float, depth: float, viscosity: float) -> float:
    """Velocity at the surface, m/s, signed as stress: N/m^2 along x; depth m, viscosity Pa s."""
    return stress * depth / (4.0 * viscosity)


def velocity(eta: np.ndarray, stress: float, depth: float, viscosity: float) -> np.ndarray:
    """Velocity along x at relative height eta = z/H, m/s."""
    eta = np.asarray(eta, float)
    return surface_velocity(stress, depth, viscosity) * (3.0 * eta**2 - 2.0 * eta)
