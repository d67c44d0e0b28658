#pragma once

#include "models/vapour_pressure.hpp"

namespace cupel
{

/// Grey radiation to, and convection into, a surrounding of temperature T₀:
///
///   q_r = ε σ_SB (T⁴ − T₀⁴),   q_c = h_c (T − T₀)      [W/m²], positive out of the metal
struct Radiation
{
    double emissivity = 0;                ///< ε
    double convection_coefficient = 0;    ///< h_c, W/(m²·K)
    double surrounding_temperature = 300; ///< T₀, K

    double radiative_flux(double temperature) const
    {
        const double square = temperature * temperature;
        const double square_0 = surrounding_temperature * surrounding_temperature;
        return emissivity * stefan_boltzmann * (square * square - square_0 * square_0);
    }
    double convective_flux(double temperature) const
    {
        return convection_coefficient * (temperature - surrounding_temperature);
    }
};

} // namespace cupel
