#pragma once

#include <numbers>

#include "models/vapour_pressure.hpp"

namespace cupel
{

/// Heat that the vapour carries off (Hertz and Knudsen with Anisimov's share of 0.82 that does not return):
///
///   q = 0.82 L_v p_s(T) √(M/(2πRT))      [W/m²]
struct Evaporation
{
    VapourPressure vapour_pressure;

    double heat_flux(double temperature) const
    {
        const double t = std::max(temperature, 1.0);
        return 0.82 * vapour_pressure.vaporization_heat * vapour_pressure(t) *
               std::sqrt(vapour_pressure.molar_mass / (2.0 * std::numbers::pi * gas_constant * t));
    }
};

} // namespace cupel
