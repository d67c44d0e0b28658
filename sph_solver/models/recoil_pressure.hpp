#pragma once

#include "models/vapour_pressure.hpp"

namespace cupel
{

/// Recoil of the evaporating surface (Anisimov 1968; the paper, section 2.7, which prints the sign of the exponent the
/// other way round and would have recoil fall with temperature):
///
///   p_r = 0.54 p₀ exp[(L_v M/R)(1/T_b − 1/T)]      [Pa]
inline double recoil_pressure(const VapourPressure& vapour_pressure, double temperature)
{
    return 0.54 * vapour_pressure(temperature);
}

} // namespace cupel
