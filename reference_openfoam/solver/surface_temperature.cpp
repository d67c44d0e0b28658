#include "surface_temperature.hpp"

namespace cupel
{
namespace
{
IOobject unwritten(const fvMesh& mesh, const word& name)
{
    return IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false);
}
} // namespace

SurfaceTemperature::SurfaceTemperature(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry)
    : value(unwritten(fields.mesh, "surface_temperature"), fields.heat->temperature),
      gradient(unwritten(fields.mesh, "surface_temperature_gradient"), fields.mesh,
               dimensionedVector(dimTemperature / dimLength, Zero)),
      outward(unwritten(fields.mesh, "outward_normal"), fields.mesh, dimensionedVector(dimless, Zero))
{
    const HeightFunction& heights = geometry.heights();
    const BlockGrid& grid = heights.grid();
    const std::vector<scalar> share = grid.gathered(fields.fraction.primitiveField()),
                              temperature = grid.gathered(fields.heat->temperature.primitiveField());
    const volVectorField cell_gradient(fvc::grad(fields.heat->temperature));
    const scalar near_interface = 1e-3 / scene.spacing;
    forAll (value, cell) {
        if (mag(geometry.gradient()[cell]) < near_interface) continue;
        const BlockGrid::Index& here = grid.index(cell);
        const vector normal = heights.outward_normal(share, here);
        outward[cell] = normal / mag(normal);
        gradient[cell] = cell_gradient[cell] - outward[cell] * (outward[cell] & cell_gradient[cell]);
        const scalar metal = scene.physics.heat ? scene.primary.conductivity(value[cell]) : 1;
        const scalar other = scene.physics.heat ? scene.surrounding.conductivity : 1;
        heights.surface_value(share, temperature, metal / (metal + other), here, value[cell], gradient[cell]);
    }
    value.correctBoundaryConditions();
}
} // namespace cupel
