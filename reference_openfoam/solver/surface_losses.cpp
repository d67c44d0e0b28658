#include "surface_losses.hpp"

namespace cupel
{
namespace
{
const scalar molar_gas_constant = 8.314462618;  // J/(mol·K)
const scalar stefan_boltzmann = 5.670374419e-8; // W/(m²·K⁴)
} // namespace

SurfaceLosses::SurfaceLosses(const Scene& scene) : scene_(scene) {}

scalar SurfaceLosses::flux(scalar temperature) const
{
    const PrimaryMaterial& primary = scene_.primary;
    const scalar ambient = scene_.ambient_temperature;
    scalar result = scene_.convection_coefficient * (temperature - ambient);
    if (scene_.physics.radiation) result += primary.emissivity * stefan_boltzmann * (pow4(temperature) - pow4(ambient));
    if (scene_.physics.evaporation && 2 * temperature > primary.boiling_temperature) {
        result += 0.82 * primary.vaporization_heat * primary.saturation_pressure(temperature, scene_.ambient_pressure) *
                  Foam::sqrt(primary.molar_mass / (constant::mathematical::twoPi * molar_gas_constant * temperature));
    }
    return result;
}

void SurfaceLosses::update(const Fields& fields, const volVectorField& fraction_gradient)
{
    const volScalarField& temperature = fields.heat->temperature;
    loss_.setSize(temperature.size());
    slope_.setSize(temperature.size());
    loss_ = 0;
    slope_ = 0;
    const scalar no_interface = 1e-6 / scene_.spacing;
    forAll (loss_, cell) {
        const scalar weight = 2 * min(max(fields.fraction[cell], scalar(0)), scalar(1)) * mag(fraction_gradient[cell]);
        if (weight < no_interface) continue;
        const scalar here = temperature[cell];
        loss_[cell] = weight * flux(here);
        slope_[cell] = weight * max(flux(here + 0.5) - flux(here - 0.5), scalar(0));
    }
}
} // namespace cupel
