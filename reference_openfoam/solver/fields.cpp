#include "fields.hpp"
#include "processorFvPatch.H"

namespace cupel
{
namespace
{
IOobject stored(const fvMesh& mesh, const word& name, IOobject::readOption reading)
{
    return IOobject(name, mesh.time().timeName(), mesh, reading, IOobject::AUTO_WRITE);
}

IOobject working(const fvMesh& mesh, const word& name)
{
    return IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE);
}

/// Fetches the values beside the cuts between ranks: a start field is read without them, and a field that is never
/// solved for (a frozen temperature) would keep its own.
template <class Type>
GeometricField<Type, fvPatchField, volMesh>& exchanged(GeometricField<Type, fvPatchField, volMesh>& field)
{
    auto& patches = field.boundaryFieldRef();
    const label requests = Pstream::nRequests();
    forAll (patches, patch)
        if (isA<processorFvPatch>(patches[patch].patch()))
            patches[patch].initEvaluate(Pstream::commsTypes::nonBlocking);
    Pstream::waitRequests(requests);
    forAll (patches, patch)
        if (isA<processorFvPatch>(patches[patch].patch())) patches[patch].evaluate(Pstream::commsTypes::nonBlocking);
    return field;
}

/// The part of `whole` along axes with periodic sides: no potential is periodic whose gradient it would be.
vector along_periodic_axes(const fvMesh& mesh, const vector& whole)
{
    vector part(Zero);
    forAll (mesh.boundary(), patch) {
        if (mesh.boundary()[patch].type() != "cyclic") continue;
        const vector area = gSum(cmptMag(mesh.boundary()[patch].Sf())());
        for (int axis = 0; axis < 3; ++axis)
            if (area[axis] > 0.9 * mag(area)) part[axis] = whole[axis];
    }
    return part;
}

tmp<volScalarField> mixture_density(const Scene& scene, const volScalarField& fraction)
{
    const scalar primary = scene.primary.density, surrounding = scene.surrounding.density;
    return map_field(fraction, "mixture_density", dimDensity,
                     [=](scalar share) { return share * primary + (1 - share) * surrounding; });
}
} // namespace

FlowFields::FlowFields(const fvMesh& mesh, const Scene& scene, const volScalarField& fraction)
    : velocity(stored(mesh, "U", IOobject::MUST_READ), mesh),
      reduced_pressure(stored(mesh, "p_rgh", IOobject::MUST_READ), mesh),
      flux(stored(mesh, "phi", IOobject::READ_IF_PRESENT), fvc::flux(exchanged(velocity))),
      fraction_flux(working(mesh, "fraction_flux"), flux * fvc::interpolate(fraction)),
      density(working(mesh, "density"), mixture_density(scene, fraction)),
      mass_flux(working(mesh, "mass_flux"), fvc::interpolate(density) * flux),
      gravity_potential(working(mesh, "gh"), mesh, dimensionedScalar(dimAcceleration * dimLength, Zero)),
      gravity_potential_faces(working(mesh, "ghf"), mesh, dimensionedScalar(dimAcceleration * dimLength, Zero)),
      periodic_gravity(Zero), reference_cell(0), reference_pressure(0)
{
    exchanged(reduced_pressure);
    if (scene.physics.surface_tension) {
        acceleration.reset(new surfaceScalarField(stored(mesh, "acceleration", IOobject::READ_IF_PRESENT), mesh,
                                                  dimensionedScalar(dimVolume / sqr(dimTime), Zero)));
        acceleration->setOriented();
    }
    density.oldTime();
    if (scene.physics.gravity) {
        const uniformDimensionedVectorField g(
            IOobject("g", mesh.time().constant(), mesh, IOobject::MUST_READ, IOobject::NO_WRITE));
        periodic_gravity = along_periodic_axes(mesh, g.value());
        const dimensionedVector with_potential("g", dimAcceleration, g.value() - periodic_gravity);
        gravity_potential = with_potential & mesh.C();
        gravity_potential_faces = with_potential & mesh.Cf();
    }
    setRefCell(reduced_pressure, mesh.solutionDict().subDict("PISO"), reference_cell, reference_pressure);
    mesh.setFluxRequired(reduced_pressure.name());
    mesh.setFluxRequired(fraction.name());
}

HeatFields::HeatFields(const fvMesh& mesh, bool solved) : temperature(stored(mesh, "T", IOobject::MUST_READ), mesh)
{
    exchanged(temperature);
    if (solved)
        peak.reset(new volScalarField(stored(mesh, "peak_temperature", IOobject::READ_IF_PRESENT), temperature));
}

Fields::Fields(const fvMesh& solver_mesh, const Scene& scene)
    : mesh(solver_mesh), fraction(stored(mesh, "fraction", IOobject::MUST_READ), mesh)
{
    exchanged(fraction);
    if (scene.physics.flow) flow.reset(new FlowFields(mesh, scene, fraction));
    if (scene.physics.has_temperature()) heat.reset(new HeatFields(mesh, scene.physics.heat));
}

tmp<volScalarField> Fields::bounded_fraction() const
{
    return map_field(fraction, "bounded_fraction", dimless,
                     [](scalar share) { return min(max(share, scalar(0)), scalar(1)); });
}

void Fields::update_density(const Scene& scene)
{
    flow->density == mixture_density(scene, fraction)();
}

void Fields::update_peak()
{
    const volScalarField& temperature = heat->temperature;
    scalarField& peak = heat->peak->primitiveFieldRef();
    forAll (peak, cell)
        if (fraction[cell] >= 0.5) peak[cell] = max(peak[cell], temperature[cell]);
}
} // namespace cupel
