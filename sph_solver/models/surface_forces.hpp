#pragma once

#include <algorithm>

#include "math/vector.hpp"

namespace cupel
{

/// σ(T) = max(σ₀ + (dσ/dT)(T − T_ref), σ_min)      [N/m]
struct SurfaceTensionLaw
{
    double at_reference = 0.0;          ///< σ₀, N/m
    double slope = 0.0;                 ///< dσ/dT, N/(m·K)
    double reference_temperature = 0.0; ///< T_ref, K
    double smallest = 0.0;              ///< σ_min, N/m

    double operator()(double temperature) const
    {
        return std::max(at_reference + slope * (temperature - reference_temperature), smallest);
    }
};

/// Continuum surface force (Brackbill, Kothe, Zemach 1992; the paper, section 2.5.1), with the recoil of evaporating
/// metal (Anisimov 1968; the paper, section 2.7), where a case asks for it (`surface_load = "continuum_force"`); else
/// the load is carried into the liquid (surface_pressure.hpp):
///
///   f = −δ L n̂,   L = σκ + p_r,   κ = ∇·n̂, n̂ out of the liquid      [N/m³]
inline Vector surface_load_force(double load, const Vector& normal, double delta)
{
    return (-delta * load) * normal;
}

/// Marangoni stress (Morris 2000, eq. 12; the paper, section 2.6):
///
///   f = (dσ/dT) [∇T − (∇T·n̂) n̂] δ      [N/m³]
inline Vector marangoni_force(double slope, const Vector& temperature_gradient, const Vector& normal, double delta)
{
    const Vector tangential = temperature_gradient - dot(temperature_gradient, normal) * normal;
    return (slope * delta) * tangential;
}

} // namespace cupel
