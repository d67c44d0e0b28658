#pragma once

#include <cmath>
#include <optional>

#include "models/enthalpy.hpp"
#include "models/evaporation.hpp"
#include "models/radiation.hpp"

namespace cupel
{

/// Heat that leaves the surface, by mechanism, W/m² (or J where it is booked).
struct LossShares
{
    double evaporation = 0, radiation = 0, convection = 0;

    double total() const { return evaporation + radiation + convection; }
    LossShares& operator+=(const LossShares& other)
    {
        evaporation += other.evaporation;
        radiation += other.radiation;
        convection += other.convection;
        return *this;
    }
};

/// The losses that a scene names.
struct SurfaceLosses
{
    std::optional<Evaporation> evaporation;
    std::optional<Radiation> radiation;

    bool any() const { return evaporation || radiation; }
    LossShares heat_flux(double temperature) const
    {
        return {evaporation ? evaporation->heat_flux(temperature) : 0.0,
                radiation ? radiation->radiative_flux(temperature) : 0.0,
                radiation ? radiation->convective_flux(temperature) : 0.0};
    }
};

/// One implicit step of a particle's surface losses, the only stiff part of its heat balance:
///
///   h = h* − (A Δt/m) q(T(h))      [J/kg]
///
/// h* the enthalpy after all else, A its exposed area, m its mass. Since h(T) and q(T) rise with T, there is one root,
/// between h* and h* − (A Δt/m) q(T(h*)): it cannot overshoot, however long the step. Found by Newton steps on the
/// secant within that bracket (regula falsi, Illinois). Returns what left, J/kg, by mechanism; its total is exactly
/// what the enthalpy loses.
///
///   per_flux    A Δt/m, m²·s/kg
inline LossShares implicit_losses(const SurfaceLosses& losses, const ThermalMaterial& material, double enthalpy,
                                  double per_flux)
{
    const auto flux_at = [&](double h) { return losses.heat_flux(material.temperature(h)); };
    LossShares flux = flux_at(enthalpy);
    double lost = per_flux * flux.total();
    // A change of less than 10⁻⁴ K cannot overshoot.
    if (std::abs(lost) > 1e-4 * material.specific_heat_solid)
    {
        // residual(x) = per_flux q(T(h* − x)) − x falls with x: it is `lost` at 0 and has the other sign at `lost`.
        double a = 0.0, residual_a = lost;
        double b = lost, residual_b = per_flux * flux_at(enthalpy - b).total() - b;
        for (int iteration = 0; iteration < 100 && residual_b != 0.0 && std::abs(b - a) > 1e-13 * std::abs(enthalpy);
             ++iteration)
        {
            const double x = b - residual_b * (b - a) / (residual_b - residual_a);
            flux = flux_at(enthalpy - x);
            const double residual = per_flux * flux.total() - x;
            if ((residual > 0.0) != (residual_b > 0.0))
            {
                a = b;
                residual_a = residual_b;
            }
            else
                residual_a *= 0.5;
            b = x;
            residual_b = residual;
            if (std::abs(residual) <= 1e-12 * std::abs(x))
                break;
        }
        lost = b;
    }
    const double total = flux.total();
    if (total == 0.0) return {};
    const double scale = lost / total;
    return {scale * flux.evaporation, scale * flux.radiation, scale * flux.convection};
}

}  // namespace cupel
