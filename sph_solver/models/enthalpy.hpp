#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "scene/case.hpp"

namespace cupel
{

/// What a material does with heat: temperature ↔ specific enthalpy through a mushy zone, and conductivity.
///
///   h(T) = c_s T                                            T ≤ T_s
///        = h(T_s) + (c_s ΔT + L) f + ½ (c_l − c_s) ΔT f²    T_s < T < T_l,  f = (T − T_s)/ΔT,  ΔT = T_l − T_s
///        = h(T_l) + c_l (T − T_l)                           T ≥ T_l                           [J/kg]
///   k(f) = k_s + (k_l − k_s) f                                                                [W/(m·K)]
///
/// so c is linear between solidus and liquidus and the latent heat L goes with the liquid fraction f. The inverse is
/// exact branch by branch, in the form of the quadratic's root that does not cancel; it holds down to ΔT = 0 (pure
/// metal), where f follows from h alone. The enthalpy is the state that is integrated.
///
/// One density, the liquid's, serves both states, as in the VOF reference: a particle keeps its mass and its volume
/// through melting. A material that does not melt has h = c T and f = 1 with the liquid's values.
struct ThermalMaterial
{
    double density = 0;                                     ///< ρ, kg/m³
    double specific_heat_solid = 0, specific_heat = 0;      ///< c_s, c_l, J/(kg·K)
    double conductivity_solid = 0, conductivity_liquid = 0; ///< k_s, k_l, W/(m·K)
    bool melts = false;
    double solidus = 0, liquidus = 0;                         ///< T_s, T_l, K
    double latent_heat = 0;                                   ///< L, J/kg
    double enthalpy_at_solidus = 0, enthalpy_at_liquidus = 0; ///< J/kg

    ThermalMaterial() = default;

    /// Throws CaseError, naming the key, where the material lacks what heat needs. Solid values that are absent are the
    /// liquid's. Where `melting` is false or the material has no solidus and liquidus, it does not melt.
    ThermalMaterial(const Material& material, bool melting);

    /// h, J/kg, of a temperature in K; at T = T_s = T_l the solid's.
    double enthalpy(double temperature) const;
    /// f, 0 … 1, of an enthalpy in J/kg.
    double liquid_fraction(double enthalpy) const;
    /// T, K, of an enthalpy in J/kg.
    double temperature(double enthalpy) const { return temperature(enthalpy, liquid_fraction(enthalpy)); }
    /// The same where the liquid fraction of this enthalpy is known already.
    double temperature(double enthalpy, double fraction) const;
    /// k, W/(m·K), of a liquid fraction.
    double conductivity(double fraction) const
    {
        return conductivity_solid + (conductivity_liquid - conductivity_solid) * fraction;
    }
};

inline ThermalMaterial::ThermalMaterial(const Material& material, bool melting) : density(material.density)
{
    const auto needed = [&](const std::optional<double>& value, const char* key) {
        if (!value)
            throw CaseError("material." + material.name + "." + key +
                            ": the physics 'heat' needs it; add it to the material");
        return *value;
    };
    specific_heat = needed(material.specific_heat, "specific_heat");
    conductivity_liquid = needed(material.conductivity, "conductivity");
    melts = melting && material.solidus && material.liquidus;
    specific_heat_solid = melts ? material.specific_heat_solid.value_or(specific_heat) : specific_heat;
    conductivity_solid = melts ? material.conductivity_solid.value_or(conductivity_liquid) : conductivity_liquid;
    if (!melts) return;
    solidus = *material.solidus;
    liquidus = *material.liquidus;
    if (liquidus < solidus)
        throw CaseError("material." + material.name + ".liquidus: is below the solidus; exchange them");
    latent_heat = material.latent_heat.value_or(0.0);
    enthalpy_at_solidus = specific_heat_solid * solidus;
    enthalpy_at_liquidus =
        enthalpy_at_solidus + 0.5 * (specific_heat_solid + specific_heat) * (liquidus - solidus) + latent_heat;
}

inline double ThermalMaterial::enthalpy(double temperature) const
{
    if (!melts) return specific_heat * temperature;
    if (temperature <= solidus) return specific_heat_solid * temperature;
    if (temperature >= liquidus) return enthalpy_at_liquidus + specific_heat * (temperature - liquidus);
    const double range = liquidus - solidus, f = (temperature - solidus) / range;
    return enthalpy_at_solidus +
           f * (specific_heat_solid * range + latent_heat + 0.5 * (specific_heat - specific_heat_solid) * range * f);
}

inline double ThermalMaterial::liquid_fraction(double enthalpy) const
{
    if (!melts || enthalpy >= enthalpy_at_liquidus) return 1.0;
    if (enthalpy <= enthalpy_at_solidus) return 0.0;
    const double range = liquidus - solidus, excess = enthalpy - enthalpy_at_solidus;
    const double a = 0.5 * (specific_heat - specific_heat_solid) * range, b = specific_heat_solid * range + latent_heat;
    const double f = 2.0 * excess / (b + std::sqrt(std::max(0.0, b * b + 4.0 * a * excess)));
    return std::min(f, 1.0);
}

inline double ThermalMaterial::temperature(double enthalpy, double fraction) const
{
    if (!melts) return enthalpy / specific_heat;
    if (enthalpy <= enthalpy_at_solidus) return enthalpy / specific_heat_solid;
    if (enthalpy >= enthalpy_at_liquidus) return liquidus + (enthalpy - enthalpy_at_liquidus) / specific_heat;
    return solidus + fraction * (liquidus - solidus);
}

} // namespace cupel
