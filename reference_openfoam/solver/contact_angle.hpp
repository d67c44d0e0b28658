/// Wetting: the interface meets a wall at the primary material's contact angle θ (Young; Brackbill 1992, section 4).
///
///   n̂ at the wall = cosθ n̂_wall + sinθ t̂,     t̂ the direction of the computed n̂ within the wall
///
/// n̂ = ∇α/|∇α| points into the primary material and n̂_wall out of the domain, so θ is measured through the primary
/// material. ∂α/∂n at the wall follows: n̂·n̂_wall |∇α|. Where the material is solid the interface is left as it is.
#pragma once

#include "fields.hpp"

namespace cupel
{
/// Turns the unit normals on wall faces, and sets the wall gradient of `fraction` (a fixedGradient patch there)
/// accordingly.
void apply_contact_angle(surfaceVectorField& unit_normal, const surfaceVectorField& face_gradient,
                         volScalarField& fraction, const Scene& scene, const Fields& fields);
} // namespace cupel
