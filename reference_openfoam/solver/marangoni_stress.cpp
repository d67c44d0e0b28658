#include "marangoni_stress.hpp"

namespace cupel
{
namespace
{
/// ∇S of marangoni_stress.hpp in cells: the step of S across each face, shared out between its two cells by their
/// density.
tmp<volVectorField> heavy_side_gradient(const Fields& fields)
{
    const fvMesh& mesh = fields.mesh;
    const volScalarField step(smooth_step(fields));
    const volScalarField& density = fields.flow->density;
    tmp<volVectorField> result(new volVectorField(
        IOobject("heavy_side_gradient", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false),
        mesh, dimensionedVector(dimless / dimLength, Zero)));
    vectorField& gradient = result.ref().primitiveFieldRef();
    const labelUList &owner = mesh.owner(), &neighbour = mesh.neighbour();
    forAll (neighbour, face) {
        const label one = owner[face], other = neighbour[face];
        const vector across = (step[other] - step[one]) * mesh.Sf()[face];
        const scalar share = density[one] / (density[one] + density[other]);
        gradient[one] += share * across;
        gradient[other] += (1 - share) * across;
    }
    forAll (mesh.boundary(), patch) {
        if (!mesh.boundary()[patch].coupled()) continue;
        const labelUList& cells = mesh.boundary()[patch].faceCells();
        const scalarField step_beyond(step.boundaryField()[patch].patchNeighbourField());
        const scalarField density_beyond(density.boundaryField()[patch].patchNeighbourField());
        forAll (cells, face) {
            const label cell = cells[face];
            gradient[cell] += density[cell] / (density[cell] + density_beyond[face]) *
                              (step_beyond[face] - step[cell]) * mesh.Sf().boundaryField()[patch][face];
        }
    }
    gradient /= mesh.V().field();
    return result;
}
} // namespace

tmp<volVectorField> marangoni_force(const Scene& scene, const Fields& fields, const SurfaceTemperature& surface)
{
    const PrimaryMaterial& primary = scene.primary;
    const volScalarField slope("surface_tension_derivative",
                               map_field(surface.value, "surface_tension_derivative",
                                         dimForce / dimLength / dimTemperature, [&primary](scalar value) {
                                             return primary.surface_tension_derivative(value) *
                                                    primary.liquid_fraction(value);
                                         }));
    const dimensionedScalar none(dimless / dimLength, Zero);
    return slope * max(-(surface.outward & heavy_side_gradient(fields)), none) * surface.gradient;
}
} // namespace cupel
