"""Small standing capillary wave on a viscous liquid of depth h over a flat bottom, from rest, as an initial-value problem.

Laplace transform in time of the linear equations, w(z) the velocity along z of exp(i k x), D = d/dz, q^2 = k^2 + s/nu:

    (D^2 - k^2)(D^2 - q^2) w = 0                                   in -h < z < 0
    w = 0,  D w = 0 (no slip) or D^2 w = 0 (slip)                  at z = -h
    D^2 w + k^2 w = 0  (no shear stress),   w = s a - a_0          at z = 0
    p - 2 mu D w = sigma k^2 a,   p = -(rho/k^2) [s D w - nu (D^3 w - k^2 D w)]

With Z = (p - 2 mu D w)/w at the surface this is  a = Z a_0/(s Z - sigma k^2). For kh -> infinity it is Prosperetti's
solution (capillary_wave.py); back in time by laplace_inversion.py.
"""

from __future__ import annotations

import numpy as np

from . import capillary_wave
from .laplace_inversion import inverted

DEEP = 6.0          # k h above which the bottom changes nothing (exp(-2 k h) < 1e-5)


def amplitude(time: np.ndarray, surface_tension: float, density: float, wavelength: float, viscosity: float, depth: float,
              slip: bool = False) -> np.ndarray:
    """a(t)/a_0 of a wave released from rest at t = 0; time (n) s >= 0, depth m; the deep solution for k h > 6."""
    time = np.asarray(time, float)
    if 2.0 * np.pi * depth / wavelength > DEEP:
        return capillary_wave.amplitude(time, surface_tension, density, wavelength, viscosity)
    result = np.ones(time.shape)
    omega_0 = capillary_wave.inviscid_frequency(surface_tension, density, wavelength)

    def transform(s):
        return _transform(s, surface_tension, density, wavelength, viscosity, depth, slip)

    for index in np.ndindex(time.shape):
        if time[index] > 0.0:
            result[index] = inverted(transform, float(time[index]), omega_0)
    return result


def _transform(s: np.ndarray, surface_tension, density, wavelength, viscosity, depth, slip) -> np.ndarray:
    """a/a_0 at complex s (n), 1/s. Scaled so that h, not k, sets no large numbers: every function is at most one in the layer."""
    k, nu = 2.0 * np.pi / wavelength, viscosity / density
    q = np.sqrt(k**2 + s / nu)
    # exp(k z), exp(-k (z + h)), exp(q z), exp(-q (z + h)): exponent, value at the surface, value at the bottom
    exponents = np.stack([np.full(s.shape, k + 0j), np.full(s.shape, -k + 0j), q, -q], axis=-1)
    fading = np.exp(-np.abs(k) * depth) * np.ones(s.shape), np.exp(-q * depth)
    one = np.ones(s.shape, complex)
    top = np.stack([one, fading[0], one, fading[1]], axis=-1)
    bottom = np.stack([fading[0], one, fading[1], one], axis=-1)
    slope = exponents**2 if slip else exponents
    rows = np.stack([bottom, slope * bottom, (exponents**2 + k**2) * top, top], axis=-2)
    scale = np.abs(rows).max(axis=-1, keepdims=True)
    right = np.zeros((*s.shape, 4, 1), complex)
    right[..., 3, 0] = 1.0
    part = np.linalg.solve(rows / scale, right / scale)[..., 0]
    first, third = ((exponents**power * top * part).sum(axis=-1) for power in (1, 3))
    pressure = -density / k**2 * (s * first - nu * (third - k**2 * first))
    impedance = pressure - 2.0 * viscosity * first
    return impedance / (s * impedance - surface_tension * k**2)
