"""Exact return flow of a shallow layer under a uniform surface stress with no net flux.

Lubrication theory: mu u'' = dp/dx = const, u(0) = 0, mu u'(H) = tau, and the integral of u over the depth is zero.
Then dp/dx = 3 tau / (2 H) and u(eta) = (tau H / 4 mu) (3 eta^2 - 2 eta) with eta = z/H.
"""


def velocity(eta: float, stress: float, depth: float, viscosity: float) -> float:
    """Velocity [m/s] along the stress [Pa] at the height eta (0 to 1) of a layer of `depth` [m] and `viscosity` [Pa s]."""
    return stress * depth / (4 * viscosity) * (3 * eta**2 - 2 * eta)


if __name__ == "__main__":
    for tenth in range(11):
        print(f"eta {tenth / 10:.1f}: u = {velocity(tenth / 10, 4e-4 * 1000, 1e-3, 0.01) * 1e3:+.3f} mm/s")
