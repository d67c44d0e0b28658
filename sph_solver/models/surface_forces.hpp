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

/// What presses on the free surface of melt among its solid (other surfaces carry it into the liquid,
/// surface_pressure.hpp; a film of a few particles is too little for that), as a continuum surface force: surface
/// tension (Brackbill, Kothe, Zemach 1992; the paper, section 2.5.1) and the recoil of evaporating metal (Anisimov
/// 1968; the paper, section 2.7). The band that bears it lies at a depth s below the surface:
///
///   f = −δ (L n̂ + s ∇L),   L = σκ + p_r,   κ = ∇·n̂, n̂ out of the liquid      [N/m³]
///
/// Without the second part the force is that of a surface at the band's depth: with a free surface the band's middle
/// lies 0.6 spacings inside, and a wave of number k is driven by 1 − 0.6 k Δx of its force (ω 15 % low at 16 spacings a
/// wave). Derivation: the true load is a pressure L on the surface. With Θ the share of δ that lies above a depth, the
/// pressure p' = p − L (1 − Θ) is zero on the surface, as SPH has it there, and obeys −∇p = −∇p' + L∇Θ − (1 − Θ)∇L:
/// CSF's force and a tangential one, whose integral over the band is −∇L times the mean depth of δ. Where σκ and p_r
/// balance, L is the same everywhere and nothing drives the liquid along its surface. Where a case asks for Brackbill's
/// own force (`surface_load = "continuum_force"`), L is that of each particle and ∇L is left out.
inline Vector surface_load_force(double load, const Vector& load_gradient, double depth, const Vector& normal,
                                 double delta)
{
    return (-delta) * (load * normal + depth * load_gradient);
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
