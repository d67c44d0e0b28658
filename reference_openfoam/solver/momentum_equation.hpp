/// Momentum and incompressibility of the mixture, by PISO with a balanced treatment of the forces on faces (Weller
/// 2008).
///
///   ∂(ρu)/∂t + ∇·(ρuu) = −∇p_rgh − (g·x)∇ρ + ∇·[μ(∇u + ∇uᵀ)] + F_faces + F_cells − K u,      ∇·u = 0
///
/// F_faces: capillary force, recoil. F_cells: Marangoni, and ρg along periodic axes, where g·x cannot be periodic. K:
/// mushy drag, implicit. Each is there only if the scene names it.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
/// Advances velocity and pressure by one step of the clock, at the present α and T.
void advance_momentum(const Scene& scene, Fields& fields, const InterfaceGeometry& geometry);
} // namespace cupel
