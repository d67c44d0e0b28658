"""Start-up of flow between parallel walls z = 0 and z = H from rest (Poiseuille, Couette, or both together):

    du/dt = g + nu d2u/dz2,   u(0) = U_0,   u(H) = U_1,   u(t = 0) = 0
    u = g z (H - z)/(2 nu) + U_0 + (U_1 - U_0) z/H - sum_n b_n sin(n pi z/H) exp(-n^2 pi^2 nu t/H^2)
    b_n = 2 g H^2 (1 - (-1)^n)/(nu pi^3 n^3) + 2 [U_0 - (-1)^n U_1]/(n pi)

the sine series of the steady flow (Batchelor 1967, section 4.3); g the body force per mass along x.
"""

from __future__ import annotations

import numpy as np

GREATEST_EXPONENT = 40.0   # terms decayed by exp(-40) or more add nothing
GREATEST_NUMBER = 4000     # of terms, met only at times below 1e-6 H^2/nu


def velocity(height: np.ndarray, time: float, depth: float, kinematic_viscosity: float, acceleration: float = 0.0,
             lower_speed: float = 0.0, upper_speed: float = 0.0) -> np.ndarray:
    """Velocity along x (m/s) at heights (n) m above the lower wall at `time` s.

    depth H m, m^2/s, acceleration g m/s^2, speeds of the walls m/s. At time 0 or before the fluid is at rest.
    """
    z = np.asarray(height, float) / depth
    if time <= 0.0:
        return np.zeros(z.shape)
    rate = np.pi**2 * kinematic_viscosity * time / depth**2
    result = steady(height, depth, kinematic_viscosity, acceleration, lower_speed, upper_speed)
    count = int(np.clip(np.sqrt(GREATEST_EXPONENT / rate), 1, GREATEST_NUMBER))
    for n in range(1, count + 1):
        sign = (-1.0)**n
        coefficient = (2.0 * acceleration * depth**2 * (1.0 - sign) / (kinematic_viscosity * np.pi**3 * n**3)
                       + 2.0 * (lower_speed - sign * upper_speed) / (n * np.pi))
        result = result - coefficient * np.sin(n * np.pi * z) * np.exp(-n**2 * rate)
    return result


def steady(height: np.ndarray, depth: float, kinematic_viscosity: float, acceleration: float = 0.0,
           lower_speed: float = 0.0, upper_speed: float = 0.0) -> np.ndarray:
    """The flow that the start-up ends in, m/s."""
    z = np.asarray(height, float)
    return (acceleration * z * (depth - z) / (2.0 * kinematic_viscosity)
            + lower_speed + (upper_speed - lower_speed) * z / depth)
