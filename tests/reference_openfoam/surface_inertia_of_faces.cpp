/// What SurfaceInertia has of each face of a case as it starts, for an acceleration that is linear on either side of a
/// level; test_surface_inertia.py asks it.
///
/// Usage: cupel_surface_inertia -case FOLDER. FOLDER/constant/acceleration has `uniform` [m/s²], and `below` and
/// `above` [1/s²]: a_k = uniform_k + slope_k (x_k − level) on faces across axis k, with the slopes of below where
/// x_k ≤ level, else of above. Prints a line a face, boundaries' faces last: "face", centre, normal, area, excess
/// [kg/m³], carried [N], and 1 for a face of a boundary.
#include <iomanip>
#include <iostream>

#include "surface_inertia.hpp"

namespace
{
using namespace cupel;

tmp<surfaceScalarField> acceleration_of_flux(const fvMesh& mesh)
{
    const IOdictionary wanted(IOobject("acceleration", "constant", mesh, IOobject::MUST_READ, IOobject::NO_WRITE));
    const vector uniform(wanted.get<vector>("uniform"));
    const vector below(wanted.get<vector>("below")), above(wanted.get<vector>("above"));
    const scalar level(wanted.get<scalar>("level"));
    tmp<surfaceScalarField> result(
        new surfaceScalarField(IOobject("acceleration_of_flux", mesh.time().timeName(), mesh), mesh,
                               dimensionedScalar(dimAcceleration * dimArea, Zero)));
    result.ref().setOriented();
    const auto through = [&](const point& center, const vector& area) {
        scalar sum = 0;
        for (direction axis = 0; axis < 3; ++axis) {
            const scalar slope = center[axis] <= level ? below[axis] : above[axis];
            sum += area[axis] * (uniform[axis] + slope * (center[axis] - level));
        }
        return sum;
    };
    forAll(mesh.Cf(), face) result.ref()[face] = through(mesh.Cf()[face], mesh.Sf()[face]);
    forAll(mesh.boundary(), patch)
    {
        const fvPatch& side = mesh.boundary()[patch];
        forAll(side, face) result.ref().boundaryFieldRef()[patch][face] = through(side.Cf()[face], side.Sf()[face]);
    }
    return result;
}

void print(const point& center, const vector& area, scalar excess, scalar carried, bool is_boundary)
{
    std::cout << "face ";
    for (const vector& each : {vector(center), area / mag(area)})
        std::cout << each.x() << ' ' << each.y() << ' ' << each.z() << ' ';
    std::cout << mag(area) << ' ' << excess << ' ' << carried << ' ' << is_boundary << '\n';
}
} // namespace

int main(int argc, char** argv)
{
    argList::noFunctionObjects();
    argList arguments(argc, argv);
    messageStream::level = 0;
    Time clock(Time::controlDictName, arguments);
    const fvMesh mesh(IOobject(fvMesh::defaultRegion, clock.timeName(), clock, IOobject::MUST_READ));
    const Scene scene(
        IOdictionary(IOobject("cupelProperties", clock.constant(), mesh, IOobject::MUST_READ, IOobject::NO_WRITE)));
    Fields fields(mesh, scene);
    InterfaceGeometry geometry(scene, fields);
    geometry.update();
    const SurfaceInertia inertia(scene, fields, geometry);
    const surfaceScalarField excess(inertia.excess()), carried(inertia.carried(acceleration_of_flux(mesh)));
    std::cout << std::setprecision(17);
    forAll(excess, face) print(mesh.Cf()[face], mesh.Sf()[face], excess[face], carried[face], false);
    forAll(mesh.boundary(), patch)
    {
        const fvPatch& side = mesh.boundary()[patch];
        forAll(side, face) print(side.Cf()[face], side.Sf()[face], excess.boundaryField()[patch][face],
                                 carried.boundaryField()[patch][face], true);
    }
}
