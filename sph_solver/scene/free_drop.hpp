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

/// Places of a ball's particles about its centre, m: a cube's lattice of n³ points, n = ∛(V/Δx³) rounded, each of them
/// taken to the ball by a map that keeps volumes. Cubes about the centre become spheres, by the map of Roşca & Plonka
/// (2011, "Uniform spherical grids via equal area projection from the cube to the sphere") that keeps areas, so that
/// the outermost particles all lie as deep below the surface, (1/n) R, and rows of one shell go on in the next. Shells
/// are 1.24 of a particle's size ∛(V/n³) apart, particles on them 0.90. A ball cut from a lattice has a surface of
/// steps; shells of Fibonacci points are out of line with each other, which is worse.
std::vector<std::array<double, 3>> ball_on_shells(const Body& ball, double spacing);

} // namespace cupel
