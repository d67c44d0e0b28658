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

/// Surface tension as a continuum surface force (Brackbill, Kothe, Zemach 1992; the paper, section 2.5.1), where the
/// band that bears it lies at a depth s below the surface:
///
///   f = −σ δ (κ n̂ + s ∇κ),   κ = ∇·n̂, n̂ out of the liquid      [N/m³]
///
/// Without the second part the force is that of a surface at the band's depth: with a free surface the band's middle
/// lies 0.6 spacings inside, and a wave of number k is driven by 1 − 0.6 k Δx of its force (ω 15 % low at 16 spacings a
/// wave). Derivation: the true load is a pressure σκ on the surface. With Θ the share of δ that lies above a depth, the
/// pressure p' = p − σκ(1 − Θ) is zero on the surface, as SPH has it there, and obeys −∇p = −∇p' + σκ∇Θ − σ(1 − Θ)∇κ:
/// CSF's force and a tangential one, whose integral over the band is −σ∇κ times the mean depth of δ.
inline Vector surface_tension_force(double tension, double curvature, const Vector& curvature_gradient, double depth,
                                    const Vector& normal, double delta)
{
    return (-tension * delta) * (curvature * normal + depth * curvature_gradient);
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
