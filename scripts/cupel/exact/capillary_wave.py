"""Small standing capillary wave on one deep viscous liquid with a free surface.

Normal mode (Lamb 1932, section 349):  (s + 2 nu k^2)^2 + omega_0^2 = 4 nu^2 k^3 sqrt(k^2 + s/nu),
omega_0^2 = sigma k^3/rho, root s = -decay + i omega with Re sqrt(...) > 0.

Initial-value solution from rest (Prosperetti 1976, J. Fluid Mech. 78, one fluid: Phys. Fluids 24 (1981) 1217), a(0) = a_0, u_0 = 0:

    a(t)/a_0 = 4 (1 - 4 b) nu^2 k^4 / (8 (1 - 4 b) nu^2 k^4 + omega_0^2) erfc(sqrt(nu k^2 t))
               + sum_i z_i/Z_i omega_0^2/(z_i^2 - nu k^2) exp((z_i^2 - nu k^2) t) erfc(z_i sqrt(t)),   b = 0,

z_i the four roots of z^4 - 4 b sqrt(nu k^2) z^3 + 2 (1 - 6 b) nu k^2 z^2 + 4 (1 - 3 b) (nu k^2)^(3/2) z
+ (1 - 4 b) nu^2 k^4 + omega_0^2 = 0, and Z_i the product of z_j - z_i over j != i.
"""

from __future__ import annotations

import numpy as np
from scipy.special import wofz


def inviscid_frequency(surface_tension: float, density: float, wavelength: float) -> float:
    """omega_0, rad/s; N/m, kg/m^3, m."""
    return float(np.sqrt(surface_tension / density * (2.0 * np.pi / wavelength)**3))


def normal_mode(surface_tension: float, density: float, wavelength: float, viscosity: float) -> tuple[float, float]:
    """Angular frequency (rad/s) and decay rate (1/s) of the amplitude; viscosity Pa s.

    Errors: ValueError if the wave does not oscillate.
    """
    omega_0, nu_k2 = _rates(surface_tension, density, wavelength, viscosity)
    # z = -sqrt(nu k^2 + s) turns the relation into the quartic of Prosperetti, so the
    # branch Re sqrt(k^2 + s/nu) > 0 that decays with depth is Re z < 0
    rates = [z**2 - nu_k2 for z in _quartic_roots(omega_0, nu_k2) if z.real < 0.0]
    oscillating = [s for s in rates if s.imag > 1e-9 * omega_0]
    if not oscillating:
        raise ValueError("this wave does not oscillate: its viscosity is too great")
    s = max(oscillating, key=lambda rate: rate.imag)
    return float(s.imag), float(-s.real)


def amplitude(time: np.ndarray, surface_tension: float, density: float, wavelength: float,
              viscosity: float) -> np.ndarray:
    """a(t)/a_0 of a wave released from rest at t = 0; time (n) s >= 0."""
    omega_0, nu_k2 = _rates(surface_tension, density, wavelength, viscosity)
    time = np.asarray(time, float)
    roots = _quartic_roots(omega_0, nu_k2)
    x = np.sqrt(nu_k2 * time)
    diffusive = wofz(1j * x).real * np.exp(-nu_k2 * time)   # erfc(x) = exp(-x^2) w(i x)
    total = (4.0 * nu_k2**2 / (8.0 * nu_k2**2 + omega_0**2) * diffusive).astype(complex)
    for index, z in enumerate(roots):
        others = np.prod(np.delete(roots, index) - z)
        # exp(z^2 t) erfc(z sqrt(t)) = w(i z sqrt(t))
        total += (z / others * omega_0**2 / (z**2 - nu_k2)
                  * wofz(1j * z * np.sqrt(time)) * np.exp(-nu_k2 * time))
    return total.real


def _rates(surface_tension, density, wavelength, viscosity) -> tuple[float, float]:
    k = 2.0 * np.pi / wavelength
    return inviscid_frequency(surface_tension, density, wavelength), viscosity / density * k**2


def _quartic_roots(omega_0: float, nu_k2: float) -> np.ndarray:
    return np.roots([1.0, 0.0, 2.0 * nu_k2, 4.0 * nu_k2**1.5, nu_k2**2 + omega_0**2])
