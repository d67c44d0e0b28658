/// Marangoni stress as a body force at the interface (Brackbill 1992; the paper, section 2.6).
///
///   F = (dσ/dT) [∇T − n̂ (n̂·∇T)] |∇α| w f_l      [N/m³],     w = 2ρ/(ρ₁ + ρ₂)
///
/// w puts the force on the heavy side and keeps its integral across the interface; f_l: solid metal has no mobile
/// surface.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
/// The force density in cells [N/m³].
tmp<volVectorField> marangoni_force(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry);
} // namespace cupel
