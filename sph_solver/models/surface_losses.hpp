#pragma once

#include <algorithm>
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
///   h = h* − x,   x = (A Δt/m) q(T(h* − x))      [J/kg]
///
/// h* the enthalpy after all else, A its exposed area, m its mass. Since h(T) and q(T) rise with T there is one root,
/// and it lies between 0 and the explicit loss, short of T = 0 where that is positive and of the surrounding's
/// temperature where it is negative: it cannot overshoot, however long the step. Found by bracketing with inverse
/// quadratic steps (Chandrupatla 1997). Returns what left, J/kg, by mechanism.
///
///   per_flux    A Δt/m, m²·s/kg
inline LossShares implicit_losses(const SurfaceLosses& losses, const ThermalMaterial& material, double enthalpy,
                                  double per_flux)
{
    LossShares flux = losses.heat_flux(material.temperature(enthalpy));
    const double explicit_loss = per_flux * flux.total();
    double lost = explicit_loss;
    // A change of less than 10⁻⁴ K cannot overshoot.
    if (std::abs(explicit_loss) > 1e-4 * material.specific_heat_solid) {
        const auto residual = [&](double x) {
            flux = losses.heat_flux(material.temperature(enthalpy - x));
            return per_flux * flux.total() - x;
        };
        const double limit =
            explicit_loss > 0.0
                ? std::min(explicit_loss, enthalpy)
                : std::max(explicit_loss, enthalpy - material.enthalpy(losses.radiation->surrounding_temperature));
        const double tolerance = 1e-13 * std::abs(enthalpy);
        double x1 = limit, f1 = residual(limit), x2 = 0.0, f2 = explicit_loss, share = 0.5;
        for (int iteration = 0; iteration < 200 && f1 != 0.0 && std::abs(x2 - x1) > 2.0 * tolerance; ++iteration) {
            const double x = x1 + share * (x2 - x1), f = residual(x);
            double x3 = x1, f3 = f1;
            if ((f > 0.0) != (f1 > 0.0)) {
                x3 = x2, f3 = f2;
                x2 = x1, f2 = f1;
            }
            x1 = x, f1 = f;
            const double xi = (x1 - x2) / (x3 - x2), phi = (f1 - f2) / (f3 - f2);
            share = 0.5;
            if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
                share = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2);
            const double least = std::min(0.5, tolerance / std::abs(x2 - x1));
            share = std::clamp(share, least, 1.0 - least);
        }
        lost = x1;
        flux = losses.heat_flux(material.temperature(enthalpy - lost));
    }
    const double total = flux.total();
    if (total == 0.0) return {};
    const double scale = lost / total;
    return {scale * flux.evaporation, scale * flux.radiation, scale * flux.convection};
}

} // namespace cupel
