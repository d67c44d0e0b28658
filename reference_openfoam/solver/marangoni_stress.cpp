#include "marangoni_stress.hpp"

namespace cupel
{
tmp<volVectorField> marangoni_force(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry)
{
    const PrimaryMaterial& primary = scene.primary;
    const volScalarField& temperature = fields.heat->temperature;
    const volVectorField temperature_gradient(fvc::grad(temperature));
    const volVectorField normal(geometry.unit_normal());
    const dimensionedScalar mean_density("mean_density", dimDensity,
                                         0.5 * (primary.density + scene.surrounding.density));
    const volScalarField slope("surface_tension_derivative",
                               map_field(temperature, "surface_tension_derivative",
                                         dimForce / dimLength / dimTemperature, [&primary](scalar value) {
                                             return primary.surface_tension_derivative(value) *
                                                    primary.liquid_fraction(value);
                                         }));
    return slope * mag(geometry.gradient()) * (fields.flow->density / mean_density) *
           (temperature_gradient - normal * (normal & temperature_gradient));
}
} // namespace cupel
