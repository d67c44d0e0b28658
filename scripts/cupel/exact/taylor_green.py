"""Taylor-Green vortex in two dimensions (Taylor and Green 1937), an exact solution of the Navier-Stokes equations:

    u = U sin(kx) cos(kz) exp(-2 nu k^2 t),   w = -U cos(kx) sin(kz) exp(-2 nu k^2 t),   k = 2 pi/wavelength

Its kinetic energy decays as exp(-4 nu k^2 t).
"""

from __future__ import annotations

import numpy as np


def energy_decay_rate(kinematic_viscosity: float, wavelength: float) -> float:
    """Rate at which the kinetic energy decays, 4 nu k^2, 1/s; m^2/s, m."""
    return float(4.0 * kinematic_viscosity * (2.0 * np.pi / wavelength)**2)


def velocity(position: np.ndarray, time: float, speed: float, kinematic_viscosity: float, wavelength: float) -> np.ndarray:
    """Velocity (n, 3) m/s at points (n, 3) m and `time` s; speed U m/s."""
    k = 2.0 * np.pi / wavelength
    x, z = k * position[:, 0], k * position[:, 2]
    amplitude = speed * np.exp(-2.0 * kinematic_viscosity * k**2 * time)
    return amplitude * np.column_stack([np.sin(x) * np.cos(z), np.zeros(len(position)), -np.cos(x) * np.sin(z)])
