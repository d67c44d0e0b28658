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

/// Surface tension as a continuum surface force (Brackbill, Kothe, Zemach 1992; the paper, section 2.5.1):
///
///   f = −σ κ n̂ δ,   κ = ∇·n̂, n̂ out of the liquid      [N/m³]
inline Vector surface_tension_force(double tension, double curvature, const Vector& normal, double delta)
{
    return (-tension * curvature * delta) * normal;
}

/// Marangoni stress (Morris 2000, eq. 12; the paper, section 2.6):
///
///   f = (dσ/dT) [∇T − (∇T·n̂) n̂] δ      [N/m³]
inline Vector marangoni_force(double slope, const Vector& temperature_gradient, const Vector& normal, double delta)
{
    const Vector tangential = temperature_gradient - dot(temperature_gradient, normal) * normal;
    return (slope * delta) * tangential;
}

/// Recoil of the evaporating metal (Anisimov 1968; the paper, section 2.7):  f = −p_r n̂ δ      [N/m³]
inline Vector recoil_force(double recoil_pressure, const Vector& normal, double delta)
{
    return (-recoil_pressure * delta) * normal;
}

} // namespace cupel
