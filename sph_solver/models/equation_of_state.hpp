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
        const double c2 = sound_speed * sound_speed;
        if (exponent == 1.0) return c2 * (density - rest_density);
        return c2 * rest_density / exponent * (std::pow(density / rest_density, exponent) - 1.0);
    }
    /// Elastic energy e = ∫ p/ρ² dρ from the rest density, J/kg; with x = ρ/ρ₀:
    ///
    ///   γ = 1:  c₀² (ln x + 1/x − 1)       else:  c₀²/γ [(x^(γ−1) − 1)/(γ − 1) + 1/x − 1]
    ///
    /// Near x = 1 both are small differences of great numbers, and their series in y = x − 1 are taken:
    ///
    ///   γ = 1:  c₀² Σ_k (−y)^k (k − 1)/k, k ≥ 2       else:  c₀² [y²/2 + (γ − 5) y³/6 + …]
    double elastic_energy(double density, double rest_density) const
    {
        return elastic_energy((density - rest_density) / rest_density);
    }
    /// The series for γ = 1, of one particle or of several at a time: to 10⁻¹³ of itself up to this y.
    static constexpr double series_up_to = 0.02;
    template <class Scalar> Scalar elastic_energy_near_rest(const Scalar& y) const
    {
        Scalar sum(0.0);
        for (int k = 8; k >= 2; --k)
            sum = Scalar((k - 1.0) / k) - y * sum;
        return Scalar(sound_speed * sound_speed) * y * y * sum;
    }
    /// Of y.
    double elastic_energy(double compression) const
    {
        const double y = compression, x = 1.0 + y, c2 = sound_speed * sound_speed;
        if (exponent == 1.0) {
            if (std::abs(y) > series_up_to) return c2 * (std::log(x) + 1.0 / x - 1.0);
            return elastic_energy_near_rest(y);
        }
        if (std::abs(y) < 1e-4) return c2 * y * y * (0.5 + (exponent - 5.0) / 6.0 * y);
        return c2 / exponent * ((std::pow(x, exponent - 1.0) - 1.0) / (exponent - 1.0) + 1.0 / x - 1.0);
    }
    double density(double pressure, double rest_density) const
    {
        const double relative = pressure * exponent / (sound_speed * sound_speed * rest_density) + 1.0;
        return rest_density * (exponent == 1.0 ? relative : std::pow(relative, 1.0 / exponent));
    }
};

} // namespace cupel
