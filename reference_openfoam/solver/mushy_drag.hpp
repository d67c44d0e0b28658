/// Drag that stops the solid and damps the mushy zone (Voller and Prakash 1987, Carman-Kozeny form), implicit in
/// momentum.
///
///   F = −K u,     K = C α (1 − f_l)²/(f_l³ + ε)     [kg/(m³·s)],     ε = 1e-3
///
/// C is the material's `mushy_drag`; much below 1e13 kg/(m³·s) cold powder creeps.
#pragma once

#include "fields.hpp"

namespace cupel
{
/// K in cells [kg/(m³·s)].
tmp<volScalarField> mushy_drag(const Scene& scene, const Fields& fields);
} // namespace cupel
