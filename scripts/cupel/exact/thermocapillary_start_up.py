"""Start of a disc's thermocapillary migration in an unbounded liquid at rest, whose temperature has a uniform gradient G from the first
moment on, in creeping flow (no inertia of convection, no heat carried along, no deformation).

The disc keeps its circle, so that all is of the form cos(theta) or sin(theta). Laplace transform in time, lengths over the radius a; with
x = a (s rho/mu)^(1/2) of the liquid and y of the drop, both for momentum and (h) for heat, x^2 = a^2 s rho c/k,

    K(x) = -x K_1'(x)/K_1(x) = 1 + x K_0(x)/K_1(x)            I(y) = y I_1'(y)/I_1(y) = y I_0(y)/I_1(y) - 1

Temperature: G r cos(theta) and what decays outward as K_1, inward as I_1; equal on both sides, with equal flux:

    T_1 = G a/s [1 + (k_b - k_d)/(k_b K_h + k_d I_h)]         of the surface, T = T_1 cos(theta); at last 2 G a/(1 + k_d/k_b)

Flow in the frame of the liquid far away: outside a potential dipole A and a vortical part B, inside a uniform flow C and a vortical part D,
each scaled by its u_r at the surface. With p = -rho dphi/dt of the potential parts:

    u_r:      A + B = C + D = U                                u_theta:   A + K B = -C - I D
    normal:   mu_b [-(4 + x^2) A - 2 (1 + K) B] - mu_d [y^2 C + 2 (I - 1) D] = sigma' T_1
    shear:    mu_b [-4 A - (2 + x^2 + 2 K) B] + mu_d (2 + y^2 - 2 I) D = sigma' T_1

(sigma' = d(sigma)/dT: the surface pulls along itself with sigma' T_1 sin(theta)/a and inward with sigma' T_1 cos(theta)/a, together with no
net force). The limit is that of thermocapillary_drop.migration_velocity; it is approached as 1/t only, since vorticity spreads over the plane:
with the fluids of Ma and Bothe U is 12 % below it at t = 2 a^2/nu and still 4 % at 7 a^2/nu.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import ive, kve

from .laplace_inversion import inverted


@dataclass(frozen=True)
class Fluid:
    """Density kg/m^3, viscosity Pa s, conductivity W/(m K), specific heat J/(kg K)."""

    density: float
    viscosity: float
    conductivity: float
    specific_heat: float


def velocity(time: np.ndarray, surface_tension_slope: float, temperature_gradient: float, radius: float, drop: Fluid,
             bulk: Fluid) -> np.ndarray:
    """Velocity along the gradient (n) m/s at times (n) s after the start; N/(m K), K/m, m. Zero at time 0."""
    def transform(rate: np.ndarray) -> np.ndarray:
        surface = _surface_temperature(rate, temperature_gradient, radius, drop, bulk)
        return _velocity(rate, surface_tension_slope * surface, radius, drop, bulk)

    return np.array([inverted(transform, float(t), 0.0) if t > 0.0 else 0.0 for t in np.atleast_1d(time)])


def _outward(x: np.ndarray) -> np.ndarray:
    return 1.0 + x * kve(0, x) / kve(1, x)


def _inward(y: np.ndarray) -> np.ndarray:
    return y * ive(0, y) / ive(1, y) - 1.0


def _surface_temperature(rate: np.ndarray, gradient: float, radius: float, drop: Fluid, bulk: Fluid) -> np.ndarray:
    """Transform of T_1, K s, at rates (n) 1/s."""
    outside = bulk.conductivity * _outward(radius * np.sqrt(rate * bulk.density * bulk.specific_heat / bulk.conductivity))
    inside = drop.conductivity * _inward(radius * np.sqrt(rate * drop.density * drop.specific_heat / drop.conductivity))
    return gradient * radius / rate * (1.0 + (bulk.conductivity - drop.conductivity) / (outside + inside))


def _velocity(rate: np.ndarray, pull: np.ndarray, radius: float, drop: Fluid, bulk: Fluid) -> np.ndarray:
    """Transform of U, m, where the amplitude of surface tension has the transform `pull` (n), N s/m."""
    x, y = (radius * np.sqrt(rate * fluid.density / fluid.viscosity) for fluid in (bulk, drop))
    out, into = _outward(x), _inward(y)
    one, none = np.ones_like(x), np.zeros_like(x)
    rows = [[one, one, -one, -one],
            [one, out, one, into],
            [-bulk.viscosity * (4.0 + x**2), -2.0 * bulk.viscosity * (1.0 + out), -drop.viscosity * y**2,
             -2.0 * drop.viscosity * (into - 1.0)],
            [-4.0 * bulk.viscosity * one, -bulk.viscosity * (2.0 + x**2 + 2.0 * out), none,
             drop.viscosity * (2.0 + y**2 - 2.0 * into)]]
    matrix = np.moveaxis(np.array(rows), -1, 0)
    parts = np.linalg.solve(matrix, np.stack([none, none, pull, pull], axis=-1)[..., None])[..., 0]
    return parts[:, 0] + parts[:, 1]
