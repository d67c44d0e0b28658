/// What the primary material (metal, oil) and the surrounding fluid (gas, water) are made of. All SI.
///
///   h(T) = c_s T                                                   T ≤ T_s
///        = c_s T + ½ (c_l − c_s) f (T − T_s) + f L                 T_s < T < T_l,  f = (T − T_s)/(T_l − T_s)
///        = h(T_l) + c_l (T − T_l)                                  T ≥ T_l          [J/kg]
///
/// A material that does not melt has the one branch h = c T and f = 1.
#pragma once

#include "foam.hpp"

namespace cupel
{
struct PrimaryMaterial
{
    explicit PrimaryMaterial(const dictionary& entries);

    scalar density, viscosity;
    bool melts;
    scalar specific_heat_solid, specific_heat_liquid, conductivity_solid, conductivity_liquid;
    scalar solidus, liquidus, latent_heat;
    scalar mushy_drag; // constant of the drag on the mush, kg/(m³·s)
    scalar surface_tension_at_reference, surface_tension_slope, surface_tension_reference_temperature,
        surface_tension_minimum;
    scalar contact_angle;
    scalar boiling_temperature, vaporization_heat, molar_mass, emissivity;

    /// f_l(T), 0 … 1.
    scalar liquid_fraction(scalar temperature) const;
    /// h(T) [J/kg].
    scalar enthalpy(scalar temperature) const;
    /// dh/dT [J/(kg·K)], latent heat included.
    scalar enthalpy_slope(scalar temperature) const;
    /// k(T) [W/(m·K)], linear in the liquid fraction.
    scalar conductivity(scalar temperature) const;
    /// σ(T) = max(σ₀ + (dσ/dT)(T − T_m), σ_min) [N/m].
    scalar surface_tension(scalar temperature) const;
    /// dσ/dT [N/(m·K)]; zero where σ_min holds.
    scalar surface_tension_derivative(scalar temperature) const;
    /// p_sat(T) = p₀ exp[(L_v M/R)(1/T_b − 1/T)] [Pa] for the ambient pressure p₀.
    scalar saturation_pressure(scalar temperature, scalar ambient_pressure) const;

    /// T of a mixture that holds `primary_mass` [kg/m³] of this material and `other_capacity` [J/(m³·K)] of sensible
    /// heat, of volumetric enthalpy H = primary_mass h(T) + other_capacity T [J/m³]: the exact inverse, branch by
    /// branch.
    scalar mixture_temperature(scalar volumetric_enthalpy, scalar primary_mass, scalar other_capacity) const;
};

struct SurroundingMaterial
{
    explicit SurroundingMaterial(const dictionary& entries);

    scalar density, viscosity, specific_heat, conductivity;
};
} // namespace cupel
