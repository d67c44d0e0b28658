#pragma once

#include <cmath>

namespace cupel
{

/// Equation of state of a weakly compressible liquid (Cole; the paper, table of equations, no. 4):
///
///   p = B [(ρ/ρ₀)^γ − 1],   B = c₀² ρ₀ / γ      [Pa]
///
/// γ = 1 is the linear law that the default formulation uses; γ = 7 is the paper's.
struct EquationOfState
{
    double sound_speed;    ///< c₀, m/s
    double exponent = 1.0; ///< γ

    double pressure(double density, double rest_density) const
    {
        const double stiffness = sound_speed * sound_speed * rest_density / exponent;
        const double ratio = density / rest_density;
        return exponent == 1.0 ? stiffness * (ratio - 1.0) : stiffness * (std::pow(ratio, exponent) - 1.0);
    }
    double density(double pressure, double rest_density) const
    {
        const double relative = pressure * exponent / (sound_speed * sound_speed * rest_density) + 1.0;
        return rest_density * (exponent == 1.0 ? relative : std::pow(relative, 1.0 / exponent));
    }
};

} // namespace cupel
