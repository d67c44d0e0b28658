#include "material.hpp"

namespace cupel
{
namespace
{
const scalar gas_constant = 8.314462618; // J/(mol·K)
}

// Entries that a scene does not need are absent from its case; the writer names each one that its physics asks for.
PrimaryMaterial::PrimaryMaterial(const dictionary& entries)
    : density(entries.get<scalar>("density")), viscosity(entries.getOrDefault<scalar>("viscosity", 0)),
      melts(entries.get<bool>("melts")), specific_heat_solid(entries.getOrDefault<scalar>("specific_heat_solid", 1)),
      specific_heat_liquid(entries.getOrDefault<scalar>("specific_heat", 1)),
      conductivity_solid(entries.getOrDefault<scalar>("conductivity_solid", 0)),
      conductivity_liquid(entries.getOrDefault<scalar>("conductivity", 0)),
      solidus(entries.getOrDefault<scalar>("solidus", 0)), liquidus(entries.getOrDefault<scalar>("liquidus", 0)),
      latent_heat(entries.getOrDefault<scalar>("latent_heat", 0)),
      mushy_drag(entries.getOrDefault<scalar>("mushy_drag", 0)),
      surface_tension_at_reference(entries.getOrDefault<scalar>("surface_tension", 0)),
      surface_tension_slope(entries.getOrDefault<scalar>("surface_tension_slope", 0)),
      surface_tension_reference_temperature(entries.getOrDefault<scalar>("surface_tension_reference_temperature", 0)),
      surface_tension_minimum(entries.getOrDefault<scalar>("surface_tension_minimum", -GREAT)),
      contact_angle(entries.getOrDefault<scalar>("contact_angle", 0)),
      boiling_temperature(entries.getOrDefault<scalar>("boiling_temperature", 1)),
      vaporization_heat(entries.getOrDefault<scalar>("vaporization_heat", 0)),
      molar_mass(entries.getOrDefault<scalar>("molar_mass", 0)),
      emissivity(entries.getOrDefault<scalar>("emissivity", 0))
{}

scalar PrimaryMaterial::liquid_fraction(scalar temperature) const
{
    if (!melts) return 1;
    return min(max((temperature - solidus) / (liquidus - solidus), scalar(0)), scalar(1));
}

scalar PrimaryMaterial::enthalpy(scalar temperature) const
{
    if (!melts) return specific_heat_liquid * temperature;
    if (temperature <= solidus) return specific_heat_solid * temperature;
    const scalar mushy_temperature = min(temperature, liquidus);
    const scalar fraction = (mushy_temperature - solidus) / (liquidus - solidus);
    return specific_heat_solid * mushy_temperature +
           0.5 * (specific_heat_liquid - specific_heat_solid) * fraction * (mushy_temperature - solidus) +
           latent_heat * fraction + specific_heat_liquid * (temperature - mushy_temperature);
}

scalar PrimaryMaterial::enthalpy_slope(scalar temperature) const
{
    if (!melts || temperature >= liquidus) return specific_heat_liquid;
    if (temperature <= solidus) return specific_heat_solid;
    return specific_heat_solid + (specific_heat_liquid - specific_heat_solid) * liquid_fraction(temperature) +
           latent_heat / (liquidus - solidus);
}

scalar PrimaryMaterial::conductivity(scalar temperature) const
{
    return conductivity_solid + (conductivity_liquid - conductivity_solid) * liquid_fraction(temperature);
}

scalar PrimaryMaterial::surface_tension(scalar temperature) const
{
    return max(surface_tension_at_reference +
                   surface_tension_slope * (temperature - surface_tension_reference_temperature),
               surface_tension_minimum);
}

scalar PrimaryMaterial::surface_tension_derivative(scalar temperature) const
{
    const scalar unlimited =
        surface_tension_at_reference + surface_tension_slope * (temperature - surface_tension_reference_temperature);
    return unlimited > surface_tension_minimum ? surface_tension_slope : scalar(0);
}

scalar PrimaryMaterial::saturation_pressure(scalar temperature, scalar ambient_pressure) const
{
    const scalar scale = vaporization_heat * molar_mass / gas_constant;
    return ambient_pressure * Foam::exp(scale * (1 / boiling_temperature - 1 / max(temperature, scalar(1))));
}

scalar PrimaryMaterial::mixture_temperature(scalar volumetric_enthalpy, scalar primary_mass,
                                            scalar other_capacity) const
{
    const scalar liquid_capacity = primary_mass * specific_heat_liquid + other_capacity;
    if (!melts) return volumetric_enthalpy / liquid_capacity;
    const scalar solid_capacity = primary_mass * specific_heat_solid + other_capacity;
    const scalar at_solidus = solid_capacity * solidus;
    if (volumetric_enthalpy <= at_solidus) return volumetric_enthalpy / solid_capacity;
    const scalar latent = primary_mass * latent_heat, width = liquidus - solidus;
    const scalar at_liquidus = at_solidus + 0.5 * (solid_capacity + liquid_capacity) * width + latent;
    if (volumetric_enthalpy >= at_liquidus) return liquidus + (volumetric_enthalpy - at_liquidus) / liquid_capacity;
    // quadratic ½ (C_l − C_s)/width x² + (C_s + latent/width) x = H − H_s, in the form that does not cancel
    const scalar a = 0.5 * (liquid_capacity - solid_capacity) / width, b = solid_capacity + latent / width;
    const scalar excess = volumetric_enthalpy - at_solidus;
    return solidus + 2 * excess / (b + Foam::sqrt(max(b * b + 4 * a * excess, scalar(0))));
}

SurroundingMaterial::SurroundingMaterial(const dictionary& entries)
    : density(entries.get<scalar>("density")), viscosity(entries.getOrDefault<scalar>("viscosity", 0)),
      specific_heat(entries.getOrDefault<scalar>("specific_heat", 1)),
      conductivity(entries.getOrDefault<scalar>("conductivity", 0))
{}
} // namespace cupel
