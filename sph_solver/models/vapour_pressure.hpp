#pragma once

#include <algorithm>
#include <cmath>

namespace cupel
{

inline constexpr double gas_constant = 8.314462618;        ///< R, J/(mol·K)
inline constexpr double stefan_boltzmann = 5.670374419e-8; ///< σ_SB, W/(m²·K⁴)

/// Saturation pressure of the metal's vapour (Clausius and Clapeyron):
///
///   p_s(T) = p₀ exp[(L_v M/R)(1/T_b − 1/T)]      [Pa]
struct VapourPressure
{
    double ambient_pressure = 0;    ///< p₀, Pa: the boiling temperature belongs to it
    double boiling_temperature = 1; ///< T_b, K
    double vaporization_heat = 0;   ///< L_v, J/kg
    double molar_mass = 0;          ///< M, kg/mol

    double operator()(double temperature) const
    {
        const double scale = vaporization_heat * molar_mass / gas_constant;
        return ambient_pressure * std::exp(scale * (1.0 / boiling_temperature - 1.0 / std::max(temperature, 1.0)));
    }
};

} // namespace cupel
