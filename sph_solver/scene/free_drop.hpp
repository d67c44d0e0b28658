#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/case.hpp"

namespace cupel
{

/// Volume of a ball (in two dimensions of a disc, for a breadth of 1 m), less what top and bottom of the domain cut
/// off, m³; none where its sides cut it.
std::optional<double> volume_in_domain(const Body& ball, const Domain& domain, int dimensions);

/// Whether the domain's top and bottom leave a ball whole.
bool whole_in_domain(const Body& ball, const Domain& domain);

/// Places of a disc's particles about its centre, m, on rings, the outermost half a spacing below its edge: n rings,
/// n = R/Δx rounded, of radius (k + ½) R/n, each with the number of particles that leaves Δx between them. Where one
/// ring's particles begin, the golden angle further than the last one's, no row is in line with those of its
/// neighbours. A disc cut from a lattice has an edge of steps, and what surface tension makes of them outlasts the run.
std::vector<std::array<double, 3>> disc_on_rings(const Body& disc, double spacing);

/// Places of a ball's particles about its centre, m, on R/Δx shells, each of 6 m² points: the lattice of a cube's
/// faces, taken to the sphere by the map of Roşca & Plonka (2011, "Uniform spherical grids via equal area projection
/// from the cube to the sphere") that keeps areas. m is √(4π/6) (k + ½), rounded, which leaves Δx between particles, as
/// between shells; each shell lies in the middle of the volume of its own. The outermost particles all lie as deep
/// below the surface: a ball cut from a lattice has a surface of steps. Rows of one shell do not go on in the next,
/// which even_out() makes up for.
std::vector<std::array<double, 3>> ball_on_shells(const Body& ball, double spacing);

} // namespace cupel
