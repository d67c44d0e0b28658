/// Surface tension as a balanced continuum force on faces (Brackbill 1992; Francois 2006).
///
///   F = σ(T) κ ∂W/∂n          [N/m³] on a face,     W(α) = 2 [ρ₂ α + ½ (ρ₁ − ρ₂) α²]/(ρ₁ + ρ₂)
///
/// W runs from 0 to 1 as α does and puts the force where the mass is (dW/dα ∝ ρ), so that a light gas is not thrown
/// about; for equal densities W = α. Solid metal has no mobile surface: the force carries the liquid fraction there.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
/// ∂W/∂n on faces [1/m]: shared by the capillary force and the recoil pressure.
tmp<surfaceScalarField> weighted_interface_gradient(const Scene& scene, const Fields& fields);

/// Adds σ κ ∂W/∂n to `force` [N/m³].
void add_capillary_force(surfaceScalarField& force, const surfaceScalarField& interface_gradient, const Scene& scene,
                         const Fields& fields, const InterfaceGeometry& geometry);
} // namespace cupel
