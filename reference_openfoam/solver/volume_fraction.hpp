/// Transport of the volume fraction with interface compression, bounded by MULES (Weller 2008; Deshpande 2012).
///
///   ∂α/∂t + ∇·(u α) + ∇·(u_r α (1 − α)) = 0,     u_r = C |u·n̂_face| n̂
///
/// Needs: volume flux, interface normal. Gives: α, the primary material's flux, density and mass flux.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
/// Moves α by one step of the clock and updates density, fluxes and interface geometry.
void advance_volume_fraction(const Scene& scene, Fields& fields, InterfaceGeometry& geometry);
} // namespace cupel
