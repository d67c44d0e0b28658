#include <cmath>

#include "capillary_force.hpp"
#include "marangoni_stress.hpp"
#include "momentum_equation.hpp"
#include "mushy_drag.hpp"
#include "recoil_pressure.hpp"
#include "surface_inertia.hpp"
#include "syncTools.H"
#include "viscous_stress.hpp"

namespace cupel
{
namespace
{
/// Capillary force, recoil and gravity's density jump on faces [N/m³].
tmp<surfaceScalarField> face_forces(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry,
                                    const SurfaceTemperature* surface)
{
    const fvMesh& mesh = fields.mesh;
    tmp<surfaceScalarField> force(new surfaceScalarField(
        IOobject("face_force", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false), mesh,
        dimensionedScalar(dimForce / dimVolume, Zero)));
    force.ref().setOriented(); // it is a force along each face's normal, also where nothing adds to it
    if (scene.physics.surface_tension || scene.physics.recoil) {
        const surfaceScalarField interface_gradient(interface_step_gradient(fields));
        if (scene.physics.surface_tension)
            add_capillary_force(force.ref(), interface_gradient, scene, geometry, surface);
        if (scene.physics.recoil) add_recoil_pressure(force.ref(), interface_gradient, scene, fields);
    }
    if (scene.physics.gravity) force.ref() -= fields.flow->gravity_potential_faces * fvc::snGrad(fields.flow->density);
    return force;
}

/// What each face's own flux of the last step has beyond the mean of its cells' velocities, times what a cell resists a
/// change with, ρ/Δt + D [kg/s²]: with it the flux keeps its inertia, as on a staggered mesh.
tmp<surfaceScalarField> own_history(const FlowFields& flow, const volScalarField& damping)
{
    const volScalarField resistance(flow.density.oldTime() / damping.mesh().time().deltaT() + damping);
    tmp<surfaceScalarField> history(fvc::interpolate(resistance) * flow.flux.oldTime() -
                                    fvc::flux(resistance * flow.velocity.oldTime()));
    surfaceScalarField::Boundary& at_boundary = history.ref().boundaryFieldRef();
    forAll (at_boundary, patch)
        if (!at_boundary[patch].coupled()) at_boundary[patch] = 0;
    return history;
}

/// A face of a periodic side, or between two ranks, has a flux on either side of it, which are one flux. Each has
/// round-off of its own, and their sum is no velocity of a cell and no pressure's business: with the inertia of
/// own_history it lived on and grew, until beside an open side gas came in that vanished in the corner (melt_on_solid
/// at 13 spacings a radius: 3 m/s, and a thousandth of the metal's heat in a millisecond).
void make_coupled_fluxes_agree(surfaceScalarField& flux)
{
    const fvMesh& mesh = flux.mesh();
    scalarField across(mesh.nFaces() - mesh.nInternalFaces(), 0);
    const auto first = [&](label patch) { return mesh.boundaryMesh()[patch].start() - mesh.nInternalFaces(); };
    forAll (flux.boundaryField(), patch) {
        const fvsPatchScalarField& here = flux.boundaryField()[patch];
        if (here.coupled()) SubList<scalar>(across, here.size(), first(patch)) = here;
    }
    syncTools::swapBoundaryFaceList(mesh, across);
    forAll (flux.boundaryField(), patch) {
        fvsPatchScalarField& here = flux.boundaryFieldRef()[patch];
        if (here.coupled()) here = 0.5 * (here - SubField<scalar>(across, here.size(), first(patch)));
    }
}
} // namespace

void center_fluxes(FlowFields& flow, scalar longer)
{
    if (flow.acceleration.valid()) flow.flux += dimensionedScalar("half", dimTime, 0.5 * longer) * flow.acceleration();
}

void advance_momentum(const Scene& scene, Fields& fields, const InterfaceGeometry& geometry)
{
    const fvMesh& mesh = fields.mesh;
    FlowFields& flow = fields.flow();
    volVectorField& U = flow.velocity;
    volScalarField& p_rgh = flow.reduced_pressure;
    surfaceScalarField& phi = flow.flux;

    autoPtr<SurfaceTemperature> surface;
    if (scene.physics.has_temperature() && (scene.physics.marangoni || scene.physics.surface_tension))
        surface.reset(new SurfaceTemperature(scene, fields, geometry));

    const ViscousStress viscous_stress(scene, fields);
    fvVectorMatrix momentum(fvm::ddt(flow.density, U) + fvm::div(flow.mass_flux, U) + viscous_stress.resistance(U));
    if (scene.physics.melting) momentum += fvm::Sp(mushy_drag(scene, fields), U);
    if (mag(flow.periodic_gravity) > 0)
        momentum -= flow.density * dimensionedVector("periodic_gravity", dimAcceleration, flow.periodic_gravity);
    if (scene.physics.marangoni) momentum -= marangoni_force(scene, fields, surface());

    const surfaceScalarField forces(
        face_forces(scene, fields, geometry, surface.valid() ? surface.operator->() : nullptr) * mesh.magSf());
    const volScalarField A("A", momentum.A());
    const surfaceScalarField resistance(fvc::interpolate(A));
    const dimensionedScalar step(mesh.time().deltaT());
    // surface_inertia.hpp: resistance that faces do not have, forces less what moves as the faces across do, and what
    // the cells, which keep their whole mass, are given for a face's own acceleration
    surfaceScalarField excess("excess", 0 * resistance), push(forces), own_push(0 * forces);
    autoPtr<SurfaceInertia> below_surface;
    if (scene.physics.surface_tension) {
        below_surface.reset(new SurfaceInertia(scene, fields, geometry));
        excess = below_surface->excess() / step;
        push = forces - below_surface->carried(flow.acceleration());
        own_push = excess * step * flow.acceleration();
    }
    const surfaceScalarField rAUf("rAUf", 1 / (resistance - excess));
    const surfaceScalarField history(own_history(flow, viscous_stress.damping()()) - excess * phi.oldTime());
    const label correctors = scene.numerics.get<label>("pressure_correctors");
    if (scene.numerics.get<bool>("momentum_predictor"))
        solve(momentum == A * fvc::reconstruct((push + own_push - fvc::snGrad(p_rgh) * mesh.magSf()) / resistance));

    for (label corrector = 1; corrector <= correctors; ++corrector) {
        const volVectorField H(momentum.H());
        const volVectorField HbyA(constrainHbyA(H / A, U, p_rgh));
        surfaceScalarField predicted_flux("predicted_flux", rAUf * (fvc::flux(A * HbyA) + history));
        adjustPhi(predicted_flux, U, p_rgh);
        const surfaceScalarField force_flux(rAUf * push);
        predicted_flux += force_flux;
        constrainPressure(p_rgh, U, predicted_flux, rAUf);

        fvScalarMatrix pressure(fvm::laplacian(rAUf, p_rgh) == fvc::div(predicted_flux));
        pressure.setReference(flow.reference_cell, flow.reference_pressure);
        const scalar residual = pressure.solve(mesh.solver(p_rgh.select(corrector == correctors))).initialResidual();

        phi = predicted_flux - pressure.flux();
        make_coupled_fluxes_agree(phi);
        own_push = excess * (phi - phi.oldTime());
        U = HbyA + fvc::reconstruct(((force_flux - pressure.flux()) / rAUf + own_push) / resistance);
        U.correctBoundaryConditions();
        if (!std::isfinite(residual)) break; // the guards say where
        if (below_surface.valid()) {
            flow.acceleration() = (phi - phi.oldTime()) / step;
            push = forces - below_surface->carried(flow.acceleration());
        }
    }
    U += fvc::reconstruct(phi - fvc::flux(flow.density * U) / fvc::interpolate(flow.density));
    U.correctBoundaryConditions();
}
} // namespace cupel
