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

/// Places of a disc's particles, m, on rings about its centre, the outermost half a spacing below its edge: n rings,
/// n = R/Δx rounded, of radius (k + ½) R/n, each with the number of particles that leaves Δx between them. Where one
/// ring's particles begin, the golden angle further than the last one's, no row is in line with those of its
/// neighbours. A disc cut from a lattice has an edge of steps, and what surface tension makes of them outlasts the run.
std::vector<std::array<double, 3>> disc_on_rings(const Body& disc, double spacing);

} // namespace cupel
