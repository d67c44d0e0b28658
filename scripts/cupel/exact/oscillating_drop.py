"""Small oscillations of a free drop in vacuum, mode n (Rayleigh 1879; Lamb 1932, sections 273 to 275 and 355).

Without viscosity   2-D  omega^2 = n (n^2 - 1) sigma/(rho R^3)      3-D  omega^2 = n (n - 1)(n + 2) sigma/(rho R^3)
Small viscosity     2-D  decay 2 n (n - 1) nu/R^2                   3-D  decay (n - 1)(2 n + 1) nu/R^2

2-D at any viscosity: disturbances ~ exp(s t) with potential A r^n and vortical stream function B I_n(q r), q^2 = s/nu,

    u_r = (n A r^(n-1) + n B I_n(q r)/r) cos(n phi)       u_phi = -(n A r^(n-1) + B q I_n'(q r)) sin(n phi)

No shear stress at r = R and  -p + 2 mu du_r/dr = -sigma (n^2 - 1) eta/R^2  with  p = -rho s A r^n,  s eta = u_r
leave a 2 x 2 determinant whose root s = -decay + i omega is the normal mode.
"""

from __future__ import annotations

import numpy as np
from scipy.special import ive, ivp


def frequency(surface_tension: float, density: float, radius: float, mode: int = 2, dimensions: int = 3) -> float:
    """Angular frequency without viscosity, rad/s; N/m, kg/m^3, m."""
    shape = mode * (mode**2 - 1) if dimensions == 2 else mode * (mode - 1) * (mode + 2)
    return float(np.sqrt(shape * surface_tension / (density * radius**3)))


def decay_rate(kinematic_viscosity: float, radius: float, mode: int = 2, dimensions: int = 3) -> float:
    """Decay rate of the amplitude for small viscosity, 1/s; m^2/s, m."""
    shape = 2 * mode * (mode - 1) if dimensions == 2 else (mode - 1) * (2 * mode + 1)
    return shape * kinematic_viscosity / radius**2


def viscous_mode_2d(surface_tension: float, density: float, radius: float, viscosity: float,
                    mode: int = 2) -> tuple[float, float]:
    """Angular frequency (rad/s) and decay rate (1/s) of the 2-D normal mode at any viscosity (Pa s) that lets it oscillate.

    Errors: ValueError if the root is not found or does not oscillate.
    """
    n, nu = mode, viscosity / density
    omega_0 = frequency(surface_tension, density, radius, n, 2)

    def determinant(s: complex) -> complex:
        """With r = R = 1, time in 1/omega_0, and B scaled by I_n(q)."""
        rate, viscous = s * omega_0, nu / radius**2
        q = np.sqrt(rate / viscous + 0j)
        if abs(q.real) > 300.0:   # I_n' / I_n for large arguments
            slope = q * (1.0 - 1.0 / (2.0 * q))
        else:
            slope = q * ivp(n, q) / (ive(n, q) * np.exp(abs(q.real)))   # q I_n'(q)/I_n(q)
        curvature = n**2 + q**2 - slope                                    # q^2 I_n''(q)/I_n(q)
        shear = (-2.0 * n * (n - 1), slope - curvature - n**2)             # A, B
        capillary = omega_0**2 / n                                         # sigma (n^2 - 1)/(rho R^3)
        normal = (rate + 2.0 * viscous * n * (n - 1) + capillary * n / rate,
                  2.0 * viscous * n * (slope - 1.0) + capillary * n / rate)
        return shear[0] * normal[1] - shear[1] * normal[0]

    s = _complex_root(determinant, -decay_rate(nu, radius, n, 2) / omega_0 + 1j)
    if not (s.imag > 1e-6 and s.real < 0.0):
        raise ValueError("this drop does not oscillate: its viscosity is too great")
    return float(s.imag * omega_0), float(-s.real * omega_0)


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
