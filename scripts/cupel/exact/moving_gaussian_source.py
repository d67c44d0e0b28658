"""Gaussian surface source moving over a half space, no latent heat, no flow (Eagar and Tsai 1983):

    T - T_0 = (A P / rho c) int_0^inf (pi alpha t)^(-1/2) exp(-z^2/4 alpha t)
              exp(-[(x + v t)^2 + y^2] / [2 (s^2 + 2 alpha t)]) / [2 pi (s^2 + 2 alpha t)] dt,     s = r_0/2

x along the motion from the source's present place, y across, z depth below the surface; r_0 the 1/e^2 radius.
With t = w^2 the integrand is smooth: dt/sqrt(t) = 2 dw.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq, minimize_scalar

_gauss_legendre = lru_cache(np.polynomial.legendre.leggauss)


@dataclass(frozen=True)
class MovingGaussianSource:
    """absorbed_power W (A times P), speed m/s, spot_radius m (1/e^2), density kg/m^3, specific_heat J/(kg K),
    conductivity W/(m K), initial_temperature K."""

    absorbed_power: float
    speed: float
    spot_radius: float
    density: float
    specific_heat: float
    conductivity: float
    initial_temperature: float = 300.0
    nodes: int = 400

    def temperature(self, x, y, z) -> np.ndarray:
        """Temperature (K) of the quasi-steady state at points (m), arrays that broadcast against each other."""
        alpha = self.conductivity / (self.density * self.specific_heat)
        s = self.spot_radius / 2.0
        x, y, z = (np.asarray(value, float)[..., None] for value in (x, y, z))
        scale = s / np.sqrt(alpha)
        nodes, weights = _gauss_legendre(self.nodes)
        share = 0.5 * (nodes + 1.0)   # w = scale share/(1 - share) maps 0..1 to 0..infinity
        w = scale * share / (1.0 - share)
        jacobian = 0.5 * weights * scale / (1.0 - share)**2
        t = w**2
        variance = s**2 + 2.0 * alpha * t
        with np.errstate(under="ignore"):
            integrand = np.exp(-z**2 / (4.0 * alpha * t) - ((x + self.speed * t)**2 + y**2) / (2.0 * variance)) / variance
        integral = (integrand * jacobian).sum(axis=-1) * 2.0 / np.sqrt(np.pi * alpha) / (2.0 * np.pi)
        return self.initial_temperature + self.absorbed_power / (self.density * self.specific_heat) * integral

    def pool(self, melting_temperature: float) -> tuple[float, float, float]:
        """Width, depth and length (m) of the region above a temperature (K); zeros if nothing is that hot."""
        hottest_x, hottest = self._greatest(lambda x: float(self.temperature(x, 0.0, 0.0)))
        if hottest <= melting_temperature:
            return 0.0, 0.0, 0.0

        def excess(x, y, z):
            return float(self.temperature(x, y, z)) - melting_temperature

        def reach(function):   # from the inside to where function falls below zero
            far = self.spot_radius
            while function(far) > 0.0:
                far *= 2.0
            return brentq(function, 0.0, far, xtol=1e-12)

        front_end = hottest_x + reach(lambda d: excess(hottest_x + d, 0.0, 0.0))
        tail_end = hottest_x - reach(lambda d: excess(hottest_x - d, 0.0, 0.0))

        def half_width(x):
            return reach(lambda y: excess(x, y, 0.0)) if excess(x, 0.0, 0.0) > 0.0 else 0.0

        def depth(x):
            return reach(lambda z: excess(x, 0.0, z)) if excess(x, 0.0, 0.0) > 0.0 else 0.0

        margin = 1e-9 * (front_end - tail_end)
        bounds = (tail_end + margin, front_end - margin)
        options = {"xatol": 1e-4 * self.spot_radius}
        widest = minimize_scalar(lambda x: -half_width(x), bounds=bounds, method="bounded", options=options)
        deepest = minimize_scalar(lambda x: -depth(x), bounds=bounds, method="bounded", options=options)
        return -2.0 * widest.fun, -deepest.fun, front_end - tail_end

    def _greatest(self, function) -> tuple[float, float]:
        """Place and value of the maximum along the track; it lies within two spots behind the source."""
        found = minimize_scalar(lambda x: -function(x), bounds=(-2.0 * self.spot_radius, self.spot_radius),
                                method="bounded", options={"xatol": 1e-6 * self.spot_radius})
        return float(found.x), -float(found.fun)
