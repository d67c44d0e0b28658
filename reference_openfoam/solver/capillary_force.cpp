#include "capillary_force.hpp"

namespace cupel
{
tmp<surfaceScalarField> interface_step_gradient(const Fields& fields)
{
    return fvc::snGrad(smooth_step(fields)());
}

void add_capillary_force(surfaceScalarField& force, const surfaceScalarField& interface_gradient, const Scene& scene,
                         const InterfaceGeometry& geometry, const SurfaceTemperature* surface)
{
    const PrimaryMaterial& primary = scene.primary;
    const dimensionSet tension_dimensions(dimForce / dimLength);
    if (!surface) {
        force += dimensionedScalar("surface_tension", tension_dimensions, primary.surface_tension_at_reference) *
                 geometry.curvature() * interface_gradient;
        return;
    }
    const volScalarField tension("surface_tension", map_field(surface->value, "surface_tension", tension_dimensions,
                                                              [&primary](scalar temperature) {
                                                                  return primary.surface_tension(temperature) *
                                                                         primary.liquid_fraction(temperature);
                                                              }));
    force += geometry.at_faces(tension) * geometry.curvature() * interface_gradient;
}
} // namespace cupel
