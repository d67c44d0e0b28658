#include "capillary_force.hpp"

namespace cupel
{
tmp<surfaceScalarField> interface_step_gradient(const Fields& fields)
{
    return fvc::snGrad(smooth_step(fields)());
}

void add_capillary_force(surfaceScalarField& force, const surfaceScalarField& interface_gradient, const Scene& scene,
                         const Fields& fields, const InterfaceGeometry& geometry)
{
    const PrimaryMaterial& primary = scene.primary;
    const dimensionSet tension_dimensions(dimForce / dimLength);
    if (!scene.physics.heat) {
        force += dimensionedScalar("surface_tension", tension_dimensions, primary.surface_tension_at_reference) *
                 geometry.curvature() * interface_gradient;
        return;
    }
    // σ(T) f_l of the primary material: the gas beside it must not dilute it, so the mean over a face is weighted by α
    const volScalarField share("share", fields.bounded_fraction() + scalar(1e-6));
    const volScalarField tension("surface_tension", map_field(fields.heat->temperature, "surface_tension",
                                                              tension_dimensions, [&primary](scalar temperature) {
                                                                  return primary.surface_tension(temperature) *
                                                                         primary.liquid_fraction(temperature);
                                                              }));
    force += fvc::interpolate(tension * share) / fvc::interpolate(share) * geometry.curvature() * interface_gradient;
}
} // namespace cupel
