"""Recoil pressure of evaporation (Anisimov 1968) and the balance of a surface at rest under it.

    p_r(T) = 0.54 p_0 exp[(L_v M/R)(1/T_b - 1/T)]                         p_0 the ambient pressure, T_b boiling at p_0
    p_liquid - p_ambient = p_r(T) + sigma kappa                           kappa > 0 where the liquid bulges

Over a part of the surface with the footprint A and the rim C, as forces along z (no curvature needed):

    integral over A of (p_liquid - p_r) dA = -sigma * integral over C of sin(phi) dl,   tan(phi) = dz/dn outward
"""

from __future__ import annotations

import numpy as np

GAS_CONSTANT = 8.314462618   # J/(mol K)
SHARE = 0.54


def recoil_pressure(temperature: np.ndarray, boiling_temperature: float, vaporization_heat: float, molar_mass: float,
                    ambient_pressure: float) -> np.ndarray:
    """Recoil pressure, Pa, at surface temperatures (K); J/kg, kg/mol, Pa."""
    temperature = np.asarray(temperature, float)
    exponent = vaporization_heat * molar_mass / GAS_CONSTANT * (1.0 / boiling_temperature - 1.0 / temperature)
    return SHARE * ambient_pressure * np.exp(exponent)
