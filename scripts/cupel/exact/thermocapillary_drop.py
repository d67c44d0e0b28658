"""Migration of a drop in a liquid with a temperature gradient, toward the hot side where d(sigma)/dT < 0.

Unbounded, no inertia or convection of heat, 3-D (Young, Goldstein and Block 1959) and 2-D:

    3-D   U = 2 |d(sigma)/dT| grad(T) R / [(2 + k_d/k_b) (2 mu_b + 3 mu_d)]
    2-D   U = |d(sigma)/dT| grad(T) R / [2 (1 + k_d/k_b) (mu_b + mu_d)]

2-D: the interface has T = 2 grad(T) R cos(theta)/(1 + k_d/k_b); outside is the potential dipole that moves with U (no force, so
no paradox of Stokes), inside, in the drop's frame, u_r = U (1 - r^2/R^2) cos(theta), u_theta = U (3 r^2/R^2 - 1) sin(theta);
the jump 4 U (mu_b + mu_d) sin(theta)/R of shear stress balances d(sigma)/ds.

Ma and Bothe 2011 (Int. J. Multiphase Flow 37, 1045), 2-D drop in a box of 4 radii with the properties below: `MA_BOTHE_TIME`,
`MA_BOTHE_SPEED`, in units of U_r = |d(sigma)/dT| grad(T) R/mu_b and t_r = R/U_r.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

MA_BOTHE_TIME = (0.102, 0.198, 0.300, 0.400, 0.503, 0.603, 0.702, 0.801, 1.004, 1.9)
MA_BOTHE_SPEED = (0.0596, 0.0945, 0.1141, 0.1258, 0.1325, 0.1366, 0.1395, 0.1404, 0.1409, 0.141)
MA_BOTHE_PLATEAU = 0.141
# The same drop by finite elements that fit its circle (drop_between_plates.py), converged to 2e-4 but at 0.1: 5 to 7 % of the plateau
# above the table, at every time.
FITTED_TIME = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9)
FITTED_SPEED = (0.06733, 0.10187, 0.12177, 0.13367, 0.14089, 0.14530, 0.14798, 0.14957, 0.15048, 0.15095, 0.15113, 0.15110, 0.15093,
                0.15066, 0.15030, 0.14988, 0.14940, 0.14887, 0.14829)
# Groups that the table belongs to: Reynolds rho_b U_r R/mu_b, Marangoni rho_b c_b U_r R/k_b, capillary mu_b U_r/sigma, drop over bulk.
MA_BOTHE_GROUPS = {"Reynolds number": 0.72, "Marangoni number": 0.72, "capillary number": 0.0576,
                   "density ratio": 0.5, "viscosity ratio": 0.5, "conductivity ratio": 0.5, "heat capacity ratio": 0.5,
                   "box width over radius": 4.0, "box height over radius": 4.0}


def migration_velocity(surface_tension_slope: float, temperature_gradient: float, radius: float,
                       conductivity_drop: float, conductivity_bulk: float,
                       viscosity_drop: float, viscosity_bulk: float, dimensions: int = 3) -> float:
    """Velocity along the gradient in the unbounded limit, m/s; N/(m K), K/m, m, W/(m K), Pa s."""
    ratio = conductivity_drop / conductivity_bulk
    drive = -surface_tension_slope * temperature_gradient * radius
    if dimensions == 2:
        return drive / (2.0 * (1.0 + ratio) * (viscosity_bulk + viscosity_drop))
    return 2.0 * drive / ((2.0 + ratio) * (2.0 * viscosity_bulk + 3.0 * viscosity_drop))


def ma_bothe(time: np.ndarray) -> np.ndarray:
    """Tabulated U/U_r at t/t_r, by a monotone curve through the table; nan outside 0.102 to 1.9."""
    return PchipInterpolator(MA_BOTHE_TIME, MA_BOTHE_SPEED, extrapolate=False)(np.asarray(time, float))


def fitted(time: np.ndarray) -> np.ndarray:
    """U/U_r at t/t_r of the sharp interface, by finite elements; nan outside 0.1 to 1.9."""
    return PchipInterpolator(FITTED_TIME, FITTED_SPEED, extrapolate=False)(np.asarray(time, float))
