/// Transport of the volume fraction (interface_transport.hpp), and what follows from it.
///
///   ∂α/∂t + ∇·(u α) = 0,     ρ = α ρ₁ + (1 − α) ρ₂,     mass flux = ρ₁ F + ρ₂ (φ − F)
///
/// Needs: volume flux φ. Gives: α, the primary material's flux F, density, mass flux and interface geometry.
#pragma once

#include "interface_geometry.hpp"
#include "interface_transport.hpp"

namespace cupel
{
/// Moves α by one step of the clock, the `step`th of the run.
void advance_volume_fraction(const Scene& scene, Fields& fields, InterfaceTransport& transport,
                             InterfaceGeometry& geometry, label step);
} // namespace cupel
