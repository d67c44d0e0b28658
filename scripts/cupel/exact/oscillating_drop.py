"""Small oscillations of a drop, mode n, in vacuum or in another fluid (Rayleigh 1879; Lamb 1932, sections 273 to 275 and 355).

Without viscosity   2-D  omega^2 = n (n^2 - 1) sigma/[(rho_i + rho_e) R^3]
                    3-D  omega^2 = n (n - 1)(n + 1)(n + 2) sigma/[((n + 1) rho_i + n rho_e) R^3]
Small viscosity     2-D  decay 2 n (n - 1) nu/R^2                   3-D  decay (n - 1)(2 n + 1) nu/R^2        (in vacuum)

At any viscosity (Chandrasekhar 1961, section 98; Miller and Scriven 1968; Prosperetti 1980): disturbances ~ exp(s t), in each fluid a
potential part ~ r^m and a vortical one F(q r), q^2 = s/nu; m = n, F = I_n (3-D i_n) inside, m = -n (3-D -n - 1), F = K_n (k_n) outside:

    2-D  u_r = [m A r^(m-1) + n B F/r] cos(n phi)            u_phi = -[n A r^(m-1) + B q F'] sin(n phi)
    3-D  u_r = [m A r^(m-1) + n (n+1) B F/r] P_n             u_theta = [A r^(m-1) + B (r F)'/r] dP_n/dtheta

At r = R both velocities and the shear stress are continuous (in vacuum: no shear stress), and -p + 2 mu du_r/dr jumps by
-T eta with  p = -rho s A r^m,  s eta = u_r,  T = sigma (n^2 - 1)/R^2 (3-D: sigma (n - 1)(n + 2)/R^2). The determinant's root
s = -decay + i omega is the normal mode.
"""

from __future__ import annotations

import numpy as np
from scipy.special import ive, kve

from .laplace_inversion import inverted


def frequency(surface_tension: float, density: float, radius: float, mode: int = 2, dimensions: int = 3,
              density_outside: float = 0.0) -> float:
    """Angular frequency without viscosity, rad/s; N/m, kg/m^3, m."""
    n = mode
    if dimensions == 2:
        return float(np.sqrt(n * (n**2 - 1) * surface_tension / ((density + density_outside) * radius**3)))
    inertia = density + n / (n + 1.0) * density_outside
    return float(np.sqrt(n * (n - 1) * (n + 2) * surface_tension / (inertia * radius**3)))


def decay_rate(kinematic_viscosity: float, radius: float, mode: int = 2, dimensions: int = 3) -> float:
    """Decay rate of the amplitude for small viscosity, 1/s; m^2/s, m."""
    shape = 2 * mode * (mode - 1) if dimensions == 2 else (mode - 1) * (2 * mode + 1)
    return shape * kinematic_viscosity / radius**2


def viscous_mode(surface_tension: float, density: float, radius: float, viscosity: float, mode: int = 2,
                 dimensions: int = 3, density_outside: float = 0.0, viscosity_outside: float = 0.0) -> tuple[float, float]:
    """Angular frequency (rad/s) and decay rate (1/s) of the normal mode at any viscosity (Pa s) that lets it oscillate.

    In vacuum where density and viscosity outside are 0. Errors: ValueError if the root is not found or does not oscillate.
    """
    omega_0 = frequency(surface_tension, density, radius, mode, dimensions, density_outside)
    spring = _spring(surface_tension, density, radius, mode, dimensions) / omega_0**2
    inside = (1.0, viscosity / (density * radius**2 * omega_0))              # units: R, 1/omega_0, rho R^3
    outside = (density_outside / density, viscosity_outside / (density * radius**2 * omega_0))

    def determinant(s: complex) -> complex:
        """Vanishes at the normal mode; s in units of omega_0."""
        own = _fluid(s, *inside, mode, dimensions)
        normal = own[3] + spring / s * own[0]
        if density_outside <= 0.0:
            return np.linalg.det(np.array([own[2], normal]))
        other = _fluid(s, *outside, mode, dimensions, around=True)
        return np.linalg.det(np.block([[own[:3], -other[:3]], [normal[None], -other[3:]]]))

    s = _complex_root(determinant, -decay_rate(viscosity / density, radius, mode, dimensions) / omega_0 + 1j)
    if not (s.imag > 1e-6 and s.real < 0.0):
        raise ValueError("this drop does not oscillate: its viscosity is too great")
    return float(s.imag * omega_0), float(-s.real * omega_0)


def amplitude(time: np.ndarray, surface_tension: float, density: float, radius: float, viscosity: float, mode: int = 2,
              dimensions: int = 3) -> np.ndarray:
    """a(t)/a_0 of a drop released from rest with a small disturbance (initial-value problem, Prosperetti 1980); time (n) s >= 0.

    At first it differs from the normal mode, whose vorticity has had for ever to spread.
    """
    omega_0 = frequency(surface_tension, density, radius, mode, dimensions)
    spring = _spring(surface_tension, density, radius, mode, dimensions)

    def transform(s: np.ndarray) -> np.ndarray:
        rise, _, shear, normal = _fluid(s, 1.0, viscosity / (density * radius**2), mode, dimensions)
        share = -shear[0] / shear[1]
        return 1.0 / (s + spring * (rise[0] + rise[1] * share) / (normal[0] + normal[1] * share))

    return np.array([inverted(transform, float(t), omega_0) if t > 0.0 else 1.0 for t in np.atleast_1d(time)])


def _spring(surface_tension: float, density: float, radius: float, n: int, dimensions: int) -> float:
    """T R/(rho R^2), 1/s^2: normal stress for each displacement of the surface."""
    shape = n**2 - 1 if dimensions == 2 else (n - 1) * (n + 2)
    return shape * surface_tension / (density * radius**3)


def _fluid(rate: complex | np.ndarray, density: float, viscosity: float, n: int, dimensions: int, around: bool = False) -> np.ndarray:
    """What the potential and the vortical part of a fluid have at r = R = 1: rows u_r, tangential velocity, shear stress,
    -p + 2 mu du_r/dr; two columns (each an array where `rate` is one). The vortical part is scaled by F(q)."""
    q = np.sqrt(rate * density / viscosity + 0j)
    order, half = (n, 0.0) if dimensions == 2 else (n + 0.5, 0.5)          # i_n(q) = sqrt(pi/(2 q)) I_(n + 1/2)(q), k_n likewise
    if around:
        m, slope = -n if dimensions == 2 else -n - 1, -order - q * kve(order - 1, q) / kve(order, q) - half
    else:
        m, slope = n, order + q * ive(order + 1, q) / ive(order, q) - half       # slope: q F'(q)/F(q)
    one, turn = np.ones_like(q), n if dimensions == 2 else n * (n + 1)
    if dimensions == 2:
        tangential, shear = (n * one, slope), (2.0 * n * (m - 1) * one, 2.0 * n**2 + q**2 - 2.0 * slope)
    else:
        tangential, shear = (one, 1.0 + slope), (2.0 * (m - 1) * one, q**2 + 2.0 * n * (n + 1) - 2.0 - 2.0 * slope)
    normal = (density * rate + 2.0 * viscosity * m * (m - 1), 2.0 * viscosity * turn * (slope - 1.0))
    return np.array([(m * one, turn * one), tangential, tuple(viscosity * part for part in shear), normal])


def _complex_root(function, start: complex) -> complex:
    """Secant iteration. Errors: ValueError if it does not converge."""
    before, now = start * 1.01, start
    f_before, f_now = function(before), function(now)
    for _ in range(100):
        if f_now == f_before:
            break
        before, now, f_before = now, now - f_now * (now - before) / (f_now - f_before), f_now
        f_now = function(now)
        if abs(now - before) < 1e-13 * abs(now):
            return now
    raise ValueError("no normal mode found near the one without viscosity")
