#include "volume_fraction.hpp"
#include "CMULES.H"

namespace cupel
{
void advance_volume_fraction(const Scene& scene, Fields& fields, InterfaceGeometry& geometry)
{
    const fvMesh& mesh = fields.mesh;
    FlowFields& flow = fields.flow();
    volScalarField& fraction = fields.fraction;
    const volScalarField other("other_fraction", 1.0 - fraction);
    const scalar compression = scene.numerics.get<scalar>("interface_compression");

    surfaceScalarField compressive_speed(compression * mag(flow.flux / mesh.magSf()));
    surfaceScalarField::Boundary& speed_at_boundary = compressive_speed.boundaryFieldRef();
    forAll (speed_at_boundary, patch)
        if (!speed_at_boundary[patch].coupled()) speed_at_boundary[patch] == 0;
    const surfaceScalarField compressive_flux(compressive_speed * geometry.normal_flux());

    flow.fraction_flux =
        fvc::flux(flow.flux, fraction, "div(phi,fraction)") +
        fvc::flux(-fvc::flux(-compressive_flux, other, "div(compression)"), fraction, "div(compression)");
    MULES::explicitSolve(geometricOneField(), fraction, flow.flux, flow.fraction_flux, oneField(), zeroField());

    flow.mass_flux =
        flow.fraction_flux * dimensionedScalar("jump", dimDensity, scene.primary.density - scene.surrounding.density) +
        flow.flux * dimensionedScalar("surrounding", dimDensity, scene.surrounding.density);
    fields.update_density(scene);
    geometry.update();
}
} // namespace cupel
