"""Small oscillations of a free drop in vacuum, mode n (Rayleigh 1879; Lamb 1932, sections 273 to 275 and 355).

Without viscosity   2-D  omega^2 = n (n^2 - 1) sigma/(rho R^3)      3-D  omega^2 = n (n - 1)(n + 2) sigma/(rho R^3)
Small viscosity     2-D  decay 2 n (n - 1) nu/R^2                   3-D  decay (n - 1)(2 n + 1) nu/R^2

At any viscosity (Chandrasekhar 1961, section 98; Miller and Scriven 1968): disturbances ~ exp(s t), a potential part of amplitude
A and a vortical one of amplitude B, q^2 = s/nu:

    2-D  u_r = [n A r^(n-1) + n B I_n(q r)/r] cos(n phi)        u_phi = -[n A r^(n-1) + B q I_n'(q r)] sin(n phi)
    3-D  u_r = [n A r^(n-1) + n (n+1) B i_n(q r)/r] P_n         u_theta = [A r^(n-1) + B (r i_n)'/r] dP_n/dtheta

No shear stress at r = R, and  -p + 2 mu du_r/dr = -omega^2 rho R eta/n  (omega without viscosity)  with  p = -rho s A r^n,  s eta = u_r
leave a 2 x 2 determinant whose root s = -decay + i omega is the normal mode.
"""

from __future__ import annotations

import numpy as np
from scipy.special import ive

from .laplace_inversion import inverted


def frequency(surface_tension: float, density: float, radius: float, mode: int = 2, dimensions: int = 3) -> float:
    """Angular frequency without viscosity, rad/s; N/m, kg/m^3, m."""
    shape = mode * (mode**2 - 1) if dimensions == 2 else mode * (mode - 1) * (mode + 2)
    return float(np.sqrt(shape * surface_tension / (density * radius**3)))


def decay_rate(kinematic_viscosity: float, radius: float, mode: int = 2, dimensions: int = 3) -> float:
    """Decay rate of the amplitude for small viscosity, 1/s; m^2/s, m."""
    shape = 2 * mode * (mode - 1) if dimensions == 2 else (mode - 1) * (2 * mode + 1)
    return shape * kinematic_viscosity / radius**2


def viscous_mode(surface_tension: float, density: float, radius: float, viscosity: float, mode: int = 2,
                 dimensions: int = 3) -> tuple[float, float]:
    """Angular frequency (rad/s) and decay rate (1/s) of the normal mode at any viscosity (Pa s) that lets it oscillate.

    Errors: ValueError if the root is not found or does not oscillate.
    """
    omega_0 = frequency(surface_tension, density, radius, mode, dimensions)
    viscous = viscosity / density / radius**2

    def determinant(s: complex) -> complex:
        """Vanishes at the normal mode; s in units of omega_0."""
        (shear_a, shear_b), (normal_a, normal_b), (rise_a, rise_b) = _parts(s * omega_0, viscous, mode, dimensions)
        spring = omega_0 / (mode * s)
        return shear_a * (normal_b + spring * rise_b) - shear_b * (normal_a + spring * rise_a)

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
    viscous = viscosity / density / radius**2

    def transform(s: np.ndarray) -> np.ndarray:
        (shear_a, shear_b), (normal_a, normal_b), (rise_a, rise_b) = _parts(s, viscous, mode, dimensions)
        share = -shear_a / shear_b
        return 1.0 / (s + omega_0**2 / mode * (rise_a + rise_b * share) / (normal_a + normal_b * share))

    return np.array([inverted(transform, float(t), omega_0) if t > 0.0 else 1.0 for t in np.atleast_1d(time)])


def _parts(rate: complex | np.ndarray, viscous: float, n: int, dimensions: int) -> tuple:
    """What A and B add to the shear stress, to the normal stress of the flow, and to u_r, at r = R = 1; each a pair.

    rate: s, 1/s; viscous: nu/R^2, 1/s. B is scaled by the Bessel function at R.
    """
    q = np.sqrt(rate / viscous + 0j)
    order, dilution = (n, 1.0) if dimensions == 2 else (n + 0.5, n + 1.0)
    slope = order + q * ive(order + 1, q) / ive(order, q)              # q I'(q)/I(q)
    if dimensions == 2:
        shear = (-2.0 * n * (n - 1), 2.0 * slope - 2.0 * n**2 - q**2)
    else:
        slope = slope - 0.5                                            # i_n(q) = sqrt(pi/(2 q)) I_(n + 1/2)(q)
        shear = (2.0 * (n - 1), q**2 + 2.0 * n * (n + 1) - 2.0 - 2.0 * slope)
    normal = (rate + 2.0 * viscous * n * (n - 1), 2.0 * viscous * n * dilution * (slope - 1.0))
    return shear, normal, (n, n * dilution)


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
