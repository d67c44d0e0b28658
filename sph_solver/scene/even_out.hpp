#pragma once

#include <vector>

#include "math/vector.hpp"

namespace cupel
{

/// Moves the places of a ball's particles, m, about its centre to where they lie evenly: in each of sixty sweeps by
///
///   δx_i = −0.1 Δx² Σ_j V_j ∇W_ij,   |δx_i| ≤ 0.1 Δx                (the kernel without roots, h = Δx)
///
/// down the gradient of C = Σ V W, as shifting moves particles in a flow (Lind et al. 2012), but without the term
/// against pairs, which would break up rows that are stretched. The liquid goes on beyond its surface as its mirror
/// image, V as much larger as the sphere through it is. Particles of the outermost sphere stay on it. What a map has
/// left uneven would be pushed apart by the first steps of a run, and shake the drop: shells of a cube's lattice at
/// their centre, where C is 1.2 (1.04 on the edges of the cube; 1.01 at most when evened).
void even_out(std::vector<Vector>& places, double radius, double spacing);

} // namespace cupel
