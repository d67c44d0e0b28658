"""Migration of a drop in an unbounded liquid with a temperature gradient, no inertia or convection of heat
(Young, Goldstein and Block 1959), toward the hot side where d(sigma)/dT < 0:

    U = 2 |d(sigma)/dT| grad(T) R / [(2 + k_d/k_b) (2 mu_b + 3 mu_d)]
"""


def migration_velocity(surface_tension_slope: float, temperature_gradient: float, radius: float,
                       conductivity_drop: float, conductivity_bulk: float,
                       viscosity_drop: float, viscosity_bulk: float) -> float:
    """Velocity along the gradient, m/s; N/(m K), K/m, m, W/(m K), Pa s."""
    return (-2.0 * surface_tension_slope * temperature_gradient * radius
            / ((2.0 + conductivity_drop / conductivity_bulk) * (2.0 * viscosity_bulk + 3.0 * viscosity_drop)))
