/// The part of OpenFOAM that this solver uses, in one place, and small helpers over its fields.
#pragma once

#include "fvCFD.H"

namespace cupel
{
using namespace Foam;

/// Dimension sets that OpenFOAM does not name.
const dimensionSet specific_energy_dimensions(dimEnergy / dimMass);
const dimensionSet conductivity_dimensions(dimPower / dimLength / dimTemperature);
const dimensionSet heat_capacity_dimensions(dimEnergy / dimVolume / dimTemperature);

/// A field whose value in each cell and boundary face is `law(argument)` there; not written.
template <class Law>
tmp<volScalarField> map_field(const volScalarField& argument, const word& name, const dimensionSet& dimensions, Law law)
{
    const fvMesh& mesh = argument.mesh();
    tmp<volScalarField> result_pointer(
        new volScalarField(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false),
                           mesh, dimensionedScalar(dimensions, Zero)));
    volScalarField& result = result_pointer.ref();
    scalarField& cells = result.primitiveFieldRef();
    forAll (cells, cell)
        cells[cell] = law(argument[cell]);
    forAll (result.boundaryField(), patch) {
        fvPatchScalarField& faces = result.boundaryFieldRef()[patch];
        const fvPatchScalarField& values = argument.boundaryField()[patch];
        forAll (faces, face)
            faces[face] = law(values[face]);
    }
    return result_pointer;
}

/// ∫ field dV over the whole mesh (all ranks).
inline scalar volume_integral(const scalarField& field, const fvMesh& mesh)
{
    return gSum(scalarField(field * mesh.V().field()));
}
} // namespace cupel
