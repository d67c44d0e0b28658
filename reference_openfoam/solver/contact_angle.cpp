#include "contact_angle.hpp"
#include "fixedGradientFvPatchFields.H"

namespace cupel
{
void apply_contact_angle(surfaceVectorField& unit_normal, const surfaceVectorField& face_gradient,
                         volScalarField& fraction, const Scene& scene, const Fields& fields)
{
    const fvMesh& mesh = fraction.mesh();
    const scalar cosine = Foam::cos(scene.primary.contact_angle), sine = Foam::sin(scene.primary.contact_angle);
    forAll (mesh.boundary(), patch) {
        if (!isA<fixedGradientFvPatchScalarField>(fraction.boundaryField()[patch])) continue;
        fixedGradientFvPatchScalarField& wall =
            refCast<fixedGradientFvPatchScalarField>(fraction.boundaryFieldRef()[patch]);
        fvsPatchVectorField& normals = unit_normal.boundaryFieldRef()[patch];
        const vectorField outward(mesh.boundary()[patch].nf());
        const vectorField& gradients = face_gradient.boundaryField()[patch];
        forAll (normals, face) {
            wall.gradient()[face] = 0;
            const vector along = normals[face] - (normals[face] & outward[face]) * outward[face];
            const bool solid =
                scene.physics.melting && fields.heat->temperature.boundaryField()[patch][face] < scene.primary.solidus;
            if (solid || mag(along) < 1e-3) continue;
            normals[face] = cosine * outward[face] + sine * along / mag(along);
            wall.gradient()[face] = cosine * mag(gradients[face]);
        }
        wall.evaluate();
    }
}
} // namespace cupel
