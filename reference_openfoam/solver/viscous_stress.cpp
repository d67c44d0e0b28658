#include "viscous_stress.hpp"

#include "localMin.H"

namespace cupel
{
namespace
{
tmp<volScalarField> mixture_viscosity(const Scene& scene, const volScalarField& fraction)
{
    const scalar primary = scene.primary.viscosity, surrounding = scene.surrounding.viscosity;
    return map_field(fraction, "viscosity", dimPressure * dimTime, [=](scalar share) {
        const scalar bounded = min(max(share, scalar(0)), scalar(1));
        return bounded * primary + (1 - bounded) * surrounding;
    });
}

/// 2/(φ_P + φ_N) of a face's cells, φ the share of a cell that is not solid; at most 2.
tmp<surfaceScalarField> nearness_of_solid(const Scene& scene, const Fields& fields)
{
    const PrimaryMaterial& primary = scene.primary;
    const volScalarField solid("solid", map_field(fields.heat->temperature, "solid", dimless,
                                                  [&primary](scalar t) { return 1 - primary.liquid_fraction(t); }));
    return 1 / max(1 - fvc::interpolate(solid * fields.bounded_fraction()), scalar(0.5));
}

/// ∂u_k/∂x_k in cells for k = x, y, z [1/s]: net outflow along each axis by the cell's volume.
tmp<volVectorField> rates_of_stretch(const surfaceScalarField& flux)
{
    const surfaceVectorField normal(flux.mesh().Sf() / flux.mesh().magSf());
    surfaceVectorField axis(cmptMultiply(normal, normal)); // whichever way the face's normal points
    axis.setOriented(false);
    return fvc::surfaceIntegrate(flux * axis);
}

tmp<surfaceScalarField> viscosity_on_faces(const Scene& scene, const Fields& fields, const volScalarField& viscosity)
{
    tmp<surfaceScalarField> result(fvc::interpolate(viscosity));
    if (scene.physics.melting) result.ref() *= nearness_of_solid(scene, fields);
    return result;
}
} // namespace

ViscousStress::ViscousStress(const Scene& scene, const Fields& fields)
    : mesh_(fields.mesh), flux_(fields.flow->flux), viscosity_(mixture_viscosity(scene, fields.fraction)),
      on_faces_(viscosity_on_faces(scene, fields, viscosity_)),
      explicit_(dimensionedScalar("half_of_primary", dimPressure * dimTime, 0.5 * scene.primary.viscosity) *
                localMin<scalar>(mesh_).interpolate(fields.bounded_fraction()))
{}

tmp<fvVectorMatrix> ViscousStress::resistance(volVectorField& velocity) const
{
    volTensorField gradient(fvc::grad(velocity));
    const volVectorField stretch(rates_of_stretch(flux_));
    forAll (gradient, cell) {
        gradient[cell].xx() = stretch[cell].x();
        gradient[cell].yy() = stretch[cell].y();
        gradient[cell].zz() = stretch[cell].z();
    }
    gradient.correctBoundaryConditions();
    return -fvm::laplacian(on_faces_ - explicit_, velocity) - fvc::laplacian(explicit_, velocity) -
           fvc::div(viscosity_ * Foam::T(gradient));
}

tmp<volScalarField> ViscousStress::damping() const
{
    tmp<volScalarField> result(new volScalarField(
        IOobject("damping", mesh_.time().timeName(), mesh_, IOobject::NO_READ, IOobject::NO_WRITE, false), mesh_,
        dimensionedScalar(dimDensity / dimTime, Zero)));
    result.ref().primitiveFieldRef() =
        fvc::surfaceSum((on_faces_ - explicit_) * mesh_.magSf() * mesh_.nonOrthDeltaCoeffs())().primitiveField() /
        mesh_.V().field();
    result.ref().correctBoundaryConditions();
    return result;
}
} // namespace cupel
