/// Recoil of the evaporating surface (Anisimov 1968), as a pressure on the interface that pushes into the metal.
///
///   p_r = 0.54 p₀ exp[(L_v M/R)(1/T_b − 1/T)]           F = p_r ∂S/∂n   [N/m³]
///
/// S(α): see capillary_force.hpp.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
/// Adds p_r ∂S/∂n to `force` [N/m³].
void add_recoil_pressure(surfaceScalarField& force, const surfaceScalarField& interface_gradient, const Scene& scene,
                         const Fields& fields);
} // namespace cupel
