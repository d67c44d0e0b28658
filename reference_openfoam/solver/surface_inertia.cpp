#include "surface_inertia.hpp"

#include "localMax.H"
#include "localMin.H"
#include "upwind.H"

namespace cupel
{
SurfaceInertia::SurfaceInertia(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry)
    : mesh_(fields.mesh), primary_("primary", dimDensity, scene.primary.density),
      surrounding_("surrounding", dimDensity, scene.surrounding.density),
      drop_("drop", -fvc::snGrad(fields.fraction) / mesh_.nonOrthDeltaCoeffs()), share_("share", mag(drop_) / 8)
{
    const volScalarField share(fields.bounded_fraction());
    const surfaceScalarField full(localMax<scalar>(mesh_).interpolate(share));
    const surfaceScalarField thin(localMin<scalar>(mesh_).interpolate(share));
    const surfaceVectorField gradient(fvc::interpolate(geometry.gradient()));
    const dimensionedScalar none("none", dimless / dimLength, 1e-8 / scene.spacing);
    surfaceScalarField descent(-(gradient & mesh_.Sf()) / (mesh_.magSf() * (mag(gradient) + none)) * sign(drop_));
    share_.setOriented(false);
    descent.setOriented(false);
    share_ += 0.5 * max(descent, scalar(0)) *
              (sqr(full) * (1 - full) / (1 + 2 * full) + thin * (1 - sqr(thin)) / (1 + 2 * thin));
    surfaceScalarField::Boundary& at_boundary = share_.boundaryFieldRef();
    forAll (at_boundary, patch)
        if (!at_boundary[patch].coupled()) at_boundary[patch] = 0;
}

tmp<surfaceScalarField> SurfaceInertia::excess() const
{
    return (primary_ + surrounding_) * share_;
}

tmp<surfaceScalarField> SurfaceInertia::carried(const surfaceScalarField& acceleration) const
{
    surfaceVectorField axis(cmptMultiply(mesh_.Sf(), mesh_.Sf()) / sqr(mesh_.magSf()));
    axis.setOriented(false);
    // ∂a_k/∂x_k of each cell for k = x, y, z, from its two faces across that axis
    const volVectorField change(fvc::surfaceIntegrate(acceleration * axis));
    const surfaceScalarField backwards(-drop_);
    surfaceScalarField fuller(upwind<vector>(mesh_, drop_).interpolate(change) & axis);
    surfaceScalarField thinner(upwind<vector>(mesh_, backwards).interpolate(change) & axis);
    fuller.setOriented(false);
    thinner.setOriented(false);
    const surfaceScalarField direction(sign(drop_));
    tmp<surfaceScalarField> force(
        share_ * ((primary_ + surrounding_) * acceleration - direction * (primary_ * fuller - surrounding_ * thinner) *
                                                                 mesh_.magSf() / mesh_.nonOrthDeltaCoeffs()));
    force.ref().setOriented();
    return force;
}
} // namespace cupel
