#pragma once

#include <vector>

#include "math/vector.hpp"

namespace cupel
{

/// Moves the places of a ball's particles, m, about its centre as shifting does in a flow (shifting.hpp; Lind et al.
/// 2012, Sun et al. 2017), in 300 sweeps with the kernel without roots, h = Δx:
///
///   δx_i = −0.1 Δx² Σ_j [1 + 0.2 (W_ij/W(Δx))⁴] V_j ∇W_ij,   |δx_i| ≤ 0.1 Δx
///
/// The liquid goes on beyond its surface as its mirror image, V as much larger as the sphere through it is. Particles
/// of the outermost sphere stay on it. Whatever of an arrangement shifting does not leave alone it would do away with
/// in the first steps of a run, and shake the drop.
void even_out(std::vector<Vector>& places, double radius, double spacing);

/// The same in two dimensions for places that walls or further particles of the same size, `fixed`, surround; and then
/// 300 sweeps by which volumes become equal, down the gradient of Σ ε²,
///
///   δx_i = −Δx² Σ_j (ε_i + ε_j) V_j ∇W_ij,   ε = Σ V W less its mean, 0 for what is fixed
///
/// Between two phases volumes are 1/Σ W, so that what differs in them is elastic energy, which the first steps of a run
/// would set free. Returns their mean, m² (m³ for a breadth of 1 m).
double even_out_between(std::vector<Vector>& places, const std::vector<Vector>& fixed, double spacing);

} // namespace cupel
