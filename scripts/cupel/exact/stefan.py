"""One-phase Stefan problem: liquid at a wall of T_m + delta T eats into solid at T_m (Neumann; Alexiades and Solomon 1993).

    front delta = 2 beta sqrt(alpha t),   beta exp(beta^2) erf(beta) = St/sqrt(pi),   St = c delta T / L
    T(x, t) = T_wall - delta T erf(x / (2 sqrt(alpha t))) / erf(beta)
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq
from scipy.special import erf


def front_coefficient(stefan_number: float) -> float:
    """beta, of no unit. Errors: ValueError unless stefan_number > 0."""
    if not stefan_number > 0.0:
        raise ValueError(f"Stefan number must be positive, not {stefan_number}")
    target = stefan_number / np.sqrt(np.pi)
    upper = 1.0
    while upper * np.exp(upper**2) * erf(upper) < target:
        upper *= 2.0
    return float(brentq(lambda beta: beta * np.exp(beta**2) * erf(beta) - target, 0.0, upper, xtol=1e-14))


def front(time: np.ndarray, beta: float, diffusivity: float) -> np.ndarray:
    """Distance of the front from the wall, m; time s, diffusivity m^2/s."""
    return 2.0 * beta * np.sqrt(diffusivity * np.asarray(time, float))


def temperature(position: np.ndarray, time: float, beta: float, diffusivity: float,
                wall_temperature: float, melting_temperature: float) -> np.ndarray:
    """Temperature (K) at distance `position` (m) from the wall at `time` (s); T_m beyond the front."""
    similarity = np.asarray(position, float) / (2.0 * np.sqrt(diffusivity * time))
    drop = (wall_temperature - melting_temperature) / erf(beta)
    return np.where(similarity < beta, wall_temperature - drop * erf(similarity), melting_temperature)
